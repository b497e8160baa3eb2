#pragma once

#include <filesystem>
#include <string>

#include "benchmarks/row.h"
#include "benchmarks/table.h"
#include "cli/progress.h"

namespace maxwrench {

struct PlanMethod;
struct PlanRow;

/// Solves cases one after the other and keeps their rows in values.csv and times.csv of a folder,
/// each written as soon as it is known; describes the machine in machine.txt. Each time says on how
/// many threads, on which processor and by which version it was measured, because a table may grow
/// on several. Shows its progress.
class RowWriter {
 public:
  /// `rows`: how many are expected, for the progress bar.
  RowWriter(const std::string& command, const std::filesystem::path& folder, int threads,
            long rows);

  Row solve(const Problem& problem, const Method& method);
  PlanRow solve(const Problem& problem, const PlanMethod& method);
  Row evaluate(const Problem& problem, const Method& method, const Eigen::VectorXd& theta_r);
  PlanRow evaluate(const Problem& problem, const PlanMethod& method, const Eigen::MatrixXd& knots);

  /// Removes the progress bar; whether every row has a value.
  bool finish();

 private:
  /// Of a `Row` or `PlanRow`.
  template <class AnyRow>
  AnyRow kept(const Problem& problem, AnyRow row, int threads);

  Table values_, times_;
  int threads_;
  Progress progress_;
  long done_ = 0;
  bool all_solved_ = true;
};

}  // namespace maxwrench
