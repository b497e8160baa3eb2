#include "lib/tank/reference.h"

#include <algorithm>
#include <stdexcept>

#include "maxwrench/trajectory.h"

namespace maxwrench {
ScriptReader::ScriptReader(const Problem& problem, const TankScript& script)
    : problem_(problem), script_(script) {
  const auto without = [](const Instant& instant) { return instant.u.size() == 0; };
  if (script.instants.size() < 2 ||
      std::any_of(script.instants.begin(), script.instants.end(), without)) {
    throw std::invalid_argument("script: got no efforts to track, expected those of two instants");
  }
}

Eigen::Matrix3d ScriptReader::turn(const Eigen::Matrix3d& R) const {
  if (!problem_.motion->c_turns) return Eigen::Matrix3d::Identity();
  return R * script_.path.pose(0).R.transpose();
}

/// The entries of theta_r in all velocities.
Eigen::VectorXd ScriptReader::of_theta_r(const Eigen::VectorXd& velocities) const {
  const auto joints = static_cast<Eigen::Index>(problem_.robot.joints.size());
  return velocities.tail(joints)(problem_.redundant);
}

void ScriptReader::read(double t, Reference& reference) const {
  const std::vector<Instant>& all = script_.instants;
  const auto after = std::upper_bound(all.begin() + 1, all.end() - 1, t,
                                      [](double at, const Instant& each) { return at < each.t; });
  const auto to = static_cast<std::size_t>(after - all.begin());
  const double dt = all[to].t - all[to - 1].t;
  const double z = std::clamp((t - all[to - 1].t) / dt, 0.0, 1.0);
  reference.x = script_.path.at(t);
  reference.turn = turn(reference.x.pose.R);
  reference.c = rotated(reference.turn, problem_.c);
  // Wrenches in axes that turn like c.
  const auto own = [&](const Instant& instant) {
    return rotated(turn(instant.end_effector.R).transpose(), instant.h);
  };
  reference.h = rotated(reference.turn, (1 - z) * own(all[to - 1]) + z * own(all[to]));
  reference.u = (1 - z) * all[to - 1].u + z * all[to].u;
  join(to - 1, z, dt, reference);
}

/// theta_r and its derivatives at z in [0, 1] between two instants.
void ScriptReader::join(std::size_t from, double z, double dt, Reference& reference) const {
  const Instant &a = script_.instants[from], &b = script_.instants[from + 1];
  const Eigen::VectorXd start = a.q(problem_.redundant), end = b.q(problem_.redundant);
  const Eigen::VectorXd slope = (end - start) / dt;
  if (script_.interpolation == Interpolation::kLinear) {
    reference.theta_r = start + z * dt * slope;
    reference.rate = slope;
    reference.acceleration = (1 - z) * of_theta_r(a.v_dot) + z * of_theta_r(b.v_dot);
    return;
  }
  // Hermite basis about the chord.
  const Eigen::VectorXd first = of_theta_r(a.v) - slope, last = of_theta_r(b.v) - slope;
  const double y = 1 - z;
  reference.theta_r = start + dt * (z * slope + z * y * y * first - z * z * y * last);
  reference.rate = slope + y * (1 - 3 * z) * first + z * (3 * z - 2) * last;
  reference.acceleration = ((6 * z - 4) * first + (6 * z - 2) * last) / dt;
}

}  // namespace maxwrench
