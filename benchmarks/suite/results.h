#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/race/comparison.h"
#include "maxwrench/solve.h"

namespace maxwrench {

/// Readings of an experiment count as the same up to this, relative to 1 + |reading|: they hang on
/// the steps of its integrator.
inline constexpr double kSameReading = 1e-4;

/// One row of values.csv with its time: what an analysis asks for.
struct ResultRow {
  Case choice;
  std::string status, unit, reason;
  std::optional<double> beta;       ///< none: the row has no value
  std::optional<double> beta_linf;  ///< of an experiment, what was planned
  double evaluations = 0;
  /// Microseconds of an evaluation, of the processor; none where they were not measured.
  std::optional<double> us;

  /// Has a value that is what was asked for: an interrupted search has failed.
  bool solved() const;
  bool is_experiment() const { return !choice.integrator.empty(); }
  /// All that the row took, of the processor; none where it was not measured.
  std::optional<double> ms() const;
};

/// What a run, a race or both left in a folder.
struct Results {
  std::filesystem::path folder;
  std::vector<ResultRow> rows;
  std::vector<Comparison> races;  ///< of search_comparison.csv, if it is there
  /// How many rows of times.csv each version made.
  std::map<std::string, long> versions;
  std::string machine;  ///< machine.txt, if it is there
  std::string suite;    ///< suite.toml, if it is there
};

/// Reads values.csv, which must be there unless a race is, times.csv, and the files of a race.
/// Throws std::invalid_argument with one line on a file that is no such table: a column that is
/// missing, a cell that is no finite number, a case that appears twice.
Results read_results(const std::filesystem::path& folder);

}  // namespace maxwrench
