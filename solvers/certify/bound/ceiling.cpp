#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solvers/certify/bound/bounds.h"
#include "solvers/certify/bound/loop_model.h"
#include "solvers/certify/bound/thrust_points.h"

namespace maxwrench {

namespace {

/// All postures for which a ceiling holds.
Problem with_margin(const Problem& problem) {
  Problem wide = problem;
  wide.theta_r_min.array() -= kCeilingMargin;
  wide.theta_r_max.array() += kCeilingMargin;
  return wide;
}

}  // namespace

CeilingSizes ceiling_sizes(const Problem& problem) {
  Problem wide = with_margin(problem);
  wide.robot.base_axes = {0, 1, 2, 3, 4, 5};
  const LoopModel model(wide);
  return {model.tau.head<6>(), model.a.head<6>()};
}

double braced_ceiling(const Problem& problem) {
  if (!problem.c.head<3>().isZero(0)) return kInfinity;
  const Problem wide = with_margin(problem);
  const LoopModel model(wide, ContactForces::kOfBase);
  const ThrustPoints thrust(model, problem.robot.actuation,
                            static_cast<Eigen::Index>(problem.robot.thrusters.size()));
  const Eigen::Vector3d torque = (model.tau + thrust.sizes()).segment<3>(3);
  return torque.norm() / problem.c.norm() * (1 + kCeilingRounding);
}

double pure_ceiling(const Problem& problem, const Vector6d& c, const Zonotope& set,
                    const CeilingSizes& sizes) {
  constexpr double kLeastLength2 = 1e-6;
  const bool pushes = !c.head<3>().isZero(0);
  const int kind = pushes ? 0 : 3;
  std::vector<int> rows;
  Eigen::Array3d taken = sizes.a.segment<3>(kind).array().square();
  double load2 = 0;
  for (std::size_t i = 0; i < problem.robot.base_axes.size(); ++i) {
    const int axis = problem.robot.base_axes[i] - kind;
    if (axis < 0 || axis >= 3) continue;
    rows.push_back(static_cast<int>(i));
    taken[axis] = 0;
    load2 += sizes.tau[kind + axis] * sizes.tau[kind + axis];
  }
  const double length2 = c.segment<3>(kind).squaredNorm() - taken.sum();
  if (rows.empty() || !(length2 > kLeastLength2)) {
    throw std::invalid_argument(problem.name +
                                ": wrench.c: got a direction that the base's free axes do not "
                                "limit, expected one that they limit in all postures, for a proof");
  }
  double force = std::sqrt(load2);
  for (Eigen::Index k = 0; k < set.actuators(); ++k) {
    force += std::max(std::abs(set.u_min[k]), std::abs(set.u_max[k])) * set.B.col(k)(rows).norm();
  }
  return force / std::sqrt(length2) * (1 + kCeilingRounding);
}

}  // namespace maxwrench
