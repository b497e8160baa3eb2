#include <string>
#include <vector>

#include "maxwrench/motion_table.h"
#include "problems/loader/bad_input.h"
#include "problems/loader/number_table.h"

namespace maxwrench {

MotionTable read_motion_table(const std::filesystem::path& file) {
  const NumberTable numbers = read_named_numbers(file);
  const auto width = static_cast<Eigen::Index>(numbers.columns.size());
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(numbers.rows.size()), width);
  for (Eigen::Index row = 0; row < rows.rows(); ++row) {
    rows.row(row) = Eigen::Map<const Eigen::RowVectorXd>(
        numbers.rows[static_cast<std::size_t>(row)].data(), width);
  }
  MotionTable table = in_file(file, [&] { return make_motion_table(numbers.columns, rows); });
  table.lines = numbers.lines;
  return table;
}

std::vector<Instant> load_motion(const std::filesystem::path& file, const Problem& problem,
                                 int instants_per_interval, std::string* rates) {
  MotionTable table = read_motion_table(file);
  table.instants_per_interval = instants_per_interval;
  if (rates) *rates = describe_rates(table);
  return in_file(file, [&] { return motion_instants(problem, table); });
}

}  // namespace maxwrench
