#include "lib/path/clearance.h"

#include "lib/robot/chain.h"
#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

/// m: less is rounding, which shall not choose among instants at which nothing moved.
constexpr double kNearer = 1e-9;

bool carries(const Robot& robot, int joint, int link) {
  while (link > 0) {
    if (link - 1 == joint) return true;
    link = robot.joints[static_cast<std::size_t>(link - 1)].parent;
  }
  return false;
}

/// Velocity of a point on a link per rate of a joint, in base axes.
Eigen::Vector3d velocity(const Robot& robot, const Kinematics<double>& kinematics, int joint,
                         int link, const Eigen::Vector3d& point) {
  if (!carries(robot, joint, link)) return Eigen::Vector3d::Zero();
  const auto i = static_cast<std::size_t>(joint);
  const Eigen::Vector3d axis = kinematics.joint_axis(i);
  if (robot.joints[i].type == JointType::kPrismatic) return axis;
  return axis.cross(point - kinematics.links()[i + 1].p);
}

}  // namespace

void find_near_pairs(const Problem& problem, const Kinematics<double>& kinematics, int knot,
                     double within, std::vector<NearPair>& pairs) {
  const CollisionChecker& checker = *problem.robot.collision;
  Nearness near;
  for (int pair = 0; pair < checker.pairs(); ++pair) {
    if (!checker.nearest(kinematics.links(), pair, near) || near.clearance > within) continue;
    const Eigen::Vector3d between = near.on_a - near.on_b;
    if (between.norm() == 0) continue;  // no derivative
    const Eigen::Vector3d apart = between.normalized();
    NearPair& added = pairs.emplace_back();
    added.knot = knot;
    added.clearance = near.clearance;
    added.gradient.resize(problem.redundancy());
    for (Eigen::Index k = 0; k < added.gradient.size(); ++k) {
      const int joint = problem.redundant[static_cast<std::size_t>(k)];
      added.gradient[k] =
          apart.dot(velocity(problem.robot, kinematics, joint, near.link_a, near.on_a) -
                    velocity(problem.robot, kinematics, joint, near.link_b, near.on_b));
    }
  }
}

std::optional<Clearance> find_least_clearance(const Problem& problem, const std::vector<double>& t,
                                              const Eigen::MatrixXd& theta_r,
                                              Kinematics<double>& kinematics) {
  const CollisionChecker& checker = *problem.robot.collision;
  Clearance found{kInfinity, 0, ""};
  int nearest = -1;
  Nearness near;
  Eigen::VectorXd q = resting_joints(problem.robot);
  for (std::size_t i = 0; i < t.size(); ++i) {
    q(problem.redundant) = theta_r.row(static_cast<Eigen::Index>(i));
    kinematics.set_joints(q);
    const int colliding = checker.colliding_pair(kinematics.links());
    for (int pair = 0; pair < checker.pairs(); ++pair) {
      const bool known = checker.nearest(kinematics.links(), pair, near);
      if (!known && pair != colliding) continue;
      const double clearance = known ? near.clearance : 0;
      if (!(clearance < found.least - kNearer)) continue;
      found.least = clearance;
      found.t = t[i];
      nearest = pair;
    }
  }
  if (nearest < 0) return {};
  found.pair = checker.pair_name(nearest);
  return found;
}

}  // namespace maxwrench
