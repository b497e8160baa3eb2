#pragma once

#include "maxwrench/capability.h"
#include "maxwrench/linear_program.h"
#include "maxwrench/zonotope.h"

/// @file
/// The linear program at one posture.

namespace maxwrench {

struct Posture;
struct Problem;

/// The lower level at one posture, in a form that keeps its structure.
///
/// Its variables are the efforts u (m) and the wrench coordinates w (k):
///
///     max c_w'w   subject to   B u - J'W w = tau_d,   u_min <= u <= u_max,   w_min <= w <= w_max
///
/// (eq:reducedDynamics; h_e = W w). B and the limits are constant; JtW and tau_d change from
/// posture to posture. With a second contact, w = (w_1, w_2), h_e = W w_1 and h_e2 = C_2 w_2, and
/// J'W denotes [J_1'W, J_2'C_2] (eq:dualOrthogonal). C_2 may also change. c_w is zero for w_2.
struct WrenchProgram {
  const Zonotope* actuation = nullptr;  ///< B and the limits of u; it must outlive the program
  Matrix6Xd W;                          ///< basis of the allowed wrenches (6×k_1)
  Matrix6Xd W_0;          ///< W before it turns with the end effector; empty: it does not turn
  Matrix6Xd C_2;          ///< basis of the wrenches of the second contact (6×l); k = k_1 + l
  Eigen::VectorXd c_w;    ///< objective W'c (k)
  Eigen::VectorXd w_min,  ///< lower limits of w (k)
      w_max;              ///< upper limits of w (k)
  Eigen::MatrixXd JtW;    ///< J'W (n×k)
  Eigen::VectorXd tau_d;  ///< right-hand side of the balance (n) [N, N m]

  /// Returns k, the number of wrench columns.
  int columns() const { return static_cast<int>(c_w.size()); }
};

/// Returns whether a wrench program is well formed.
///
/// All sizes must agree, and W, C_2, JtW, tau_d and c_w must be finite. Limits of w must not be
/// NaN. Each limit must leave numbers on its own side, so w_min = infinity and w_max = -infinity
/// are rejected. Limits may cross. The actuation is assumed to come from `make_zonotope`. The
/// function allocates nothing.
bool well_formed(const WrenchProgram& program);

/// Makes the wrench program of a problem before the first posture: W = c or W_any, with w_1 free.
///
/// @param problem  the task, which must outlive the program
/// @param wrench   the allowed wrenches
WrenchProgram make_wrench_program(const Problem& problem, Wrench wrench);
/// Deleted: the problem must outlive the program, and a temporary does not.
WrenchProgram make_wrench_program(const Problem&& problem, Wrench wrench) = delete;

/// Sets JtW, tau_d and C_2 of a program to those of a posture, and W if it turns.
///
/// @return whether JtW and tau_d are finite
bool set_posture(const Posture& posture, WrenchProgram& program);

/// Returns a wrench program as a linear program for general solvers: x = (u, w), A = [B, -J'W],
/// b = tau_d.
LinearProgram assemble(const WrenchProgram& program);
/// Writes the numbers of a wrench program into a linear program that `assemble` made. It allocates
/// nothing.
void update(const WrenchProgram& program, LinearProgram& assembled);

/// Computes the residual of a solution from the data of the program.
///
/// The dual objective is lambda'tau_d + sup {-(B'lambda)'u} + sup {(c_w + (J'W)'lambda)'w} over the
/// limits.
///
/// @param program  the program
/// @param u        efforts (m)
/// @param w        wrench coordinates (k)
/// @param lambda   the multipliers of the balance (n)
/// @return the residual; infinite where it cannot be computed (wrong sizes, NaN)
Residual recheck(const WrenchProgram& program, const Eigen::VectorXd& u, const Eigen::VectorXd& w,
                 const Eigen::VectorXd& lambda);

/// Computes h and h_2 from w, and the derivatives by J, J_2 and C_2 from lambda.
///
///     beta_J = h lambda',   beta_J2 = h_2 lambda',   beta_C2 = J_2 lambda w_2'
///
/// @param posture     the posture
/// @param program     its wrench program
/// @param capability  has w and lambda, and receives the others
void fill_wrenches(const Posture& posture, const WrenchProgram& program, Capability& capability);

/// Returns whether y (n) proves that no (u, w) satisfies the program, by the criterion of
/// `verified`.
///
/// It allocates nothing.
bool proves_infeasible(const WrenchProgram& program, const Eigen::VectorXd& y);

}  // namespace maxwrench
