#include "solvers/certify/trajectory/instant_ranges.h"

#include <algorithm>
#include <cmath>

#include "lib/trajectory/limits.h"
#include "maxwrench/lp_solver.h"
#include "solvers/lp/makers.h"

namespace maxwrench {
namespace {

/// More than the rounding errors of a sum over the knots, as a share of its terms.
constexpr double kRangeRounding = 1e-12;

/// The most that x or y times a number within limits can be.
double most_of(double slope, double low, double high) {
  return slope == 0 ? 0 : std::max(slope * low, slope * high);
}

/// The knots of one coordinate of theta_r within the limits of a task.
class KnotProgram {
 public:
  KnotProgram(const Problem& problem, const SchemeMaps& maps, Eigen::Index j)
      : solver_(make_simplex()) {
    const auto K = static_cast<Eigen::Index>(maps.knots());
    const double low = problem.theta_r_min[j] - kTableTolerance;
    const double high = problem.theta_r_max[j] + kTableTolerance;
    const auto joint = static_cast<std::size_t>(problem.redundant[static_cast<std::size_t>(j)]);
    const double speed = problem.robot.joints[joint].velocity_max + kTableTolerance;
    S_.resize(0, K);
    add(maps.zero, -kTableTolerance, kTableTolerance);
    if (std::isfinite(speed)) add(maps.speed, -speed, speed);
    add(maps.place, low, high);
    low_.setConstant(K, low);
    high_.setConstant(K, high);
    if (maps.before > 0) low_[0] = high_[0] = problem.motion->theta_0[j];
    const Eigen::Index rows = S_.rows();
    program_.b = Eigen::VectorXd::Zero(rows);
    Eigen::MatrixXd A(rows, K + rows);
    A << S_, -Eigen::MatrixXd::Identity(rows, rows);
    program_.A = A.sparseView();
    program_.A.makeCompressed();
    program_.l.resize(K + rows);
    program_.u.resize(K + rows);
    program_.l << low_, s_low_;
    program_.u << high_, s_high_;
  }

  /// No table has a larger a'Q.
  double most(const Eigen::VectorXd& a) {
    program_.c = Eigen::VectorXd::Zero(program_.A.cols());
    program_.c.head(a.size()) = a;
    LpSolution solution;
    solver_->solve(program_, solution);
    double least = value(a, Eigen::VectorXd::Zero(S_.rows()));
    if (solution.lambda.size() == S_.rows() && solution.lambda.allFinite()) {
      least = std::min(least, value(a, solution.lambda));
    }
    return least;
  }

 private:
  void add(const Eigen::MatrixXd& rows, double low, double high) {
    const Eigen::Index first = S_.rows(), count = rows.rows();
    S_.conservativeResize(first + count, Eigen::NoChange);
    S_.bottomRows(count) = rows;
    s_low_.conservativeResize(first + count);
    s_high_.conservativeResize(first + count);
    s_low_.tail(count).setConstant(low);
    s_high_.tail(count).setConstant(high);
  }

  /// The bound of a multiplier, which may have either sign.
  double value(const Eigen::VectorXd& a, const Eigen::VectorXd& y) const {
    double sum = 0, sizes = 0;
    const auto take = [&](double slope, double low, double high) {
      sum += most_of(slope, low, high);
      sizes += std::abs(slope) * std::max(std::abs(low), std::abs(high));
    };
    const Eigen::VectorXd rest = a - S_.transpose() * y;
    const Eigen::VectorXd rest_sizes = a.cwiseAbs() + S_.cwiseAbs().transpose() * y.cwiseAbs();
    for (Eigen::Index j = 0; j < rest.size(); ++j) {
      take(rest[j], low_[j], high_[j]);
      sizes += rest_sizes[j] * std::max(std::abs(low_[j]), std::abs(high_[j]));
    }
    for (Eigen::Index i = 0; i < y.size(); ++i) take(y[i], s_low_[i], s_high_[i]);
    return sum + kRangeRounding * sizes;
  }

  std::unique_ptr<LpSolver> solver_;
  LinearProgram program_;
  Eigen::MatrixXd S_;
  Eigen::VectorXd low_, high_, s_low_, s_high_;
};

}  // namespace

InstantRanges ranges_at(const Problem& problem, const SchemeMaps& maps, int instant) {
  InstantRanges ranges;
  const auto r = static_cast<Eigen::Index>(problem.redundancy());
  for (NumberRanges* each : {&ranges.place, &ranges.rate, &ranges.bend}) {
    each->low.resize(r);
    each->high.resize(r);
  }
  for (Eigen::Index j = 0; j < r; ++j) {
    KnotProgram knots(problem, maps, j);
    const auto find = [&](const Eigen::MatrixXd& map, NumberRanges& range) {
      const Eigen::VectorXd row = map.row(instant).transpose();
      range.low[j] = -knots.most(-row);
      range.high[j] = knots.most(row);
    };
    find(maps.P, ranges.place);
    find(maps.V, ranges.rate);
    find(maps.A, ranges.bend);
  }
  return ranges;
}

}  // namespace maxwrench
