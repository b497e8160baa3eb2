#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "maxwrench/load.h"
#include "maxwrench/trajectory.h"
#include "problems/loader/bad_input.h"
#include "problems/loader/number_table.h"

namespace maxwrench {
namespace {

std::vector<std::string> coordinate_names(const Problem& problem) {
  std::vector<std::string> names;
  for (int i = 0; i < problem.redundancy(); ++i) names.push_back(problem.theta_r_name(i));
  return names;
}

/// Whether a table with this name in its header is read back unchanged.
bool is_plain(const std::string& name) {
  return !name.empty() && name.find("nan") != 0 && name.find("inf") != 0 &&
         std::isalpha(static_cast<unsigned char>(name.front())) != 0 &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) {
           return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.' || c == '/';
         });
}

}  // namespace

Eigen::MatrixXd load_knots(const std::filesystem::path& file, const Problem& problem) {
  const NumberTable table = read_numbers(file, {coordinate_names(problem)});
  const auto k = static_cast<std::size_t>(knots_of(problem));
  const bool starts = problem.motion && problem.motion->impulse;
  const bool both = problem.motion && problem.motion->transfer;
  if (table.rows.size() != k) {
    throw_bad_input(file, "rows", fmt::format("{}", table.rows.size()),
                    fmt::format("{}, one for each knot of theta_r{}", k,
                                starts ? " after knot 0, which is given"
                                : both ? " between both ends, which are given"
                                       : ""));
  }
  Eigen::MatrixXd knots(static_cast<Eigen::Index>(k), problem.redundancy());
  for (std::size_t i = 0; i < k; ++i) {
    knots.row(static_cast<Eigen::Index>(i)) =
        Eigen::Map<const Eigen::RowVectorXd>(table.rows[i].data(), knots.cols());
  }
  return knots;
}

std::string knots_csv(const Problem& problem, const Eigen::MatrixXd& knots) {
  const std::vector<std::string> names = coordinate_names(problem);
  std::string text;
  if (std::all_of(names.begin(), names.end(), is_plain)) {
    text = fmt::format("{}\n", fmt::join(names, ","));
  }
  for (Eigen::Index i = 0; i < knots.rows(); ++i) {
    const Eigen::RowVectorXd row = knots.row(i);
    text += fmt::format("{:.17g}\n", fmt::join(row.data(), row.data() + row.size(), ","));
  }
  return text;
}

}  // namespace maxwrench
