#include "verify/gain.h"

#include <Eigen/SVD>

namespace maxwrench {
namespace {

/// The twist [linear; angular] of a point at p that moves about an axis through o, or along it.
Vector6d twist_of(const Eigen::Vector3d& axis, bool turns, const Eigen::Vector3d& o,
                  const Eigen::Vector3d& p) {
  Vector6d twist;
  if (turns) {
    twist << axis.cross(p - o), axis;
  } else {
    twist << axis, Eigen::Vector3d::Zero();
  }
  return twist;
}

/// The Jacobian of an end effector in base axes; its gains are the same in world axes.
Matrix6Xd jacobian_of(const Robot& robot, int end_effector,
                      const std::vector<Pose<double>>& links) {
  const EndEffector& tip = robot.end_effectors[static_cast<std::size_t>(end_effector)];
  const Eigen::Vector3d p = (links[static_cast<std::size_t>(tip.link)] * tip.placement).p;
  const auto axes = static_cast<Eigen::Index>(robot.base_axes.size());
  Matrix6Xd J = Matrix6Xd::Zero(6, robot.velocities());
  for (Eigen::Index i = 0; i < axes; ++i) {
    const int axis = robot.base_axes[static_cast<std::size_t>(i)];
    J.col(i) = twist_of(Eigen::Vector3d::Unit(axis % 3), axis >= 3, Eigen::Vector3d::Zero(), p);
  }
  for (auto link = static_cast<std::size_t>(tip.link); link > 0;) {
    const Joint& joint = robot.joints[link - 1];
    J.col(axes + static_cast<Eigen::Index>(link) - 1) =
        twist_of(links[link].R * joint.axis, joint.type == JointType::kRevolute, links[link].p, p);
    link = static_cast<std::size_t>(joint.parent);
  }
  return J;
}

bool turns_by(const Robot& robot, Eigen::Index velocity) {
  const auto at = static_cast<std::size_t>(velocity), axes = robot.base_axes.size();
  return at < axes ? robot.base_axes[at] >= 3
                   : robot.joints[at - axes].type == JointType::kRevolute;
}

}  // namespace

double contact_gain(const Problem& problem, const std::vector<Pose<double>>& links) {
  const Contact& contact = *problem.contact;
  if (contact.rank == 0) return 0;
  Eigen::MatrixXd J(6 + contact.rows(), problem.robot.velocities());
  J << jacobian_of(problem.robot, problem.end_effector, links),
      jacobian_of(problem.robot, contact.end_effector, links).topRows(contact.rows());
  for (Eigen::Index i = 0; i < J.cols(); ++i) {
    if (turns_by(problem.robot, i)) J.col(i) /= contact.length_scale;
  }
  for (Eigen::Index row = 3; row < J.rows(); ++row) {
    if (row % 6 >= 3) J.row(row) *= contact.length_scale;
  }
  const Eigen::VectorXd gains = Eigen::JacobiSVD<Eigen::MatrixXd>(J).singularValues();
  return gains[contact.rank - 1];
}

}  // namespace maxwrench
