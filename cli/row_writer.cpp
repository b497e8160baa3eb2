#include "cli/row_writer.h"

#include "benchmarks/machine.h"
#include "benchmarks/plan_row.h"
#include "benchmarks/write_file.h"
#include "maxwrench/version.h"

namespace maxwrench {
namespace {

/// Columns of times.csv: those of a row, and what a time depends on.
std::vector<std::string> measured_columns() {
  std::vector<std::string> columns = time_columns();
  columns.insert(columns.end(), {"threads", "machine", "version"});
  return columns;
}

}  // namespace

RowWriter::RowWriter(const std::string& command, const std::filesystem::path& folder, int threads,
                     long rows)
    : values_(folder / "values.csv", value_columns(), case_columns().size()),
      times_(folder / "times.csv", measured_columns(), case_columns().size()),
      threads_(threads),
      progress_(command, rows) {
  write_file(folder / "machine.txt", describe_machine());
}

template <class AnyRow>
AnyRow RowWriter::kept(const Problem& problem, AnyRow row, int threads) {
  values_.put(values(problem, row));
  std::vector<std::string> measured = times(row.choice, row.evaluations, row.wall_s);
  measured.insert(measured.end(), {std::to_string(threads), processor_name(), version()});
  times_.put(measured);
  all_solved_ = all_solved_ && row.has_value();
  progress_.show(++done_);
  return row;
}

Row RowWriter::solve(const Problem& problem, const Method& method) {
  return kept(problem, maxwrench::solve(problem, method, threads_), threads_);
}

PlanRow RowWriter::solve(const Problem& problem, const PlanMethod& method) {
  return kept(problem, solve_plan(problem, method, threads_), threads_);
}

Row RowWriter::evaluate(const Problem& problem, const Method& method,
                        const Eigen::VectorXd& theta_r) {
  return kept(problem, maxwrench::evaluate(problem, method, theta_r), 1);
}

PlanRow RowWriter::evaluate(const Problem& problem, const PlanMethod& method,
                            const Eigen::MatrixXd& knots) {
  return kept(problem, evaluate_plan(problem, method, knots), 1);
}

bool RowWriter::finish() {
  progress_.finish();
  return all_solved_;
}

}  // namespace maxwrench
