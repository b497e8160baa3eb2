#include "lib/robot/chain.h"

#include <algorithm>
#include <cmath>

#include "lib/math/decompositions.h"

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

int motions_of(const Robot& robot, int end_effector) {
  Matrix6Xd J(6, robot.velocities());
  if (J.cols() == 0) return 0;
  return generic_rank(robot, [&](const Kinematics<double>& kinematics) {
    // The pose of the base does not change the rank.
    kinematics.jacobian(robot.end_effectors[static_cast<std::size_t>(end_effector)],
                        Eigen::Matrix3d::Identity(), J);
    return split(J, kRankTolerance).range.cols();
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

}  // namespace maxwrench
