#pragma once

#include <filesystem>
#include <string>

#include "benchmarks/row.h"
#include "benchmarks/table.h"
#include "cli/progress.h"

namespace maxwrench {

/// Solves cases one after the other and keeps their rows in values.csv and times.csv of a folder,
/// each written as soon as it is known; describes the machine in machine.txt. Shows its progress.
class RowWriter {
 public:
  /// `rows`: how many are expected, for the progress bar.
  RowWriter(const std::string& command, const std::filesystem::path& folder, int threads,
            long rows);

  /// Of a completed case.
  Row solve(const Problem& problem, const Case& c);
  Row evaluate(const Problem& problem, const Case& c, const Eigen::VectorXd& theta_r);

  /// Removes the progress bar; whether every row has a value.
  bool finish();

 private:
  void keep(const Problem& problem, const Row& row);

  Table values_, times_;
  int threads_;
  Progress progress_;
  long done_ = 0;
  bool all_solved_ = true;
};

}  // namespace maxwrench
