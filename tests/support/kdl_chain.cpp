#include "tests/support/kdl_chain.h"

namespace maxwrench {
namespace {

KDL::Vector to_kdl(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

KDL::Frame to_kdl(const Pose<double>& pose) {
  KDL::Frame frame;
  frame.p = to_kdl(pose.p);
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) frame.M(r, c) = pose.R(r, c);
  }
  return frame;
}

KDL::RigidBodyInertia to_kdl(const Link& link) {
  const Eigen::Matrix3d& I = link.inertia;
  return KDL::RigidBodyInertia(
      link.mass, to_kdl(link.com),
      KDL::RotationalInertia(I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)));
}

/// KDL turns a joint before it applies the segment's frame, so a placement needs a segment of its
/// own.
void add_arm(const Robot& robot, KDL::Chain& chain) {
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const Joint& joint = robot.joints[i];
    chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::None), to_kdl(joint.placement)));
    const auto type =
        joint.type == JointType::kRevolute ? KDL::Joint::RotAxis : KDL::Joint::TransAxis;
    chain.addSegment(KDL::Segment(KDL::Joint("j", KDL::Vector::Zero(), to_kdl(joint.axis), type),
                                  KDL::Frame::Identity(), to_kdl(robot.links[i + 1])));
  }
  chain.addSegment(
      KDL::Segment(KDL::Joint(KDL::Joint::None), to_kdl(robot.end_effectors[0].placement)));
}

}  // namespace

KDL::Chain kdl_chain(const Robot& robot) {
  KDL::Chain chain;
  add_arm(robot, chain);
  return chain;
}

KDL::Chain floating_kdl_chain(const Robot& robot) {
  KDL::Chain chain;
  for (const auto type : {KDL::Joint::TransX, KDL::Joint::TransY, KDL::Joint::TransZ,
                          KDL::Joint::RotZ, KDL::Joint::RotY}) {
    chain.addSegment(KDL::Segment(KDL::Joint(type)));
  }
  chain.addSegment(
      KDL::Segment(KDL::Joint(KDL::Joint::RotX), KDL::Frame::Identity(), to_kdl(robot.links[0])));
  add_arm(robot, chain);
  return chain;
}

}  // namespace maxwrench
