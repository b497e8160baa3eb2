#include "cli/task/own_weight.h"

#include <algorithm>
#include <cmath>

#include "lib/math/decompositions.h"
#include "lib/math/random.h"
#include "lib/robot/chain.h"

namespace maxwrench {
namespace {

/// Axes in files are rounded; a load below this share is not one [-, N m].
constexpr double kRounding = 1e-6;

}  // namespace

OwnWeight own_weight(const Robot& robot, int samples) {
  const auto joints = static_cast<Eigen::Index>(robot.joints.size());
  OwnWeight result;
  if (joints == 0) return result;
  // The thrusters act on the base only.
  const Eigen::MatrixXd efforts =
      pseudo_inverse(robot.actuation.B.bottomRightCorner(joints, joints));
  Kinematics<double> kinematics(robot);
  Random random(1);
  Eigen::VectorXd q(joints), tau_d(robot.velocities()), most = Eigen::VectorXd::Zero(joints);
  int failed = 0;
  for (int sample = 0; sample < samples; ++sample) {
    draw_joints(robot, random, q);
    kinematics.set_joints(q);
    kinematics.gravity_and_buoyancy(robot.mount.R, tau_d);
    const Eigen::VectorXd u = (efforts * tau_d.tail(joints)).cwiseAbs();
    bool holds = true;
    for (Eigen::Index i = 0; i < joints; ++i) {
      const double limit = robot.joints[static_cast<std::size_t>(i)].effort_max;
      holds = holds && u[i] <= limit + kRounding * (1 + limit);
    }
    failed += holds ? 0 : 1;
    most = most.cwiseMax(u);
  }
  result.share = static_cast<double>(failed) / samples;
  double worst = -1;
  for (Eigen::Index i = 0; i < joints; ++i) {
    const double limit = robot.joints[static_cast<std::size_t>(i)].effort_max;
    const double load = most[i] > kRounding ? most[i] / limit : 0;
    if (load <= worst) continue;
    worst = load;
    result.weakest = static_cast<int>(i);
    result.needed = most[i];
  }
  return result;
}

}  // namespace maxwrench
