#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>

#include "lib/math/decompositions.h"
#include "lib/measure/closed_form.h"
#include "lib/measure/task_dynamics.h"
#include "maxwrench/posture.h"
#include "maxwrench/problem.h"
#include "maxwrench/wrench_program.h"

namespace maxwrench {
namespace {

/// An actuator whose row is shorter than this share of the longest takes no part.
constexpr double kRowTolerance = 1e-12;

/// The axes of the linear accelerations of a task if its c is a force, of the angular ones if it is
/// a torque: an orthonormal basis S (k×p), as combinations of the columns of W.
Eigen::MatrixXd axes_of_kind(const Problem& problem) {
  const bool force = problem.c.tail<3>().isZero(), torque = problem.c.head<3>().isZero();
  if (force == torque) {
    throw std::invalid_argument(
        "measure dynamic_capability: c of " + problem.name +
        " has both force and torque, expected one of them: it chooses linear or angular "
        "accelerations");
  }
  const Eigen::Matrix3Xd others =
      force ? problem.W_any.bottomRows<3>() : problem.W_any.topRows<3>();
  if (others.isZero(0)) return Eigen::MatrixXd::Identity(others.cols(), others.cols());
  return split(others.transpose(), 1e-9).complement;
}

/// The largest beta such that the accelerations S d beta of all unit vectors d keep the efforts
/// u = u_0 + R d beta within their limits, where u_0 = K tau_d, R = K T'E, E = Lambda S, Lambda =
/// (T X)^-1 and K = B^+. Row i of R has the largest effort |r_i| at d = +- r_i/|r_i|, so
///
///     beta = min over i of min(u_max - u_0, u_0 - u_min)_i / |r_i|.
///
/// At the limit of sign sigma of actuator i, with f = E d beta the forces and v_dot = X f the
/// accelerations of the worst direction,
///
///     lambda = -sigma K'e_i/|r_i|,  g = Lambda T lambda,  z = X g,
///     d beta = lambda'd tau_d + f'dT (lambda - z) - g'dT v_dot + z'dM v_dot.
class DynamicCapability : public Measure {
 public:
  explicit DynamicCapability(const Problem& problem)
      : dynamics_(problem, "dynamic_capability"),
        actuation_(problem.robot.actuation),
        S_(axes_of_kind(problem)) {
    require_full_row_rank(problem.robot, "dynamic_capability");
  }

  void evaluate_well_formed(const Posture& posture, const WrenchProgram& program, bool efforts,
                            Capability& capability) override {
    const char* const why = set(posture, program.tau_d);
    if (why != nullptr) {
      without_answer(Status::kNumericalError, why, capability);
      return;
    }
    shoot(capability);
    if (capability.status != Status::kOptimal) return;
    differentiate_at_limit(capability);
    capability.w.resize(0);
    capability.u.resize(0);
    if (efforts) recover(program.tau_d, capability);
  }

 private:
  /// Fills E, R and u_0. Returns null, or why there are none.
  const char* set(const Posture& posture, const Eigen::VectorXd& tau_d) {
    const char* const why = dynamics_.set(posture);
    if (why != nullptr) return why;
    const Eigen::MatrixXd& T = dynamics_.T();
    assert(T.rows() <= kMaxColumns);
    gram_.noalias() = T.lazyProduct(dynamics_.X());
    ldlt_.compute(gram_);
    if (!regular(ldlt_)) return "J is singular";
    E_ = ldlt_.solve(S_);
    KT_.noalias() = actuation_.B_pinv.lazyProduct(T.transpose());
    R_.noalias() = KT_.lazyProduct(E_);
    u_0_.noalias() = actuation_.B_pinv.lazyProduct(tau_d);
    return nullptr;
  }

  /// Fills the status and beta, and what decides: the actuator and the sign of its limit.
  void shoot(Capability& capability) {
    lengths_ = R_.rowwise().norm();
    const double flat = kRowTolerance * lengths_.maxCoeff();
    double beta = kInfinity;
    for (Eigen::Index i = 0; i < u_0_.size(); ++i) {
      const double above = actuation_.u_max[i] - u_0_[i], below = u_0_[i] - actuation_.u_min[i];
      if (!(above >= 0 && below >= 0)) {
        without_answer(Status::kInfeasible,
                       "without contact forces tau_d alone exceeds the limits of an actuator",
                       capability);
        return;
      }
      if (!(lengths_[i] > flat)) continue;
      const double reach = std::min(above, below) / lengths_[i];
      if (!(reach < beta)) continue;
      beta = reach;
      active_ = i;
      sign_ = above <= below ? 1 : -1;
    }
    if (beta == kInfinity) {
      without_answer(Status::kUnbounded, "no limit of an actuator is finite", capability);
      return;
    }
    capability.conclude(Status::kOptimal);
    capability.beta = beta;
  }

  void differentiate_at_limit(Capability& capability) {
    const double length = lengths_[active_];
    worst_.noalias() = R_.row(active_).transpose() * (sign_ / length);
    f_.noalias() = E_.lazyProduct(worst_);
    f_ *= capability.beta;
    v_dot_.noalias() = dynamics_.X().lazyProduct(f_);
    capability.lambda.noalias() = actuation_.B_pinv.row(active_).transpose() * (-sign_ / length);
    g_.noalias() = dynamics_.T().lazyProduct(capability.lambda);
    g_ = ldlt_.solve(g_);
    z_.noalias() = dynamics_.X().lazyProduct(g_);
    dynamics_.mass_slopes(z_, v_dot_, capability.beta_q);
    pull_.noalias() = dynamics_.W().lazyProduct(f_);
    rest_ = capability.lambda - z_;
    capability.beta_J.noalias() = pull_ * rest_.transpose();
    pull_.noalias() = dynamics_.W().lazyProduct(g_);
    capability.beta_J.noalias() -= pull_ * v_dot_.transpose();
  }

  /// u of the worst direction, and the residual: its equation of motion and acceleration, how far
  /// the worst directions of all actuators exceed the limits, and a value by dense inverses.
  void recover(const Eigen::VectorXd& tau_d, Capability& capability) const {
    capability.u = u_0_ + R_ * worst_ * capability.beta;
    const Eigen::MatrixXd &T = dynamics_.T(), &M = dynamics_.M();
    const Eigen::VectorXd motion = actuation_.B * capability.u - M * v_dot_ - tau_d;
    const Eigen::VectorXd acceleration = T * v_dot_ - capability.beta * (S_ * worst_);
    Residual& residual = capability.residual;
    residual = {};
    residual.balance =
        std::max(motion.lpNorm<Eigen::Infinity>(), acceleration.lpNorm<Eigen::Infinity>());
    double dense = kInfinity;
    const Eigen::MatrixXd rows =
        actuation_.B_pinv * T.transpose() * (T * M.inverse() * T.transpose()).inverse() * S_;
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      const double most = rows.row(i).norm() * capability.beta;
      const double above = actuation_.u_max[i] - u_0_[i], below = u_0_[i] - actuation_.u_min[i];
      residual.bounds = std::max(residual.bounds, most - std::min(above, below));
      if (most > 0) dense = std::min(dense, std::min(above, below) * (capability.beta / most));
    }
    if (capability.beta > 0) residual.gap = std::abs(dense - capability.beta);
  }

  TaskDynamics dynamics_;
  const Zonotope& actuation_;
  SmallMatrix S_, E_, gram_;
  Eigen::MatrixXd KT_, R_;
  Eigen::VectorXd u_0_, lengths_, v_dot_, z_, rest_;
  SmallVector worst_, f_, g_;
  Vector6d pull_;
  Eigen::LDLT<SmallMatrix> ldlt_;
  Eigen::Index active_ = 0;
  double sign_ = 1;  ///< 1 at the upper limit, -1 at the lower one
};

}  // namespace

std::unique_ptr<Measure> make_dynamic_capability(const Problem& problem) {
  return std::make_unique<DynamicCapability>(problem);
}

}  // namespace maxwrench
