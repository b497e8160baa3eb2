#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lib/math/decompositions.h"
#include "lib/measure/closed_form.h"
#include "maxwrench/posture.h"
#include "maxwrench/problem.h"
#include "maxwrench/wrench_set.h"
#include "solvers/wrench_set/directions.h"

namespace maxwrench {
namespace {

/// Below this share of the largest singular value, no effort limits a direction: the square root of
/// kPivotTolerance.
constexpr double kUnlimited = 1e-7;

/// The columns that are free beside those of E. A column of the second contact whose force is zero
/// is left out.
Eigen::MatrixXd free_columns(const WrenchProgram& program, Eigen::Index first) {
  Eigen::MatrixXd columns(program.JtW.rows(), 0);
  for (Eigen::Index j = first; j < program.JtW.cols(); ++j) {
    if (program.w_min[j] == 0 && program.w_max[j] == 0) continue;
    if (std::isfinite(program.w_min[j]) || std::isfinite(program.w_max[j])) {
      throw std::invalid_argument(
          "contact.basis: got a limit of a force, expected free forces: with limits the set is no "
          "ellipsoid");
    }
    columns.conservativeResize(Eigen::NoChange, columns.cols() + 1);
    columns.rightCols(1) = program.JtW.col(j);
  }
  return columns;
}

/// Projects along the columns F of free wrenches: what they can cancel no longer counts.
void remove_free(const Eigen::MatrixXd& F, Eigen::MatrixXd& G, Eigen::VectorXd& g) {
  if (F.cols() == 0) return;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(F);
  qr.setThreshold(kUnlimited);
  const Eigen::MatrixXd Q = qr.householderQ() * Eigen::MatrixXd::Identity(F.rows(), qr.rank());
  G -= Q * (Q.transpose() * G).eval();
  g -= Q * (Q.transpose() * g).eval();
}

/// |G f + g| <= 1 as centre, axes and radii.
void solve(const Eigen::MatrixXd& G, const Eigen::VectorXd& g, double scale, WrenchEllipsoid& set) {
  const Eigen::Index k = G.cols();
  const auto [U, s, V] = svd(G);
  if (!(s[k - 1] > kUnlimited * scale)) {
    set.ray = V.rightCols<1>();
    set.conclude(Status::kUnbounded, "no actuator limits the wrench along ray");
    return;
  }
  const Eigen::VectorXd along = U.leftCols(k).transpose() * g;
  const double rho2 = 1 - (g - U.leftCols(k) * along).squaredNorm();
  if (!(rho2 > 0)) {
    set.conclude(Status::kInfeasible,
                 "tau_d alone exceeds the ellipsoid with any wrench of the set");
    return;
  }
  set.centre = -(V * along.cwiseQuotient(s));
  set.radii = std::sqrt(rho2) * s.cwiseInverse().reverse();
  set.axes = V.rowwise().reverse();
  if (set.axes.determinant() < 0) set.axes.rightCols<1>() *= -1;
  const double unit_ball[] = {2, M_PI, 4 * M_PI / 3};
  set.volume = unit_ball[k - 1] * set.radii.prod();
  set.conclude(Status::kOptimal);
}

}  // namespace

Eigen::MatrixXd WrenchEllipsoid::shape() const {
  return axes * radii.cwiseAbs2().asDiagonal() * axes.transpose();
}

WrenchEllipsoid force_ellipsoid(const Problem& task, const Posture& posture, const Matrix6Xd& E,
                                Wrench wrench) {
  const WrenchProgram program = wrench_set_program(task, posture, E, wrench);
  Eigen::MatrixXd K = weighted_inverse(task.robot, "ellipsoid");
  // Rows of zeros change nothing, and give G as many singular values as columns.
  const Eigen::Index m = K.rows();
  K.conservativeResize(std::max(m, E.cols()), Eigen::NoChange);
  K.bottomRows(K.rows() - m).setZero();
  const Eigen::MatrixXd F = K * free_columns(program, E.cols());
  WrenchEllipsoid set;
  if (posture.status != Status::kValid) {
    static_cast<Verdict&>(set) = posture;
    return set;
  }
  if (!well_formed(program)) {
    set.conclude(Status::kNumericalError, kMalformed);
    return set;
  }
  Eigen::MatrixXd G = K * program.JtW.leftCols(E.cols());
  Eigen::VectorXd g = K * program.tau_d;
  const double scale = G.norm();
  remove_free(F, G, g);
  solve(G, g, scale, set);
  return set;
}

}  // namespace maxwrench
