#include "lib/trajectory/overshoot.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lib/math/cubic_spline.h"
#include "lib/trajectory/carried.h"
#include "lib/trajectory/motion_evaluator.h"

namespace maxwrench {
namespace {

/// The largest share of its limits that a load (f numbers, on the normals) uses.
double share_of(const Zonotope& set, const Eigen::VectorXd& loads) {
  double share = 0;
  for (Eigen::Index j = 0; j < loads.size(); ++j) {
    const double limit = loads[j] > 0 ? set.b_max[j] : set.b_min[j];
    if (loads[j] != 0) share = std::max(share, loads[j] / limit);
  }
  return share;
}

/// y(s) = y + y' s + y'' s^2/2 + y''' s^3/6 on 0 <= s <= h.
struct Cubic {
  double value, rate, bend, jerk, h;

  double at(double s) const { return value + s * (rate + s * (bend / 2 + s * jerk / 6)); }
  double rate_at(double s) const { return rate + s * (bend + s * jerk / 2); }
  /// The ends, where the second derivative vanishes, and where the first one does.
  std::vector<double> extremes() const {
    std::vector<double> points = {0, h};
    if (jerk != 0) points.push_back(-bend / jerk);
    const double root = bend * bend - 2 * jerk * rate;
    if (root >= 0) {
      // Both roots of jerk/2 s^2 + bend s + rate, without cancellation.
      const double sum = -(bend + std::copysign(std::sqrt(root), bend));
      if (jerk != 0) points.push_back(sum / jerk);
      if (sum != 0) points.push_back(2 * rate / sum);
    }
    std::erase_if(points, [this](double s) { return !(s >= 0 && s <= h); });
    return points;
  }
};

}  // namespace

double overshoot_of(const Problem& problem, const Eigen::MatrixXd& Q, double mass) {
  const Zonotope& set = problem.robot.actuation;
  if (!set.has_facets) return std::numeric_limits<double>::quiet_NaN();
  MotionEvaluator motion(problem, make_dense_spline(*problem.motion, kOvershootInstants));
  std::vector<Instant> instants;
  motion.evaluate(Q, instants);
  double share = 0;
  for (std::size_t i = 0; i < instants.size(); ++i) {
    const Instant& instant = instants[i];
    const Vector6d c =
        factored_wrench(problem.robot, *problem.motion, instant.t, motion.maps().x[i]);
    const Eigen::VectorXd tau = instant.tau_d + mass * (instant.J.transpose() * c);
    const Eigen::VectorXd loads = set.N.transpose() * tau;
    if (problem.scenarios.empty()) share = std::max(share, share_of(set, loads));
    for (const ScenarioLimits& limits : problem.scenarios.limits) {
      share = std::max(share, share_of(limits.actuation, loads));
    }
  }
  return share - 1;
}

JointOvershoot joint_overshoot_of(const Problem& problem, const Eigen::MatrixXd& Q, double T) {
  const Eigen::Index intervals = Q.rows() - 1;
  std::vector<double> times;
  for (Eigen::Index i = 0; i <= intervals; ++i) {
    times.push_back(T * static_cast<double>(i) / static_cast<double>(intervals));
  }
  const Eigen::MatrixXd bends = clamped_spline_bends(times, Q.transpose());
  JointOvershoot most{-1, -kInfinity};
  for (Eigen::Index j = 0; j < Q.cols(); ++j) {
    const auto number = static_cast<std::size_t>(problem.redundant[static_cast<std::size_t>(j)]);
    const double fastest = problem.robot.joints[number].velocity_max;
    for (Eigen::Index i = 0; i < intervals; ++i) {
      const double h = times[static_cast<std::size_t>(i) + 1] - times[static_cast<std::size_t>(i)];
      const double bend = bends(j, i), next = bends(j, i + 1);
      const Cubic y{Q(i, j), (Q(i + 1, j) - Q(i, j)) / h - h / 6 * (2 * bend + next), bend,
                    (next - bend) / h, h};
      for (const double s : y.extremes()) {
        most.speed = std::max(most.speed, std::abs(y.rate_at(s)) / fastest - 1);
        most.place = std::max(
            {most.place, y.at(s) - problem.theta_r_max[j], problem.theta_r_min[j] - y.at(s)});
      }
    }
  }
  return most;
}

}  // namespace maxwrench
