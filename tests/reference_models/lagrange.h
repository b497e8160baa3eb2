#pragma once

#include "tests/reference_models/robot_files.h"

namespace maxwrench::reference {

/// Where the base is and how it is turned: R = R_z(yaw) R_y(pitch) R_x(roll).
struct Place {
  Eigen::Vector3d p = Eigen::Vector3d::Zero(), rpy = Eigen::Vector3d::Zero();
};

/// The terms of tau_d = M v_d + C v + D v + g and the Jacobian of a tool, as the design defines
/// them, on the base's free axes.
struct Terms {
  Eigen::MatrixXd M, J;
  Eigen::VectorXd C_v, D_v, g, tau_d;
};

/// Lagrange's equations in x = (p, rpy, q):
///
///   d/dt dT/dx_dot - dT/dx + dV/dx = Q,   T = x_dot'M_x(x) x_dot/2,
///
/// with T and V summed over the bodies of the files (each weighs, floats and carries water by
/// itself). Derivatives are complex steps, exact to rounding. With v = G(x) x_dot the velocities in
/// base axes, tau_d = G^-T Q. Nothing is recursive and no body's force is ever formed. Near a pitch
/// of 90 degrees G is singular.
class Lagrange {
 public:
  explicit Lagrange(const std::filesystem::path& toml) : files_(read_robot(toml)) {}
  const Files& files() const { return files_; }
  /// On the base's free axes.
  Eigen::MatrixXd B() const { return free_rows(files_.B); }

  /// `v` and `v_d` on the free axes.
  Terms terms(const Place& base, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
              const Eigen::VectorXd& v_d, const std::string& tool) const;
  /// J and tau_d at rest only.
  Terms at_rest(const Place& base, const Eigen::VectorXd& q, const std::string& tool) const;
  Eigen::MatrixXd jacobian(const Place& base, const Eigen::VectorXd& q,
                           const std::string& tool) const;

  /// A tool in the world.
  Eigen::Isometry3d tool(const Place& base, const Eigen::VectorXd& q,
                         const std::string& name) const;
  /// The base that brings the tool to `target`.
  Place base_for(const Eigen::Isometry3d& target, const Eigen::VectorXd& q,
                 const std::string& name) const;

 private:
  Eigen::MatrixXd free_rows(const Eigen::MatrixXd& all) const;

  Files files_;
};

}  // namespace maxwrench::reference
