#pragma once

#include <memory>

#include "lib/trajectory/canonical_equations.h"

namespace maxwrench {

/// The flow of the canonical equations, z(t_0) -> z(t_1), with its derivatives: forward
/// sensitivities by CVODES (SUNDIALS) with the variational equations of
/// `CanonicalEquations::linearize`.
class ExtremalFlow {
 public:
  /// The equations must outlive this object.
  explicit ExtremalFlow(CanonicalEquations& equations);
  ~ExtremalFlow();

  /// Integrates over a time. All numbers of z are 1 in their unit for the tolerance, but costates
  /// `costate`.
  ///
  /// @param duration  the time [s]
  /// @param z         the state, which moves on
  /// @param m         the mass of the payload [kg]
  /// @param costate   the size of costates
  /// @param slopes    if not null, receives the derivatives of the new z by the old one and by m:
  ///                  d×(d + 1)
  /// @return whether it arrived
  bool advance(double duration, Eigen::VectorXd& z, double m, double costate,
               Eigen::MatrixXd* slopes);

 private:
  class Session;
  std::unique_ptr<Session> session_;
};

}  // namespace maxwrench
