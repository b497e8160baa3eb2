#include "cli/row_writer.h"

#include "benchmarks/machine.h"

namespace maxwrench {

RowWriter::RowWriter(const std::string& command, const std::filesystem::path& folder, int threads,
                     long rows)
    : values_(folder / "values.csv", value_columns(), case_columns().size()),
      times_(folder / "times.csv", time_columns(), case_columns().size()),
      threads_(threads),
      progress_(command, rows) {
  write_file(folder / "machine.txt", describe_machine());
}

Row RowWriter::solve(const Problem& problem, const Case& c) {
  Row row = maxwrench::solve(problem, c, threads_);
  keep(problem, row);
  return row;
}

Row RowWriter::evaluate(const Problem& problem, const Case& c, const Eigen::VectorXd& theta_r) {
  Row row = maxwrench::evaluate(problem, c, theta_r);
  keep(problem, row);
  return row;
}

bool RowWriter::finish() {
  progress_.finish();
  return all_solved_;
}

void RowWriter::keep(const Problem& problem, const Row& row) {
  values_.put(values(problem, row));
  times_.put(times(row));
  all_solved_ = all_solved_ && row.has_value();
  progress_.show(++done_);
}

}  // namespace maxwrench
