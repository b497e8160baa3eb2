#pragma once

#include <map>
#include <string>
#include <vector>

#include "maxwrench/solve.h"

namespace maxwrench {

class Table;

/// Whether a complete case waits for others of this kind that run beside it in one process.
bool waits_for_others(const Case& c);

/// About how many seconds a complete case takes on one thread, from nothing but its names and its
/// problem, so that whoever asks gets the same.
double usual_seconds(const Problem& problem, const Case& c);

/// The same from what was measured before.
class Forecast {
 public:
  /// `times`: a table of times; of what it does not hold the usual seconds count.
  explicit Forecast(const Table& times);
  double seconds(const Problem& problem, const Case& c) const;

 private:
  struct Sum {
    double seconds = 0, budget = 0;
  };
  std::map<std::string, Sum> measured_;  ///< by all columns of the case but seed and budget
};

/// The cases of part `index` of `count` (0 and more): the dearest goes to the part that has least
/// so far, and so on.
std::vector<Case> shard(const std::vector<Case>& cases, const std::vector<double>& costs, int index,
                        int count);

}  // namespace maxwrench
