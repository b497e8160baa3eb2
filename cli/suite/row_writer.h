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

/// Whether a version tells from which sources it was built: those of a commit, with no change.
bool names_sources(std::string_view version);

/// The rows of a folder as they are.
class RowsThere {
 public:
  explicit RowsThere(const std::filesystem::path& folder,
                     std::string version = maxwrench::version());

  /// Whether the folder holds the row of a complete case, made from the files that the task was
  /// read from, by the present sources and version; none if that does not name its sources.
  bool has(const Problem& problem, const Case& c) const;
  bool empty() const { return values_.size() == 0; }
  /// Whether those of all these cases are there and have a value.
  bool all_solved(const std::vector<Case>& cases) const;

 private:
  Table values_, times_;
  std::string version_;
};

/// Solves cases and keeps their rows in the tables of a folder, each as soon as it is known;
/// describes the machine in machine.txt. Each time says on how many threads, on which processor and
/// by which build it was measured, because a table may grow on several. Shows its progress.
class RowWriter {
 public:
  /// `threads`: of each case; `work`: of all of them together, for the progress bar.
  RowWriter(const std::string& command, const std::filesystem::path& folder, int threads,
            double work);

  Answer solve(const Problem& problem, const Case& c);
  Answer evaluate(const Problem& problem, const Case& c, const Eigen::MatrixXd& theta_r);

  /// A search or an experiment, from any thread; what is thrown on the way makes a row without a
  /// value, with the reason.
  void carry_out(const Problem& problem, const Case& c, double work);

  /// Removes the progress bar and writes the tables; whether every row has a value.
  bool finish();

 private:
  /// Keeps the row of what is made, and measures the time of the processor.
  Answer kept(int threads, const std::function<Answer()>& make, double work = 1);

  Table values_, times_;
  std::mutex mutex_;
  int threads_;
  Progress progress_;
  double done_ = 0;
  bool all_solved_ = true;
};

}  // namespace maxwrench
