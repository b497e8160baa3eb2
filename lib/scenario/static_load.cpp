#include "lib/scenario/static_load.h"

#include "maxwrench/posture.h"

namespace maxwrench {

void add_static_loads(const Robot& robot, const Posture& posture,
                      const std::vector<LinkLoad>& loads, double factor,
                      Eigen::Ref<Eigen::VectorXd> tau) {
  const Eigen::Vector3d pull = -robot.gravity * posture.base.R.row(2).transpose();
  const auto axes = static_cast<Eigen::Index>(robot.base_axes.size());
  for (const LinkLoad& load : loads) {
    const Pose<double>& frame = posture.links[static_cast<std::size_t>(load.link)];
    const double mass = factor * load.mass;
    const Eigen::Vector3d moment = factor * (frame.R * load.moment) + mass * frame.p;
    const Eigen::Vector3d turning = moment.cross(pull);
    for (Eigen::Index i = 0; i < axes; ++i) {
      const int axis = robot.base_axes[static_cast<std::size_t>(i)];
      tau[i] -= axis < 3 ? mass * pull[axis] : turning[axis - 3];
    }
    for (int link = load.link; link > 0;
         link = robot.joints[static_cast<std::size_t>(link - 1)].parent) {
      const Joint& joint = robot.joints[static_cast<std::size_t>(link - 1)];
      const Pose<double>& at = posture.links[static_cast<std::size_t>(link)];
      const Eigen::Vector3d axis = at.R * joint.axis;
      const Eigen::Vector3d arm = moment - mass * at.p;
      tau[axes + link - 1] -=
          joint.type == JointType::kRevolute ? axis.dot(arm.cross(pull)) : mass * axis.dot(pull);
    }
  }
}

Vector6d payload_wrench(const Robot& robot, const CarriedLoad& payload, const Eigen::Matrix3d& R) {
  const Eigen::Vector3d up(0, 0, robot.gravity);
  const Eigen::Vector3d arm = R * payload.moment;
  Vector6d c;
  c << payload.wet_mass * up, arm.cross(up);
  return c;
}

/// w'((x x arm) x up) = x'(arm x (up x w)) for a turn x.
Eigen::Vector3d payload_slope(const Robot& robot, const CarriedLoad& payload,
                              const Eigen::Matrix3d& R, const Eigen::Vector3d& w_e) {
  const Eigen::Vector3d up(0, 0, robot.gravity);
  const Eigen::Vector3d arm = R * payload.moment;
  return arm.cross(up.cross(w_e));
}

}  // namespace maxwrench
