#include "lib/path/limits.h"

#include <array>
#include <cstdio>
#include <vector>

namespace maxwrench {
namespace {

/// The joint of a coordinate of theta_r.
const Joint& joint_of(const Problem& problem, Eigen::Index coordinate) {
  return problem.robot
      .joints[static_cast<std::size_t>(problem.redundant[static_cast<std::size_t>(coordinate)])];
}

/// "knots 3 and 4" for the row of a difference, "between knots 3 and 4" for an instant.
std::string place_of(const Eigen::MatrixXd& rows, Eigen::Index row, const SchemeMaps& maps) {
  const Eigen::Index pairs = maps.knots() - 1;
  const int first = maps.starts ? 0 : 1;
  if (&rows == &maps.speed && row < pairs) {
    return "knots " + std::to_string(first + row) + " and " + std::to_string(first + row + 1);
  }
  const Eigen::Index instant = &rows == &maps.speed ? row - pairs : row;
  const Eigen::Index interval = std::min<Eigen::Index>(
      pairs - 1, instant * pairs / std::max<Eigen::Index>(1, maps.instants() - 1));
  return "between knots " + std::to_string(first + interval) + " and " +
         std::to_string(first + interval + 1);
}

std::string text(const char* format, double a, double b, double c) {
  std::array<char, 96> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, a, b, c);
  return buffer.data();
}

}  // namespace

std::string knots_violation(const Problem& problem, const SchemeMaps& maps,
                            const Eigen::MatrixXd& Q) {
  for (Eigen::Index j = 0; j < Q.cols(); ++j) {
    const Joint& joint = joint_of(problem, j);
    const double low = problem.theta_r_min[j], high = problem.theta_r_max[j];
    const auto beyond = [&](double q) {
      return !(q >= low - kTableTolerance && q <= high + kTableTolerance);
    };
    for (Eigen::Index i = maps.starts ? 1 : 0; i < Q.rows(); ++i) {
      if (!beyond(Q(i, j))) continue;
      return "joint limit: knot " + std::to_string(i + (maps.starts ? 0 : 1)) + ": " + joint.name +
             text(" at %.6g, limits %.6g .. %.6g", Q(i, j), low, high);
    }
    const Eigen::VectorXd rates = maps.speed * Q.col(j);
    for (Eigen::Index row = 0; row < rates.size(); ++row) {
      if (std::abs(rates[row]) <= joint.velocity_max + kTableTolerance) continue;
      return "speed limit: " + place_of(maps.speed, row, maps) + ": " + joint.name +
             text(" at %.6g per s, limit %.6g", rates[row], joint.velocity_max, 0);
    }
    const Eigen::VectorXd places = maps.place * Q.col(j);
    for (Eigen::Index row = 0; row < places.size(); ++row) {
      if (!beyond(places[row])) continue;
      return "joint limit: " + place_of(maps.place, row, maps) + ": " + joint.name +
             text(" at %.6g, limits %.6g .. %.6g", places[row], low, high);
    }
    const Eigen::VectorXd zeros = maps.zero * Q.col(j);
    for (const double value : zeros) {
      if (std::abs(value) <= kTableTolerance) continue;
      const bool smooth = maps.smooth();
      return std::string(smooth ? "acceleration at knot 0: " : "not at rest: last knots: ") +
             joint.name +
             text(smooth ? ": %.6g times dt^2, expected 0" : " moves by %.6g", value, 0, 0);
    }
  }
  return {};
}

KnotRows knot_rows(const Problem& problem, const MotionTask& task, const SchemeMaps& maps) {
  const Eigen::Index r = problem.redundancy(), skipped = maps.starts ? 1 : 0;
  const Eigen::Index k = maps.knots() - skipped;
  const Eigen::Index rows = maps.speed.rows() + maps.place.rows() + maps.zero.rows();
  KnotRows result;
  result.R.resize(rows * r, k * r);
  result.r_min.resize(rows * r);
  result.r_max.resize(rows * r);
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::Index at = 0;
  const auto add = [&](const Eigen::RowVectorXd& row, Eigen::Index j, double low, double high) {
    for (Eigen::Index i = 0; i < k; ++i) {
      if (row[i + skipped] != 0) entries.emplace_back(at, i * r + j, row[i + skipped]);
    }
    const double fixed = skipped ? row[0] * task.theta_0[j] : 0;
    result.r_min[at] = low - fixed;
    result.r_max[at++] = high - fixed;
  };
  for (Eigen::Index j = 0; j < r; ++j) {
    const double speed = joint_of(problem, j).velocity_max;
    for (const auto row : maps.speed.rowwise()) add(row, j, -speed, speed);
    for (const auto row : maps.place.rowwise()) {
      add(row, j, problem.theta_r_min[j], problem.theta_r_max[j]);
    }
    for (const auto row : maps.zero.rowwise()) add(row, j, 0, 0);
  }
  result.R.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace maxwrench
