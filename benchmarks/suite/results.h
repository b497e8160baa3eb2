#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/race/comparison.h"
#include "maxwrench/solve.h"

namespace maxwrench {

/// Two readings of an experiment count as the same up to this, relative to 1 + |reading|: they
/// depend on the steps of its integrator.
inline constexpr double kSameReading = 1e-4;

/// One row of values.csv with its time, as far as an analysis needs it.
struct ResultRow {
  Case choice;
  std::string status, unit, reason;
  std::optional<double> beta;       ///< none: the row has no value
  std::optional<double> beta_linf;  ///< of an experiment, the planned c'h
  double evaluations = 0;
  /// Microseconds of an evaluation, in processor time; empty if not measured.
  std::optional<double> us;

  /// Whether it has the requested value: an interrupted search has failed.
  bool solved() const;
  bool is_experiment() const { return !choice.integrator.empty(); }
  /// Processor time of the whole row; empty if not measured.
  std::optional<double> ms() const;
};

/// The results of a run, a race or both in a folder.
struct Results {
  std::filesystem::path folder;
  std::vector<ResultRow> rows;
  std::vector<Comparison> races;  ///< from search_comparison.csv, if it exists
  /// The number of rows of times.csv for each version.
  std::map<std::string, long> versions;
  std::string machine;  ///< machine.txt, if it exists
  std::string suite;    ///< suite.toml, if it exists
};

/// Reads values.csv, which must exist unless there is a race, times.csv, and the files of a race.
/// Throws std::invalid_argument with one line on a file that is not such a table: a missing column,
/// a cell that is not a finite number, a case that appears twice.
Results read_results(const std::filesystem::path& folder);

}  // namespace maxwrench
