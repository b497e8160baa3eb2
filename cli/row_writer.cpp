#include "cli/row_writer.h"

#include "benchmarks/machine.h"
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

Row RowWriter::solve(const Problem& problem, const Method& method) {
  Row row = maxwrench::solve(problem, method, threads_);
  keep(problem, row, threads_);
  return row;
}

Row RowWriter::evaluate(const Problem& problem, const Method& method,
                        const Eigen::VectorXd& theta_r) {
  Row row = maxwrench::evaluate(problem, method, theta_r);
  keep(problem, row, 1);
  return row;
}

bool RowWriter::finish() {
  progress_.finish();
  return all_solved_;
}

void RowWriter::keep(const Problem& problem, const Row& row, int threads) {
  values_.put(values(problem, row));
  std::vector<std::string> measured = times(row);
  measured.insert(measured.end(), {std::to_string(threads), processor_name(), version()});
  times_.put(measured);
  all_solved_ = all_solved_ && row.has_value();
  progress_.show(++done_);
}

}  // namespace maxwrench
