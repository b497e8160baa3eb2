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
  std::string within;  ///< as on the command line; empty if not requested
  double resolution = GoodOptions().resolution;
  std::string figure, boxes;  ///< files; empty if none

  void add(CLI::App& command);
  void add_list(CLI::App& command);  ///< without the files
  /// Throws std::invalid_argument for a task whose good postures cannot be listed.
  void require_listable(const Problem& problem) const;
  bool asked() const { return !within.empty(); }
  double share() const;  ///< `within` as a number
};

/// The gap to the best may be at most this part of the share. Then a posture that counts as good
/// certainly is good, unless its value is near the limit.
inline constexpr double kGapPart = 0.1;

/// All postures within the share of the best. `row` holds the best known one, and no value exceeds
/// `high`. Postures that are found are verified like any other; a better one becomes `row`.
GoodPostures verified_good_postures(const Problem& problem, const Method& method,
                                    const Bound& bound, double high, GoodOptions options,
                                    Answer& row);

/// Prints the good postures as text, after the proof for the best one.
void print_good(const Problem& problem, const GoodPostures& good, const WithinOptions& options);

nlohmann::ordered_json to_json(const Problem& problem, const GoodPostures& good,
                               const WithinOptions& options);

/// Writes the requested files.
void write_good(const Answer& row, const GoodPostures& good, const WithinOptions& options);

}  // namespace maxwrench
