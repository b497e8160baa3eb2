#include <cmath>

#include "lib/measure/closed_form.h"
#include "maxwrench/posture.h"
#include "maxwrench/wrench_program.h"

namespace maxwrench {
namespace {

/// Solves max c_w'w subject to |G w| <= 1, G = K J'W (m×k), by
///
///     beta = sqrt(c_w'(G'G)^-1 c_w),  w = (G'G)^-1 c_w / beta.
///
/// With e = G w the multiplier of the constraint is beta, so d beta = -beta e'K d(J'W) w. The
/// measure does not depend on tau_d.
class TransmissionRatio : public Measure {
 public:
  TransmissionRatio(Eigen::MatrixXd K, Eigen::MatrixXd B_pinv)
      : K_(std::move(K)), B_pinv_(std::move(B_pinv)) {}

  void evaluate_well_formed(const Posture& posture, const WrenchProgram& program, bool efforts,
                            Capability& capability) override {
    capability.iterations = 0;
    capability.reason = "";
    G_.noalias() = K_.lazyProduct(program.JtW);
    normal_.noalias() = G_.transpose().lazyProduct(G_);
    ldlt_.compute(normal_);
    if (!regular(ldlt_)) {
      without_answer(Status::kNumericalError, "J'W does not have full column rank", capability);
      return;
    }
    capability.status = Status::kOptimal;
    w_ = program.c_w;
    w_ = ldlt_.solve(w_);
    capability.beta = std::sqrt(program.c_w.dot(w_));
    capability.w = w_ / capability.beta;
    e_.noalias() = G_.lazyProduct(capability.w);
    load_.noalias() = -capability.beta * K_.transpose().lazyProduct(e_);
    capability.lambda = load_;
    fill_wrenches(posture, program, capability);
    capability.lambda.setZero();
    if (efforts) recover(program, capability);
  }

 private:
  /// u = B^+ J'W w, and the residual of the program without tau_d, whose multiplier is `load_`.
  void recover(const WrenchProgram& program, Capability& capability) {
    WrenchProgram unloaded = program;
    unloaded.tau_d.setZero();
    const Eigen::VectorXd tau = program.JtW * capability.w;
    capability.u = B_pinv_ * tau;
    capability.residual = recheck(unloaded, capability.u, capability.w, load_);
    capability.residual.bounds = std::abs((K_ * tau).norm() - 1);
    capability.residual.dual =
        (program.c_w + program.JtW.transpose() * load_).lpNorm<Eigen::Infinity>();
    capability.residual.gap = std::abs(-load_.dot(tau) - capability.beta);
  }

  Eigen::MatrixXd K_, B_pinv_, G_;
  Eigen::VectorXd e_, load_;
  SmallMatrix normal_;
  SmallVector w_;
  Eigen::LDLT<SmallMatrix> ldlt_;
};

std::unique_ptr<Measure> make(Eigen::MatrixXd K, const Robot& robot) {
  return make_one_sided([K = std::move(K), B_pinv = robot.actuation.B_pinv] {
    return std::make_unique<TransmissionRatio>(K, B_pinv);
  });
}

}  // namespace

std::unique_ptr<Measure> make_transmission_ratio(const Robot& robot) {
  require_full_row_rank(robot, "transmission_ratio");
  const int n = robot.velocities();
  return make(Eigen::MatrixXd::Identity(n, n), robot);
}

std::unique_ptr<Measure> make_weighted_transmission_ratio(const Robot& robot) {
  return make(weighted_inverse(robot, "weighted_transmission_ratio"), robot);
}

}  // namespace maxwrench
