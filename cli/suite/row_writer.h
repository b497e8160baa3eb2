#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>

#include "benchmarks/tables/table.h"
#include "cli/progress.h"
#include "maxwrench/version.h"
#include "solvers/solve/row.h"

namespace maxwrench {

struct Problem;

/// The tables of a folder: values.csv and times.csv.
Table values_table(const std::filesystem::path& folder);
Table times_table(const std::filesystem::path& folder);

/// Whether a version identifies the sources of its build: a commit without changes.
bool names_sources(std::string_view version);

/// The existing rows of a folder.
class RowsThere {
 public:
  explicit RowsThere(const std::filesystem::path& folder,
                     std::string version = maxwrench::version());

  /// Whether the folder holds the row of a complete case, made from the same task files by the
  /// present sources and version. False if the version does not identify its sources.
  bool has(const Problem& problem, const Case& c) const;
  bool empty() const { return values_.size() == 0; }
  /// Whether the rows of all these cases exist and have a value.
  bool all_solved(const std::vector<Case>& cases) const;

 private:
  Table values_, times_;
  std::string version_;
};

/// Solves cases and writes each row to the tables of a folder as soon as it is known; writes the
/// description of the machine to machine.txt. Each time is stored with its number of threads,
/// processor and build, because several machines may add to a table. Shows its progress.
class RowWriter {
 public:
  /// `threads` is for each case; `work` is the total of all cases, for the progress bar.
  RowWriter(const std::string& command, const std::filesystem::path& folder, int threads,
            double work);

  Answer solve(const Problem& problem, const Case& c);
  Answer evaluate(const Problem& problem, const Case& c, const Eigen::MatrixXd& theta_r);

  /// Runs a search or an experiment; may be called from any thread. An exception gives a row
  /// without a value, with the reason.
  void carry_out(const Problem& problem, const Case& c, double work);

  /// Removes the progress bar and writes the tables. Returns whether every row has a value.
  bool finish();

 private:
  /// Stores the row of the answer that `make` returns, and measures the processor time.
  Answer kept(int threads, const std::function<Answer()>& make, double work = 1);

  Table values_, times_;
  std::mutex mutex_;
  int threads_;
  Progress progress_;
  double done_ = 0;
  bool all_solved_ = true;
};

}  // namespace maxwrench
