#include "lib/robot/chain.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lib/math/decompositions.h"
#include "lib/robot/gears.h"

namespace maxwrench {

std::vector<int> chain_to(const Robot& robot, int end_effector) {
  std::vector<int> chain;
  int link = robot.end_effectors[static_cast<std::size_t>(end_effector)].link;
  while (link > 0) {  // link i is moved by joint i - 1
    chain.push_back(link - 1);
    link = robot.joints[static_cast<std::size_t>(link - 1)].parent;
  }
  std::reverse(chain.begin(), chain.end());
  return chain;
}

std::vector<int> motors_to(const Robot& robot, int end_effector) {
  std::vector<int> motors;
  for (const int joint : chain_to(robot, end_effector)) {
    const auto& gear = robot.joints[static_cast<std::size_t>(joint)].gear;
    const int motor = gear ? gear->leader : joint;
    if (std::find(motors.begin(), motors.end(), motor) == motors.end()) motors.push_back(motor);
  }
  return motors;
}

std::vector<int> gears_at(const Robot& robot, int end_effector) {
  const std::vector<int> chain = chain_to(robot, end_effector);
  const auto in_chain = [&chain](int joint) {
    return std::find(chain.begin(), chain.end(), joint) != chain.end();
  };
  std::vector<int> found;
  for (int i = 0; i < static_cast<int>(robot.joints.size()); ++i) {
    const auto& gear = robot.joints[static_cast<std::size_t>(i)].gear;
    if (gear && (in_chain(i) || in_chain(gear->leader))) found.push_back(i);
  }
  return found;
}

std::vector<int> leaders_to(const Robot& robot, int end_effector) {
  std::vector<int> leaders;
  for (const int joint : chain_to(robot, end_effector)) {
    const auto& gear = robot.joints[static_cast<std::size_t>(joint)].gear;
    if (gear && std::find(leaders.begin(), leaders.end(), gear->leader) == leaders.end()) {
      leaders.push_back(gear->leader);
    }
  }
  return leaders;
}

void fold_gears(const Robot& robot, Matrix6Xd& J) {
  const auto axes = static_cast<Eigen::Index>(robot.base_axes.size());
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const auto& gear = robot.joints[i].gear;
    if (!gear) continue;
    const Eigen::Index column = axes + static_cast<Eigen::Index>(i);
    J.col(axes + gear->leader) += gear->ratio * J.col(column);
    J.col(column).setZero();
  }
}

std::vector<int> carried_by(const Robot& robot, const std::vector<int>& joints) {
  std::vector<char> moves(robot.links.size(), 0);
  for (const int joint : joints) moves[static_cast<std::size_t>(joint) + 1] = 1;
  std::vector<int> carried;
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    moves[i + 1] |= moves[static_cast<std::size_t>(robot.joints[i].parent)];
    if (moves[i + 1]) carried.push_back(static_cast<int>(i));
  }
  return carried;
}

int motions_of(const Robot& robot, int end_effector) {
  std::vector<int> all(static_cast<std::size_t>(robot.velocities()));
  std::iota(all.begin(), all.end(), 0);
  return motions_of(robot, end_effector, all);
}

int motions_of(const Robot& robot, int end_effector, const std::vector<int>& velocities) {
  Matrix6Xd J(6, robot.velocities());
  if (velocities.empty()) return 0;
  return generic_rank(robot, [&](const Kinematics<double>& kinematics) {
    // The rank does not depend on the pose of the base.
    kinematics.jacobian(robot.end_effectors[static_cast<std::size_t>(end_effector)],
                        Eigen::Matrix3d::Identity(), J);
    fold_gears(robot, J);
    return split(J(Eigen::all, velocities), kRankTolerance).range.cols();
  });
}

Pose<double> base_pose(const Robot& robot, const Eigen::Vector4d& x) {
  Pose<double> local;
  local.R(0, 0) = local.R(1, 1) = std::cos(x[3]);
  local.R(1, 0) = std::sin(x[3]);
  local.R(0, 1) = -local.R(1, 0);
  local.p = x.head<3>();
  return robot.mount * local;
}

bool base_reaches(const Robot& robot, const Pose<double>& in_world) {
  if (robot.base_axes.size() == 6) return true;
  const Pose<double> base = robot.mount.inverse() * in_world;
  const auto is_free = [&](int axis) {
    return std::find(robot.base_axes.begin(), robot.base_axes.end(), axis) != robot.base_axes.end();
  };
  for (int axis = 0; axis < 3; ++axis) {
    if (!is_free(axis) && std::abs(base.p[axis]) > kReachTolerance) return false;
  }
  if (is_free(3)) return true;
  if (std::abs(base.R(2, 2) - 1) > kReachTolerance) return false;
  return is_free(5) || std::abs(base.R(0, 0) - 1) <= kReachTolerance;
}

Eigen::VectorXd resting_joints(const Robot& robot) {
  Eigen::VectorXd q(robot.joints.size());
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const Joint& joint = robot.joints[static_cast<std::size_t>(i)];
    q[i] = std::clamp(0.0, joint.q_min, joint.q_max);
  }
  apply_gears(robot, q);
  return q;
}

void draw_joints(const Robot& robot, Random& random, Eigen::VectorXd& q) {
  q.resize(static_cast<Eigen::Index>(robot.joints.size()));
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const Joint& joint = robot.joints[static_cast<std::size_t>(i)];
    q[i] = random.uniform(joint.q_min, joint.q_max);
  }
  apply_gears(robot, q);
}

int find_joint(const Robot& robot, const std::string& name) {
  const auto found = std::find_if(robot.joints.begin(), robot.joints.end(),
                                  [&name](const Joint& joint) { return joint.name == name; });
  return found == robot.joints.end() ? -1 : static_cast<int>(found - robot.joints.begin());
}

const std::string& actuator_name(const Robot& robot, Eigen::Index i) {
  const auto at = static_cast<std::size_t>(i);
  const std::size_t thrusters = robot.thrusters.size();
  return at < thrusters ? robot.thrusters[at].name : robot.joints[at - thrusters].name;
}

Pose<double> pose_at_mount(const Robot& robot, int end_effector, const Eigen::VectorXd& q) {
  Kinematics<double> kinematics(robot);
  kinematics.set_joints(q);
  return robot.mount *
         kinematics.end_effector(robot.end_effectors[static_cast<std::size_t>(end_effector)]);
}

void apply_gears(const Robot& robot, Eigen::VectorXd& q) {
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const std::optional<Gear>& gear = robot.joints[static_cast<std::size_t>(i)].gear;
    if (gear) q[i] = gear->ratio * q[gear->leader] + gear->offset;
  }
}

}  // namespace maxwrench
