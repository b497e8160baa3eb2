#pragma once

#include <map>
#include <string>
#include <vector>

#include "maxwrench/solve.h"

namespace maxwrench {

class Table;

/// Whether a complete case must wait for others of this kind that run in parallel in the same
/// process.
bool waits_for_others(const Case& c);

/// The approximate seconds of a complete case on one thread. Depends only on its names and its
/// problem, so it is the same everywhere.
double usual_seconds(const Problem& problem, const Case& c);

/// The same from earlier measurements.
class Forecast {
 public:
  /// `times` is a table of times. For cases that it does not contain, the usual seconds are used.
  explicit Forecast(const Table& times);
  double seconds(const Problem& problem, const Case& c) const;

 private:
  struct Sum {
    double seconds = 0, budget = 0;
  };
  std::map<std::string, Sum> measured_;  ///< by all columns of the case except seed and budget
};

/// The cases of part `index` of `count` (0 and more). The most expensive remaining case always goes
/// to the part with the least cost so far.
std::vector<Case> shard(const std::vector<Case>& cases, const std::vector<double>& costs, int index,
                        int count);

}  // namespace maxwrench
