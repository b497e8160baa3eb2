#pragma once

#include "maxwrench/capability.h"
#include "maxwrench/linear_program.h"
#include "maxwrench/zonotope.h"

namespace maxwrench {

struct Posture;
struct Problem;

/// The lower level with its structure kept: over u (m) and w (k),
///
///     max c_w'w   subject to   B u - J'W w = tau_d,   u_min <= u <= u_max,   w_min <= w <= w_max
///
/// (eq:reducedDynamics; h_e = W w). B and the bounds stay; only JtW and tau_d change from posture
/// to posture. With a second contact w = (w_1, w_2), h_e = W w_1, h_e2 = C_2 w_2, and J'W stands
/// for [J_1'W, J_2'C_2] (eq:dualOrthogonal); C_2 may change too. c_w is zero for w_2.
struct WrenchProgram {
  const Zonotope* actuation = nullptr;  ///< B and the limits of u; outlives the program
  Matrix6Xd W;                          ///< 6×k_1, basis of the allowed wrenches
  Matrix6Xd W_0;                        ///< before it turns with the end effector; empty: it rests
  Matrix6Xd C_2;                        ///< 6×l, of those of the second contact; k = k_1 + l
  Eigen::VectorXd c_w;                  ///< k, W'c
  Eigen::VectorXd w_min, w_max;         ///< k
  Eigen::MatrixXd JtW;                  ///< n×k, J'W
  Eigen::VectorXd tau_d;                ///< n

  int columns() const { return static_cast<int>(c_w.size()); }
};

/// Whether all sizes agree, W, C_2, JtW, tau_d and c_w are finite, and limits of w are numbers that
/// leave something between them or cross (-infinity and infinity are none). The actuation is taken
/// as `make_zonotope` made it. Allocates nothing.
bool well_formed(const WrenchProgram& program);

/// The program of `problem`, which outlives it, before the first posture: W = c or W_any, w_1 free.
WrenchProgram make_wrench_program(const Problem& problem, Wrench wrench);
WrenchProgram make_wrench_program(const Problem&& problem, Wrench wrench) = delete;

/// Sets JtW, tau_d and C_2; W too if it turns.
void set_posture(const Posture& posture, WrenchProgram& program);

/// The same program for general solvers: x = (u, w), A = [B, -J'W], b = tau_d. `update` rewrites
/// the numbers of a program that `assemble` made and allocates nothing.
LinearProgram assemble(const WrenchProgram& program);
void update(const WrenchProgram& program, LinearProgram& assembled);

/// The residual of (u, w) and lambda, the multipliers of the program's own rows: the dual objective
/// is lambda'tau_d + sup {-(B'lambda)'u} + sup {(c_w + (J'W)'lambda)'w} over the limits. What
/// cannot be computed (wrong sizes, NaN) is an infinite residual.
Residual recheck(const WrenchProgram& program, const Eigen::VectorXd& u, const Eigen::VectorXd& w,
                 const Eigen::VectorXd& lambda);

/// h and h_2 from w, and the seeds of the derivative from lambda as well: beta_J = h lambda',
/// beta_J2 = h_2 lambda', beta_C2 = J_2 lambda w_2'.
void fill_wrenches(const Posture& posture, const WrenchProgram& program, Capability& capability);

/// Whether y proves that no (u, w) satisfies the program, as `verified` judges it. Allocates
/// nothing.
bool proves_infeasible(const WrenchProgram& program, const Eigen::VectorXd& y);

}  // namespace maxwrench
