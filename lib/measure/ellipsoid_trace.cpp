#include <cmath>

#include "lib/math/decompositions.h"
#include "lib/math/rotated.h"
#include "lib/measure/closed_form.h"
#include "maxwrench/posture.h"
#include "maxwrench/problem.h"
#include "maxwrench/wrench_program.h"

namespace maxwrench {
namespace {

/// The sum of the squared radii of the ellipsoid {z : |W_u B^+ J'W S z| <= 1} of wrenches W S z.
/// The columns of W (6×k) span all wrenches that the task can allow. S = W' diag(s) W, in the axes
/// in which the task gives its wrenches, scales them by the desired wrench s. With G = W_u B^+ J'W
/// (m×k) and Z = (G'G)^-1 S^-1,
///
///     T = trace(S^-1 Z),  d T = -2 <G Z Z', d G>.
///
/// The offset by tau_d only moves the centre, so T does not depend on it.
class EllipsoidTrace : public Measure {
 public:
  EllipsoidTrace(Eigen::MatrixXd K, const Problem& problem)
      : K_(std::move(K)), W_0_(problem.W_any) {
    const Matrix6Xd W = rotated(problem.wrench_axes.transpose(), W_0_);
    const SmallMatrix S = W.transpose() * problem.desired.asDiagonal() * W;
    S_inverse_ = S.inverse();
  }

  void evaluate_well_formed(const Posture& posture, const WrenchProgram& /*program*/, bool efforts,
                            Capability& capability) override {
    rotate_into(posture.turn, W_0_, W_);
    JtW_.noalias() = posture.J.transpose().lazyProduct(W_);
    G_.noalias() = K_.lazyProduct(JtW_);
    normal_.noalias() = G_.transpose().lazyProduct(G_);
    ldlt_.compute(normal_);
    if (!regular(ldlt_)) {
      without_answer(Status::kNumericalError, "J'W does not have full column rank", capability);
      return;
    }
    Z_ = ldlt_.solve(S_inverse_);
    fill_score(S_inverse_.cwiseProduct(Z_).sum(), posture.J.cols(), capability);
    normal_.noalias() = -2 * Z_.lazyProduct(Z_.transpose());
    slope_.noalias() = G_.lazyProduct(normal_);
    seed_.noalias() = slope_.transpose().lazyProduct(K_);
    capability.beta_J.noalias() = W_.lazyProduct(seed_);
    if (!efforts) return;
    // The radii are the reciprocal singular values of G S.
    capability.residual = {};
    const Eigen::MatrixXd scaled = G_ * S_inverse_.inverse();
    const double trace = singular_values(scaled).cwiseAbs2().cwiseInverse().sum();
    capability.residual.gap = std::abs(trace - capability.beta);
  }

 private:
  Eigen::MatrixXd K_;
  Matrix6Xd W_0_, W_;  ///< before and after the turn with the end effector
  Eigen::MatrixXd JtW_, G_, slope_, seed_;
  SmallMatrix S_inverse_, normal_, Z_;
  Eigen::LDLT<SmallMatrix> ldlt_;
};

}  // namespace

std::unique_ptr<Measure> make_ellipsoid_trace(const Problem& problem) {
  return std::make_unique<EllipsoidTrace>(weighted_inverse(problem.robot, "ellipsoid_trace"),
                                          problem);
}

}  // namespace maxwrench
