#include "problems/make/coordinate_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/math/cubic_spline.h"
#include "problems/make/bad_value.h"

namespace maxwrench {
namespace {

constexpr double kShortestStep = 1e-6;  // s, between neighbours

void require_shape(const char* key, const Eigen::MatrixXd& matrix, const MotionTable& table) {
  const auto N = static_cast<Eigen::Index>(table.t.size()),
             d = static_cast<Eigen::Index>(table.names.size());
  if (matrix.rows() == N && matrix.cols() == d) return;
  throw BadValue(key, fmt::format("{}x{} numbers", matrix.rows(), matrix.cols()),
                 fmt::format("{}x{}, a row for each t and a column for each coordinate", N, d));
}

void require_finite_rows(const char* suffix, const Eigen::MatrixXd& matrix,
                         const MotionTable& table) {
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    for (Eigen::Index k = 0; k < matrix.cols(); ++k) {
      if (std::isfinite(matrix(row, k))) continue;
      throw BadValue(row_name(table, static_cast<std::size_t>(row)),
                     fmt::format("{}{} = {:g}", table.names[static_cast<std::size_t>(k)], suffix,
                                 matrix(row, k)),
                     "a finite number");
    }
  }
}

void require_rising_times(const MotionTable& table) {
  if (table.t.size() < 2) {
    throw BadValue("rows", fmt::format("{}", table.t.size()), "two rows or more");
  }
  for (std::size_t row = 0; row < table.t.size(); ++row) {
    const double t = table.t[row];
    if (!std::isfinite(t)) {
      throw BadValue(row_name(table, row), fmt::format("t = {:g}", t), "a finite number");
    }
    if (row > 0 && !(t - table.t[row - 1] >= kShortestStep)) {
      throw BadValue(row_name(table, row), fmt::format("t = {:g} after {:g}", t, table.t[row - 1]),
                     "a t that rises from row to row, by 1e-6 s or more");
    }
  }
}

void require_table(const MotionTable& table) {
  require_rising_times(table);
  if (table.names.empty()) {
    throw BadValue("columns", "no coordinates", "t and the coordinates by name");
  }
  require_shape("values", table.values, table);
  require_finite_rows("", table.values, table);
  if (table.rates.size() > 0) {
    require_shape("rates", table.rates, table);
    require_finite_rows("_dot", table.rates, table);
  }
  if (table.accelerations.size() > 0) {
    if (table.rates.size() == 0) {
      throw BadValue("columns", "NAME_ddot without NAME_dot",
                     "first derivatives beside the second ones");
    }
    require_shape("accelerations", table.accelerations, table);
    require_finite_rows("_ddot", table.accelerations, table);
  }
  const int each = table.instants_per_interval;
  const long most = kMostMotionInstants / static_cast<long>(table.t.size());
  if (each < 1 || each > most) {
    throw BadValue("instants_per_interval", fmt::format("{}", each),
                   fmt::format("a whole number from 1 to {}", most));
  }
  if (each > 1 && table.rates.size() > 0) {
    throw BadValue("instants_per_interval", fmt::format("{}", each),
                   "1, as the table has derivatives at its rows only");
  }
}

/// Makes roll, pitch and yaw of the base differ by at most pi from row to row.
void unwrap(MotionTable& table) {
  for (Eigen::Index k = 0; k < table.values.cols(); ++k) {
    const std::string& name = table.names[static_cast<std::size_t>(k)];
    if (name != "base_roll" && name != "base_pitch" && name != "base_yaw") continue;
    for (Eigen::Index row = 1; row < table.values.rows(); ++row) {
      double& angle = table.values(row, k);
      angle = table.values(row - 1, k) +
              std::remainder(angle - table.values(row - 1, k), 2 * std::numbers::pi);
    }
  }
}

/// The derivatives at the rows of the spline through the columns.
Eigen::MatrixXd slopes_at_rows(const std::vector<double>& t, const Eigen::MatrixXd& columns) {
  const Eigen::MatrixXd values = columns.transpose(), bends = free_spline_bends(t, values);
  Eigen::MatrixXd slopes(columns.rows(), columns.cols());
  for (Eigen::Index row = 0; row < columns.rows(); ++row) {
    const SplineInstant at = spline_at(t, t[static_cast<std::size_t>(row)]);
    const auto w = at.weights.col(1);
    const Eigen::Index i = at.interval;
    slopes.row(row) = (w[0] * values.col(i) + w[1] * values.col(i + 1) + w[2] * bends.col(i) +
                       w[3] * bends.col(i + 1))
                          .transpose();
  }
  return slopes;
}

using ColumnNames = std::vector<std::string>;

int place_of(const ColumnNames& columns, const std::string& name) {
  const auto found = std::find(columns.begin(), columns.end(), name);
  return found == columns.end() ? -1 : static_cast<int>(found - columns.begin());
}

/// Whether a column is NAME + suffix of another one.
bool derives(const ColumnNames& columns, const std::string& name, const std::string& suffix) {
  return name.size() > suffix.size() && name.ends_with(suffix) &&
         place_of(columns, name.substr(0, name.size() - suffix.size())) >= 0;
}

/// The columns NAME + suffix of all coordinates; empty if there is none of them.
Eigen::MatrixXd columns_with(const std::string& suffix, const ColumnNames& names,
                             const ColumnNames& columns, const Eigen::MatrixXd& numbers) {
  Eigen::MatrixXd all(numbers.rows(), static_cast<Eigen::Index>(names.size()));
  std::size_t found = 0;
  std::string missing;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const int column = place_of(columns, names[k] + suffix);
    if (column < 0) {
      if (missing.empty()) missing = names[k] + suffix;
      continue;
    }
    ++found;
    all.col(static_cast<Eigen::Index>(k)) = numbers.col(column);
  }
  if (found == 0) return {};
  if (found < names.size()) {
    throw BadValue("columns", "no " + missing, "NAME" + suffix + " of all coordinates or of none");
  }
  return all;
}

}  // namespace

MotionTable make_motion_table(const ColumnNames& columns, const Eigen::MatrixXd& numbers) {
  if (numbers.cols() != static_cast<Eigen::Index>(columns.size())) {
    throw BadValue("columns", fmt::format("{} names", columns.size()),
                   fmt::format("{}, one for each column", numbers.cols()));
  }
  const int time = place_of(columns, "t");
  if (time < 0) throw BadValue("columns", "no t", "t and the coordinates by name");
  MotionTable table;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string& name = columns[i];
    if (place_of(columns, name) != static_cast<int>(i)) {
      throw BadValue("columns", name + " twice", "each column once");
    }
    if (name == "t" || derives(columns, name, "_dot") || derives(columns, name, "_ddot")) continue;
    table.names.push_back(name);
  }
  const Eigen::VectorXd t = numbers.col(time);
  table.t.assign(t.begin(), t.end());
  table.values = columns_with("", table.names, columns, numbers);
  table.rates = columns_with("_dot", table.names, columns, numbers);
  table.accelerations = columns_with("_ddot", table.names, columns, numbers);
  return table;
}

std::string row_name(const MotionTable& table, std::size_t row) {
  return row < table.lines.size() ? fmt::format("line {}", table.lines[row])
                                  : fmt::format("row {}", row + 1);
}

std::string describe_rates(const MotionTable& table) {
  if (table.rates.size() == 0) return "velocities and accelerations of a cubic spline";
  if (table.accelerations.size() == 0) {
    return "velocities of the table, accelerations of a cubic spline through them";
  }
  return "velocities and accelerations of the table";
}

CoordinateSeries make_series(MotionTable table) {
  require_table(table);
  unwrap(table);
  CoordinateSeries series;
  series.per_row = table.instants_per_interval;
  if (table.rates.size() > 0) {
    series.t = table.t;
    series.values = table.values;
    series.rates = table.rates;
    series.accelerations =
        table.accelerations.size() > 0 ? table.accelerations : slopes_at_rows(table.t, table.rates);
    return series;
  }
  const Eigen::MatrixXd values = table.values.transpose(),
                        bends = free_spline_bends(table.t, values);
  const auto intervals = static_cast<Eigen::Index>(table.t.size()) - 1;
  const Eigen::Index K = intervals * series.per_row + 1;
  for (Eigen::MatrixXd* each : {&series.values, &series.rates, &series.accelerations}) {
    each->resize(K, values.rows());
  }
  for (Eigen::Index k = 0; k < K; ++k) {
    const auto row = static_cast<std::size_t>(k / series.per_row);
    const double share = static_cast<double>(k % series.per_row) / series.per_row;
    const double t =
        share == 0 ? table.t[row] : table.t[row] + share * (table.t[row + 1] - table.t[row]);
    series.t.push_back(t);
    const SplineInstant at = spline_at(table.t, t);
    const Eigen::Index i = at.interval;
    const auto combined = [&](Eigen::Index order) {
      const auto w = at.weights.col(order);
      return (w[0] * values.col(i) + w[1] * values.col(i + 1) + w[2] * bends.col(i) +
              w[3] * bends.col(i + 1))
          .transpose();
    };
    series.values.row(k) = combined(0);
    series.rates.row(k) = combined(1);
    series.accelerations.row(k) = combined(2);
  }
  return series;
}

}  // namespace maxwrench
