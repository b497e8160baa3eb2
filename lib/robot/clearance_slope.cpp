#include "lib/robot/clearance_slope.h"

namespace maxwrench {
namespace {

bool carries(const Robot& robot, int joint, int link) {
  while (link > 0) {
    if (link - 1 == joint) return true;
    link = robot.joints[static_cast<std::size_t>(link - 1)].parent;
  }
  return false;
}

/// Velocity of a point on a link per rate of a joint, in base axes.
Eigen::Vector3d point_velocity(const Robot& robot, const std::vector<Pose<double>>& links,
                               int joint, int link, const Eigen::Vector3d& point) {
  if (!carries(robot, joint, link)) return Eigen::Vector3d::Zero();
  const auto i = static_cast<std::size_t>(joint);
  const Eigen::Vector3d axis = links[i + 1].R * robot.joints[i].axis;
  if (robot.joints[i].type == JointType::kPrismatic) return axis;
  return axis.cross(point - links[i + 1].p);
}

}  // namespace

double clearance_slope(const Robot& robot, const std::vector<Pose<double>>& links,
                       const ClosestPoints& near, int joint) {
  const Eigen::Vector3d apart = (near.on_a - near.on_b).normalized();
  return apart.dot(point_velocity(robot, links, joint, near.link_a, near.on_a) -
                   point_velocity(robot, links, joint, near.link_b, near.on_b));
}

}  // namespace maxwrench
