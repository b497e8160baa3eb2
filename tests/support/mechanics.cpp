#include "tests/support/mechanics.h"

#include "lib/robot/kinematics.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

Vector6d random_coefficients(Random& random, double scale) {
  return Vector6d::NullaryExpr([&] { return random.uniform(0, scale); });
}

/// The twist [linear; angular] of a frame on a link, at its origin and in its axes.
Vector6d twist_of(const Robot& robot, const Eigen::VectorXd& q, const Eigen::VectorXd& v, int link,
                  const Pose<double>& frame) {
  Kinematics<double> kinematics(robot);
  kinematics.set_joints(q);
  Matrix6Xd J(6, robot.velocities());
  kinematics.jacobian({"", link, frame}, Eigen::Matrix3d::Identity(), J);
  const Eigen::Matrix3d R = kinematics.links()[link].R * frame.R;
  Vector6d twist = J * v;
  twist << R.transpose() * twist.head<3>(), R.transpose() * twist.tail<3>();
  return twist;
}

}  // namespace

Eigen::VectorXd random_numbers(Random& random, int size) {
  return Eigen::VectorXd::NullaryExpr(size, [&] { return random.normal(); });
}

Robot random_wet_robot(Random& random, int joints) {
  Robot robot = random_problem(random, joints).robot;
  robot.trim = {random.uniform(-2, 2), random_vector(random, 0.2)};
  for (int i = 3; i < joints; ++i) {
    robot.joints[i].parent = static_cast<int>(random.uniform(0, i + 1));
  }
  for (int i = 0; i <= joints; ++i) {
    Link& link = robot.links[i];
    // A body's moments of inertia are sums of two of sum_k m_k x_k^2, ..., so none exceeds the sum
    // of the other two.
    const Eigen::Vector3d squares = random_coefficients(random, 0.05).head<3>();
    const Eigen::Vector3d moments =
        Eigen::Vector3d::Constant(squares.sum()) - squares + Eigen::Vector3d::Constant(1e-3);
    const Eigen::Matrix3d R = random_rotation(random);
    link.inertia = R * moments.asDiagonal() * R.transpose();
    for (int body = 0; body < (i == 0 ? 2 : i == 1 ? 0 : 1); ++body) {
      link.hydrodynamics.push_back({{random_rotation(random), random_vector(random, 0.1)},
                                    random_coefficients(random, 2),
                                    random_coefficients(random, 3),
                                    random_coefficients(random, 5)});
    }
  }
  return robot;
}

Robot random_dry_robot(Random& random, int joints) {
  Robot robot = random_wet_robot(random, joints);
  robot.water_density = 0;
  robot.trim = {};
  for (Link& link : robot.links) link.hydrodynamics.clear();
  return robot;
}

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

double kinetic_energy(const Robot& robot, const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  double sum = 0;
  for (int i = 0; i < static_cast<int>(robot.links.size()); ++i) {
    const Link& link = robot.links[i];
    const Vector6d at_com = twist_of(robot, q, v, i, {Eigen::Matrix3d::Identity(), link.com});
    sum += link.mass * at_com.head<3>().squaredNorm() +
           at_com.tail<3>().dot(link.inertia * at_com.tail<3>());
    for (const HydrodynamicBody& body : link.hydrodynamics) {
      sum += body.added_mass.dot(twist_of(robot, q, v, i, body.frame).cwiseAbs2());
    }
  }
  return sum / 2;
}

double drag_power(const Robot& robot, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                  const Eigen::VectorXd& u) {
  double sum = 0;
  for (int i = 0; i < static_cast<int>(robot.links.size()); ++i) {
    for (const HydrodynamicBody& body : robot.links[i].hydrodynamics) {
      const Vector6d twist = twist_of(robot, q, v, i, body.frame);
      const Vector6d slope =
          body.damping_linear + body.damping_quadratic.cwiseProduct(twist.cwiseAbs());
      sum += slope.cwiseProduct(twist).dot(twist_of(robot, q, u, i, body.frame));
    }
  }
  return sum;
}

}  // namespace maxwrench
