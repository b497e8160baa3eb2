#include "tests/mechanics.h"

#include "lib/kinematics.h"

namespace maxwrench {

void move(const Robot& robot, int i, double step, Pose<double>& base, Eigen::VectorXd& q) {
  const int axes = static_cast<int>(robot.base_axes.size());
  if (i >= axes) {
    q[i - axes] += step;
    return;
  }
  const Eigen::Vector3d direction = Eigen::Vector3d::Unit(robot.base_axes[i] % 3);
  if (robot.base_axes[i] < 3) {
    base.p += step * base.R * direction;
  } else {
    base.R = base.R * Eigen::AngleAxisd(step, direction).toRotationMatrix();
  }
}

double potential_energy(const Robot& robot, const Pose<double>& base, const Eigen::VectorXd& q) {
  Kinematics<double> kinematics(robot);
  kinematics.set_joints(q);
  double moment = -robot.trim.buoyancy_mass * (base.R * robot.trim.position + base.p).z();
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    const Pose<double> pose = base * kinematics.links()[i];
    const Link& link = robot.links[i];
    moment += link.mass * (pose.R * link.com + pose.p).z() -
              robot.water_density * link.volume * (pose.R * link.cob + pose.p).z();
  }
  return robot.gravity * moment;
}

Eigen::VectorXd potential_energy_slopes(const Robot& robot, const Pose<double>& base,
                                        const Eigen::VectorXd& q, double step) {
  Eigen::VectorXd slopes(robot.velocities());
  for (int i = 0; i < robot.velocities(); ++i) {
    double energy[2] = {};
    for (int side = 0; side < 2; ++side) {
      Pose<double> moved = base;
      Eigen::VectorXd q_side = q;
      move(robot, i, side ? step : -step, moved, q_side);
      energy[side] = potential_energy(robot, moved, q_side);
    }
    slopes[i] = (energy[1] - energy[0]) / (2 * step);
  }
  return slopes;
}

}  // namespace maxwrench
