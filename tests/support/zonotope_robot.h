#pragma once

#include "maxwrench/posture.h"
#include "maxwrench/problem.h"
#include "tests/support/support.h"

namespace maxwrench {

/// A robot without geometry in a posture given by its numbers: any B, J and tau_d.
struct ZonotopeRobot {
  Problem problem;
  Posture posture;

  /// Limits -1 to 1 of all efforts; J has the identity in its first rows, and the rest is zero.
  explicit ZonotopeRobot(const Eigen::MatrixXd& B) {
    const Eigen::Index n = B.rows(), m = B.cols();
    problem.name = "zonotope";
    problem.robot.name = "zonotope";
    problem.robot.joints.resize(static_cast<std::size_t>(n));
    problem.c = Vector6d::Unit(0);
    problem.W_any = Matrix6Xd::Identity(6, n);
    posture.status = Status::kValid;
    posture.J = Matrix6Xd::Identity(6, n);
    posture.tau_d = Eigen::VectorXd::Zero(n);
    set_limits(B, Eigen::VectorXd::Constant(m, -1), Eigen::VectorXd::Constant(m, 1));
  }
  void set_limits(const Eigen::MatrixXd& B, const Eigen::VectorXd& u_min,
                  const Eigen::VectorXd& u_max) {
    problem.robot.actuation = make_zonotope(B, u_min, u_max);
  }
};

/// A matrix of numbers between -1 and 1.
inline Eigen::MatrixXd random_matrix(Random& random, Eigen::Index rows, Eigen::Index columns) {
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return random.uniform(-1, 1); });
}

}  // namespace maxwrench
