#include <cmath>
#include <stdexcept>

#include "lib/measure/closed_form.h"
#include "lib/wrench_program.h"

namespace maxwrench {
namespace {

/// A slope below this share of |J'c| does not load a joint.
constexpr double kSlopeTolerance = 1e-12;

/// The largest x with u_min,j <= tau_d,j + x (J'W)_j <= u_max,j for all joints j, beta = c_w x.
/// With the joint j that saturates, lambda = -c_w e_j / (J'W)_j.
class SaturatingWrench : public Measure {
 public:
  explicit SaturatingWrench(const Robot& robot)
      : B_pinv_(robot.actuation.B_pinv),
        first_row_(static_cast<Eigen::Index>(robot.base_axes.size())),
        u_min_(robot.actuation.u_min.tail(robot.joints.size())),
        u_max_(robot.actuation.u_max.tail(robot.joints.size())) {}

  void evaluate(const Posture& /*posture*/, const WrenchProgram& program, bool efforts,
                Capability& capability) override {
    capability.iterations = 0;
    capability.status = shoot(program, capability);
    if (capability.status != Status::kOptimal) return;
    capability.h.noalias() = program.W * capability.w;
    capability.beta_J.noalias() = capability.h * capability.lambda.transpose();
    if (efforts) recover(program, capability);
  }

 private:
  Status shoot(const WrenchProgram& program, Capability& capability) const {
    const auto slopes = program.JtW.col(0);
    const double flat = kSlopeTolerance * slopes.norm();
    double low = -kInfinity, high = kInfinity;
    Eigen::Index active = -1;
    for (Eigen::Index j = 0; j < u_min_.size(); ++j) {
      const double slope = slopes[first_row_ + j];
      const double below = u_min_[j] - program.tau_d[first_row_ + j];
      const double above = u_max_[j] - program.tau_d[first_row_ + j];
      if (std::abs(slope) <= flat) {
        if (below > 0 || above < 0) high = -kInfinity;
        continue;
      }
      low = std::max(low, (slope > 0 ? below : above) / slope);
      const double leave = (slope > 0 ? above : below) / slope;
      if (leave >= high) continue;
      high = leave;
      active = j;
    }
    if (low > high) {
      capability.reason = "a joint cannot hold its load at any multiple of c";
      return Status::kInfeasible;
    }
    if (active < 0) {
      capability.reason = "the wrench does not load any joint";
      return Status::kUnbounded;
    }
    capability.reason = "";
    capability.beta = program.c_w[0] * high;
    capability.w.setConstant(1, high);
    capability.lambda.setZero(program.tau_d.size());
    capability.lambda[first_row_ + active] = -program.c_w[0] / slopes[first_row_ + active];
    return Status::kOptimal;
  }

  /// u = B^+ (tau_d + J'h): thrusters may exceed their limits, as if something held the base.
  void recover(const WrenchProgram& program, Capability& capability) const {
    capability.u = B_pinv_ * (program.tau_d + program.JtW * capability.w);
    capability.residual = recheck(program, capability.u, capability.w, capability.lambda);
    const auto joints = capability.u.tail(u_min_.size());
    capability.residual.bounds =
        std::max({0.0, (joints - u_max_).maxCoeff(), (u_min_ - joints).maxCoeff()});
  }

  Eigen::MatrixXd B_pinv_;
  Eigen::Index first_row_;
  Eigen::VectorXd u_min_, u_max_;
};

}  // namespace

std::unique_ptr<Measure> make_saturating_wrench(const Robot& robot) {
  require_full_row_rank(robot, "saturating_wrench");
  if (robot.joints.empty()) {
    throw std::invalid_argument("measure saturating_wrench: " + robot.name +
                                " has no joints, expected at least one");
  }
  return std::make_unique<SaturatingWrench>(robot);
}

}  // namespace maxwrench
