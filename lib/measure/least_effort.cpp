#include <cmath>

#include "lib/measure/closed_form.h"
#include "maxwrench/posture.h"
#include "maxwrench/problem.h"
#include "maxwrench/wrench_program.h"

namespace maxwrench {
namespace {

/// Solves -min |u|^2 subject to B u = tau_d + J'W w, c_w'w = reference. With G = B^+ J'W (m×k) and
/// g = B^+ tau_d the efforts are u = g + G w, so
///
///     w = (G'G)^-1 (mu c_w - G'g),  mu = (reference + c_w'(G'G)^-1 G'g) / (c_w'(G'G)^-1 c_w).
///
/// u'G = mu c_w', and every change of w along the constraint is orthogonal to c_w, so lambda = -2
/// (B^+)'u.
class LeastEffort : public Measure {
 public:
  LeastEffort(Eigen::MatrixXd B_pinv, double reference)
      : B_pinv_(std::move(B_pinv)), reference_(reference) {}

  void evaluate_well_formed(const Posture& posture, const WrenchProgram& program, bool efforts,
                            Capability& capability) override {
    capability.iterations = 0;
    capability.reason = "";
    G_.noalias() = B_pinv_.lazyProduct(program.JtW);
    u_.noalias() = B_pinv_.lazyProduct(program.tau_d);
    g_ = u_;
    normal_.noalias() = G_.transpose().lazyProduct(G_);
    ldlt_.compute(normal_);
    if (!regular(ldlt_)) {
      without_answer(Status::kNumericalError, "J'W does not have full column rank", capability);
      return;
    }
    capability.status = Status::kOptimal;
    c_w_ = program.c_w;
    along_ = ldlt_.solve(c_w_);
    rest_.noalias() = G_.transpose().lazyProduct(g_);
    rest_ = ldlt_.solve(rest_);
    const double mu = (reference_ + c_w_.dot(rest_)) / c_w_.dot(along_);
    capability.w = mu * along_ - rest_;
    u_.noalias() += G_.lazyProduct(capability.w);
    capability.beta = -u_.squaredNorm();
    capability.lambda.noalias() = -2 * B_pinv_.transpose().lazyProduct(u_);
    fill_wrenches(posture, program, capability);
    if (efforts) recover(program, mu, capability);
  }

 private:
  /// The residual: c_w'w = reference, G'u = mu c_w, and the dual objective 2 u'g + 2 mu reference -
  /// |u|^2, which bounds |u|^2 from below. Limits have no effect.
  void recover(const WrenchProgram& program, double mu, Capability& capability) {
    capability.u = u_;
    Residual& residual = capability.residual;
    residual.balance = recheck(program, u_, capability.w, capability.lambda).balance;
    residual.bounds = std::abs(program.c_w.dot(capability.w) - reference_);
    residual.dual = (G_.transpose() * u_ - mu * program.c_w).lpNorm<Eigen::Infinity>();
    const double dual = 2 * u_.dot(g_) + 2 * mu * reference_ - u_.squaredNorm();
    residual.gap = std::abs(dual + capability.beta);
  }

  Eigen::MatrixXd B_pinv_, G_;
  double reference_;
  Eigen::VectorXd g_, u_;
  SmallMatrix normal_;
  SmallVector c_w_, along_, rest_;
  Eigen::LDLT<SmallMatrix> ldlt_;
};

}  // namespace

std::unique_ptr<Measure> make_least_effort(const Problem& problem) {
  require_full_row_rank(problem.robot, "least_effort");
  return make_one_sided([B_pinv = problem.robot.actuation.B_pinv, r = problem.reference] {
    return std::make_unique<LeastEffort>(B_pinv, r);
  });
}

}  // namespace maxwrench
