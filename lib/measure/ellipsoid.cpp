#include <cassert>
#include <cmath>

#include "lib/measure/closed_form.h"
#include "maxwrench/posture.h"
#include "maxwrench/wrench_program.h"

namespace maxwrench {
namespace {

/// Solves max c_w'w subject to |G w + g| <= 1, with G = W_u B^+ J'W (m×k) and g = W_u B^+ tau_d
/// (m), by
///
///     z = -(G'G)^-1 G'g,  rho^2 = 1 - |g + G z|^2,  s^2 = c_w'(G'G)^-1 c_w,
///     beta = c_w'z + rho s,  w = z + (rho/s) (G'G)^-1 c_w.
///
/// With e = G w + g the multiplier of the constraint is s/rho (from c_w = (s/rho) G'e), so lambda =
/// -(s/rho) (W_u B^+)'e. For W = c this is the positive root of eq:transmissionUVMS.
class Ellipsoid : public Measure {
 public:
  Ellipsoid(Eigen::MatrixXd K, Eigen::MatrixXd B_pinv)
      : B_pinv_(std::move(B_pinv)), K_(std::move(K)) {}

  void evaluate_well_formed(const Posture& posture, const WrenchProgram& program, bool efforts,
                            Capability& capability) override {
    capability.iterations = 0;
    G_.noalias() = K_.lazyProduct(program.JtW);
    g_.noalias() = K_.lazyProduct(program.tau_d);
    capability.reason = "";
    capability.status = solve(program, capability);
    if (capability.status != Status::kOptimal) return;
    fill_wrenches(posture, program, capability);
    if (efforts) recover(program, capability);
  }

 private:
  /// Fills beta, w and lambda.
  Status solve(const WrenchProgram& program, Capability& capability) {
    if (!(g_.squaredNorm() < 1)) {
      return without_answer(
          Status::kInfeasible,
          "the origin is outside of the ellipsoid: without contact forces tau_d alone exceeds it",
          capability);
    }
    assert(program.columns() <= kMaxColumns);
    normal_.noalias() = G_.transpose().lazyProduct(G_);
    ldlt_.compute(normal_);
    if (!regular(ldlt_)) {
      return without_answer(Status::kNumericalError, "J'W does not have full column rank",
                            capability);
    }
    direction_.noalias() = -G_.transpose().lazyProduct(g_);
    capability.w = ldlt_.solve(direction_);  // z
    c_w_ = program.c_w;
    direction_ = ldlt_.solve(c_w_);
    e_ = g_;
    e_.noalias() += G_.lazyProduct(capability.w);
    // |e| <= |g| < 1 and (G'G)^-1 is positive definite, except for rounding.
    const double rho2 = 1 - e_.squaredNorm(), s2 = program.c_w.dot(direction_);
    if (!(rho2 > 0 && s2 > 0)) {
      return without_answer(Status::kNumericalError, "tau_d lies on the ellipsoid", capability);
    }
    const double rho = std::sqrt(rho2), s = std::sqrt(s2);
    capability.beta = program.c_w.dot(capability.w) + rho * s;
    capability.w += (rho / s) * direction_;
    e_.noalias() += (rho / s) * G_.lazyProduct(direction_);
    capability.lambda.noalias() = (-s / rho) * K_.transpose().lazyProduct(e_);
    return Status::kOptimal;
  }

  /// u = B^+ (tau_d + J'W w), and the residual: the distance of u from the ellipsoid, stationarity
  /// c_w = -(J'W)'lambda, and the dual objective lambda'tau_d + sup {-lambda'tau : |W_u B^+ tau| <=
  /// 1}, whose supremum is attained at this tau.
  void recover(const WrenchProgram& program, Capability& capability) {
    const Eigen::VectorXd tau = program.tau_d + program.JtW * capability.w;
    const Eigen::VectorXd& lambda = capability.lambda;
    capability.u = B_pinv_ * tau;
    capability.residual = recheck(program, capability.u, capability.w, lambda);  // the balance
    capability.residual.bounds = std::abs((K_ * tau).norm() - 1);
    capability.residual.dual =
        (program.c_w + program.JtW.transpose() * lambda).lpNorm<Eigen::Infinity>();
    capability.residual.gap =
        std::abs(lambda.dot(program.tau_d) - lambda.dot(tau) - capability.beta);
  }

  Eigen::MatrixXd B_pinv_, K_, G_;
  Eigen::VectorXd g_, e_;
  SmallMatrix normal_;
  SmallVector direction_, c_w_;
  Eigen::LDLT<SmallMatrix> ldlt_;
};

}  // namespace

std::unique_ptr<Measure> make_ellipsoid(const Robot& robot) {
  return make_one_sided(
      [K = weighted_inverse(robot, "ellipsoid"), B_pinv = robot.actuation.B_pinv] {
        return std::make_unique<Ellipsoid>(K, B_pinv);
      });
}

}  // namespace maxwrench
