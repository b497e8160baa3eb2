#pragma once

#include <vector>

#include "lib/math/direct_drives.h"
#include "maxwrench/wrench_program.h"
#include "solvers/wrench/tableau.h"

namespace maxwrench {

/// The wrench program without its equations. Its first wrench columns must be free, and as many as
/// the rows without a direct drive (all six wrenches on a free-floating base). Further columns,
/// those of a second contact, stay with their bounds as if they were thrusters whose column of B_b
/// is that of -J_b'W; they also appear directly in the driven rows j. A direct drive is the only
/// entry of its row and of its column of B. With P = (J_b'W)^-1 over the other rows b,
///
///     w = P (B_b u_b - tau_b),   v_j = tau_j + J_j'W w,   b_j u_j = v_j   for the driven rows j.
///
/// What remains are the efforts u_b of the thrusters, each between its limits, and a row for each
/// joint:
///
///     max (c_w'P B_b) u_b   subject to   u_b,min <= u_b <= u_b,max,   v_j between the limits of
///     b_j u_j.
///
/// Its sign vertex is dual feasible. With z >= 0 at the upper limits of v: lambda_j = -z_j and
/// lambda_b = -P'(c_w + (J_j'W)'lambda_j).
class Elimination {
 public:
  /// Fills the tableau. Returns false if the program is not of this kind or J_b'W is nearly
  /// singular.
  bool load(const WrenchProgram& program, Tableau& tableau);
  /// Fills beta, w, lambda and, if `efforts`, u from the solved tableau.
  void fill(const WrenchProgram& program, const Tableau& tableau, bool efforts,
            Capability& capability);
  /// The Farkas vector y of the wrench program, from an infeasible tableau.
  void fill_contradiction(const WrenchProgram& program, const Tableau& tableau,
                          Eigen::VectorXd& y) const;

 private:
  /// k <= 6 columns are eliminated. They are padded to 6, with an identity in P and zeros
  /// elsewhere, because constant sizes are fast.
  using Square = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
  using Wide = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor>;

  void split(const Eigen::MatrixXd& B);
  void append(const WrenchProgram& program);
  bool invert(const WrenchProgram& program);
  void add_joint(const WrenchProgram& program, int joint, Tableau& tableau);
  double combine(const Vector6d& p, double* row) const;
  /// lambda with (J'W)'lambda = -c_share c_w.
  void fill_lambda(const WrenchProgram& program, const Tableau& tableau, double c_share,
                   Eigen::VectorXd& lambda) const;

  Eigen::MatrixXd B_;    // from which the following two were made
  DirectDrives drives_;  // the other rows belong to the base, the other columns to thrusters
  Wide B_b_;  // thrusters, then columns of a second contact, then zeros (solvers/wrench/padded.h)
  int extra_ = 0;  // number of the latter
  Square P_;
  int steps_ = 1;  // of refinement with P, including the first
  Vector6d tau_b_;
  Eigen::VectorXd row_;
};

}  // namespace maxwrench
