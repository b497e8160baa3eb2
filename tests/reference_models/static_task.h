#pragma once

#include <optional>

#include "tests/reference_models/lagrange.h"

namespace maxwrench::reference {

/// max c'x subject to A x = b, l <= x <= u, x = (u, w).
struct Program {
  Eigen::MatrixXd A;
  Eigen::VectorXd b, c, l, u;
};

/// A tool is held at a place and pushes along c, with the wrenches W w.
struct StaticTask {
  const Lagrange& robot;
  std::string tool;
  Eigen::Isometry3d target;
  Eigen::VectorXd c;
  Eigen::MatrixXd W;

  /// Any efforts within their limits: B u - J'W w = tau_d.
  Program program(const Eigen::VectorXd& q) const;
  /// Its value.
  std::optional<double> polytope(const Eigen::VectorXd& q) const;
  /// The larger beta with |W_u B^+ (tau_d + J'c beta)| = 1, W_u the inverse of the smaller limit
  /// of each actuator. Nothing if there is none.
  std::optional<double> ellipsoid(const Eigen::VectorXd& q) const;
};

/// Adds the columns -J'C of another tool that exerts C w_2, w_2 >= 0.
void add_push(const Eigen::MatrixXd& J, const Eigen::MatrixXd& C, Program& program);

}  // namespace maxwrench::reference
