#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "maxwrench/solve.h"
#include "solvers/certify/certify.h"
#include "solvers/certify/good_postures.h"
#include "solvers/solve/method.h"

namespace CLI {
class App;
}

namespace maxwrench {

struct Method;
struct Problem;

/// The options of `certify --within`.
struct WithinOptions {
  std::string within;  ///< as on the command line; empty: not asked for
  double resolution = GoodOptions().resolution;
  std::string figure, boxes;  ///< files; empty: none

  void add(CLI::App& command);
  bool asked() const { return !within.empty(); }
  double share() const;  ///< that `within` says
};

/// Of the gap to the best, at most this part of the share: so what is found good is good for sure
/// unless it lies near the edge.
inline constexpr double kGapPart = 0.1;

/// All postures that are within the share of the best; `row` holds the best that is known, whose
/// value is at most `high`. Those that are found are verified as any; a better one becomes `row`.
GoodPostures verified_good_postures(const Problem& problem, const Method& method,
                                    const Bound& bound, double high, GoodOptions options,
                                    Answer& row);

/// For people, after what was proven of the best.
void print_good(const Problem& problem, const GoodPostures& good, const WithinOptions& options);

nlohmann::ordered_json to_json(const GoodPostures& good, const WithinOptions& options);

/// The files that were asked for.
void write_good(const Answer& row, const GoodPostures& good, const WithinOptions& options);

}  // namespace maxwrench
