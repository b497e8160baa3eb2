#include "tests/kdl_chain.h"

namespace maxwrench {
namespace {

KDL::Frame frame(const Pose<double>& pose) {
  KDL::Frame f;
  for (int r = 0; r < 3; ++r) {
    f.p[r] = pose.p[r];
    for (int c = 0; c < 3; ++c) f.M(r, c) = pose.R(r, c);
  }
  return f;
}

KDL::Vector vector(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

KDL::Chain kdl_chain(const Robot& robot) {
  KDL::Chain chain;
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    // KDL applies the joint before the segment's tip frame: the placement is a fixed segment of its
    // own.
    const Joint& joint = robot.joints[i];
    const Link& link = robot.links[i + 1];
    chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::None), frame(joint.placement)));
    const auto type =
        joint.type == JointType::kRevolute ? KDL::Joint::RotAxis : KDL::Joint::TransAxis;
    chain.addSegment(KDL::Segment(KDL::Joint("j", KDL::Vector::Zero(), vector(joint.axis), type),
                                  KDL::Frame::Identity(),
                                  KDL::RigidBodyInertia(link.mass, vector(link.com))));
  }
  chain.addSegment(
      KDL::Segment(KDL::Joint(KDL::Joint::None), frame(robot.end_effectors[0].placement)));
  return chain;
}

}  // namespace maxwrench
