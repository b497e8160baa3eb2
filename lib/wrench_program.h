#pragma once

#include "lib/linear_program.h"
#include "lib/measure.h"
#include "lib/posture.h"
#include "lib/zonotope.h"

namespace maxwrench {

/// The lower level with its structure kept: over u (m) and w (k),
///
///     max c_w'w   subject to   B u - J'W w = tau_d,   u_min <= u <= u_max,   w_min <= w <= w_max
///
/// (eq:reducedDynamics; h_e = W w). B and the bounds stay; only JtW and tau_d change from posture
/// to posture.
struct WrenchProgram {
  const Zonotope* actuation = nullptr;  ///< B and the limits of u; outlives the program
  Matrix6Xd W;                          ///< 6×k, basis of the allowed wrenches
  Eigen::VectorXd c_w;                  ///< k, W'c
  Eigen::VectorXd w_min, w_max;         ///< k
  Eigen::MatrixXd JtW;                  ///< n×k, J'W
  Eigen::VectorXd tau_d;                ///< n

  int columns() const { return static_cast<int>(W.cols()); }
};

/// The program of `problem` before the first posture: W = c or W_any, w free.
WrenchProgram make_wrench_program(const Problem& problem, Wrench wrench);

/// Sets JtW and tau_d.
void set_posture(const Posture& posture, WrenchProgram& program);

/// The same program for general solvers: x = (u, w), A = [B, -J'W], b = tau_d. `update` rewrites
/// the numbers of a program that `assemble` made and allocates nothing.
LinearProgram assemble(const WrenchProgram& program);
void update(const WrenchProgram& program, LinearProgram& assembled);

/// The residual of (u, w) and lambda, the multipliers of the program's own rows: the dual objective
/// is lambda'tau_d + sup {-(B'lambda)'u} + sup {(c_w + (J'W)'lambda)'w} over the limits.
Residual recheck(const WrenchProgram& program, const Eigen::VectorXd& u, const Eigen::VectorXd& w,
                 const Eigen::VectorXd& lambda);

/// Whether y proves that no (u, w) satisfies the program, see `verified`.
bool proves_infeasible(const WrenchProgram& program, const Eigen::VectorXd& y);

}  // namespace maxwrench
