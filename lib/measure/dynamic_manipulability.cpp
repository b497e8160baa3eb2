#include <algorithm>
#include <cassert>
#include <cmath>

#include "lib/measure/closed_form.h"
#include "lib/measure/task_dynamics.h"
#include "maxwrench/posture.h"
#include "maxwrench/problem.h"
#include "maxwrench/wrench_program.h"

namespace maxwrench {
namespace {

/// The largest beta such that efforts u = W_u^-1 e, |e| <= 1, accelerate the end effector by
/// beta c. With F = B W_u^-1 (n×m), A = X'F (k×m) and r = X'tau_d the accelerations are A e - r.
/// For c on the axes of the task and A A' = R'R the boundary is |R'^-1 (beta c + r)| = 1, and
///
///     y = (A A')^-1 (beta c + r),  s = c'y > 0,  e = A'y,  v_dot = M^-1 (F e - tau_d).
///
/// R is that of A' = Q R: light links make A A' so ill conditioned that its own factors lose
/// digits. With lambda = -X y / s, of the equation of motion M v_dot + tau_d = B u, and W y / s of
/// J v_dot = beta c,
///
///     d beta = lambda'(d tau_d + dM v_dot) + (W y / s)'dJ v_dot.
class DynamicManipulability : public Measure {
 public:
  explicit DynamicManipulability(const Problem& problem)
      : dynamics_(problem, "dynamic_manipulability"), actuation_(problem.robot.actuation) {
    require_both_directions(problem.robot, "dynamic_manipulability");
    limits_ = smaller_limits(actuation_);
    F_ = actuation_.B * limits_.asDiagonal();
    c_ = problem.W_any.transpose() * problem.c;
  }

  void evaluate_well_formed(const Posture& posture, const WrenchProgram& program, bool efforts,
                            Capability& capability) override {
    const char* const why = dynamics_.set(posture);
    if (why != nullptr) {
      without_answer(Status::kNumericalError, why, capability);
      return;
    }
    const double root = solve(program.tau_d, capability);
    if (capability.status != Status::kOptimal) return;
    e_.noalias() = At_.lazyProduct(y_);
    v_dot_.noalias() = F_.lazyProduct(e_);
    v_dot_ -= program.tau_d;
    dynamics_.divide(v_dot_);
    y_ /= root;
    capability.lambda.noalias() = dynamics_.X().lazyProduct(y_);
    capability.lambda = -capability.lambda;
    pull_.noalias() = dynamics_.W().lazyProduct(y_);
    capability.beta_J.noalias() = pull_ * v_dot_.transpose();
    dynamics_.mass_slopes(capability.lambda, v_dot_, capability.beta_q);
    capability.w.resize(0);
    capability.u.resize(0);
    if (efforts) recover(program.tau_d, capability);
  }

 private:
  /// Fills the status, beta and y. Returns s.
  double solve(const Eigen::VectorXd& tau_d, Capability& capability) {
    const Eigen::MatrixXd& X = dynamics_.X();
    const Eigen::Index k = X.cols();
    assert(k <= kMaxColumns);
    At_.noalias() = F_.transpose().lazyProduct(X);
    if (At_.rows() < k || !factor()) {
      without_answer(Status::kNumericalError,
                     "singular: the efforts accelerate the end effector in fewer directions than "
                     "the task has",
                     capability);
      return 0;
    }
    const auto R = qr_.matrixQR().topRows(k).triangularView<Eigen::Upper>();
    along_ = c_;
    R.transpose().solveInPlace(along_);
    y_.noalias() = X.transpose().lazyProduct(tau_d);
    R.transpose().solveInPlace(y_);
    const double left = 1 - y_.squaredNorm();
    if (!(left > 0)) {
      without_answer(Status::kInfeasible,
                     "the origin is outside of the ellipsoid: the end effector cannot rest under "
                     "tau_d",
                     capability);
      return 0;
    }
    const double s2 = along_.squaredNorm(), q = along_.dot(y_);
    const double root = std::sqrt(q * q + s2 * left);
    capability.conclude(Status::kOptimal);
    // The form without cancellation of the positive root of s2 beta^2 + 2 q beta = left.
    capability.beta = q > 0 ? left / (q + root) : (root - q) / s2;
    y_ += capability.beta * along_;
    R.solveInPlace(y_);
    return root;
  }

  /// Factors A'. Returns whether each of its columns is apart from those before.
  bool factor() {
    qr_.compute(At_);
    for (Eigen::Index i = 0; i < At_.cols(); ++i) {
      const double apart = qr_.matrixQR()(i, i);
      if (!(apart * apart > kPivotTolerance * At_.col(i).squaredNorm())) return false;
    }
    return true;
  }

  /// u, and the residual: the equation of motion and the acceleration, |e| = 1, and the dual
  /// objective lambda'tau_d + |F'lambda| with M lambda + J'W y / s = 0 and c'y / s = 1.
  void recover(const Eigen::VectorXd& tau_d, Capability& capability) const {
    const Eigen::VectorXd& lambda = capability.lambda;
    capability.u = limits_.cwiseProduct(e_);
    const Eigen::VectorXd motion = actuation_.B * capability.u - dynamics_.M() * v_dot_ - tau_d;
    const Eigen::VectorXd acceleration = dynamics_.T() * v_dot_ - capability.beta * c_;
    const Eigen::VectorXd slope = dynamics_.M() * lambda + dynamics_.T().transpose() * y_;
    Residual& residual = capability.residual;
    residual.balance =
        std::max(motion.lpNorm<Eigen::Infinity>(), acceleration.lpNorm<Eigen::Infinity>());
    residual.bounds = std::abs(e_.norm() - 1);
    residual.dual = std::max(slope.lpNorm<Eigen::Infinity>(), std::abs(c_.dot(y_) - 1));
    const double dual = lambda.dot(tau_d) + (F_.transpose() * lambda).norm();
    residual.gap = std::abs(dual - capability.beta);
  }

  TaskDynamics dynamics_;
  const Zonotope& actuation_;
  Eigen::VectorXd limits_, e_, v_dot_;
  Eigen::MatrixXd F_, At_;     ///< n×m, m×k
  SmallVector c_, along_, y_;  ///< on the axes of the task
  Vector6d pull_;
  Eigen::HouseholderQR<Eigen::MatrixXd> qr_;
};

}  // namespace

std::unique_ptr<Measure> make_dynamic_manipulability(const Problem& problem) {
  return std::make_unique<DynamicManipulability>(problem);
}

}  // namespace maxwrench
