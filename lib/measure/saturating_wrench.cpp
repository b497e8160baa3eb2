#include <cmath>

#include "lib/math/decompositions.h"
#include "lib/measure/closed_form.h"
#include "maxwrench/posture.h"
#include "maxwrench/wrench_program.h"

namespace maxwrench {
namespace {

/// An actuator whose slope is below this share of the largest carries no load.
constexpr double kSlopeTolerance = 1e-12;

/// The largest x with u_min <= K (tau_d + J'W x) <= u_max, and beta = c_w x. Each actuator limits x
/// to the ratio of the effort that its limit leaves to the effort that one unit of x takes. K =
/// W_u^-1 (B W_u^-1)^+ (m×n) gives the efforts with the least |W_u u|. If actuator i saturates,
/// lambda = -c_w K'e_i / (K J'W)_i.
class SaturatingWrench : public Measure {
 public:
  explicit SaturatingWrench(const Robot& robot)
      : box_(make_zonotope(
            Eigen::MatrixXd::Identity(robot.actuation.actuators(), robot.actuation.actuators()),
            robot.actuation.u_min, robot.actuation.u_max)) {
    const Eigen::VectorXd limit = smaller_limits(robot.actuation);
    const Eigen::MatrixXd scaled = robot.actuation.B * limit.asDiagonal();
    K_ = limit.asDiagonal() * pseudo_inverse(scaled);
  }

  void evaluate_well_formed(const Posture& posture, const WrenchProgram& program, bool efforts,
                            Capability& capability) override {
    capability.iterations = 0;
    load_.noalias() = K_.lazyProduct(program.tau_d);
    slope_.noalias() = K_.lazyProduct(program.JtW.col(0));
    capability.status = shoot(program, capability);
    if (capability.status != Status::kOptimal) return;
    fill_wrenches(posture, program, capability);
    if (efforts) recover(program, capability);
  }

 private:
  Status shoot(const WrenchProgram& program, Capability& capability) {
    const double flat = kSlopeTolerance * slope_.norm();
    double low = -kInfinity, high = kInfinity;
    for (Eigen::Index i = 0; i < slope_.size(); ++i) {
      const double below = box_.u_min[i] - load_[i];
      const double above = box_.u_max[i] - load_[i];
      if (std::abs(slope_[i]) <= flat) {
        if (below > 0 || above < 0) high = -kInfinity;
        continue;
      }
      low = std::max(low, (slope_[i] > 0 ? below : above) / slope_[i]);
      const double leave = (slope_[i] > 0 ? above : below) / slope_[i];
      if (leave >= high) continue;
      high = leave;
      active_ = i;
    }
    if (low > high || high == -kInfinity) {
      return without_answer(Status::kInfeasible,
                            "an actuator cannot take its share of the load at any multiple of c",
                            capability);
    }
    if (high == kInfinity) {
      return without_answer(Status::kUnbounded, "the wrench does not load any actuator",
                            capability);
    }
    capability.reason = "";
    capability.beta = program.c_w[0] * high;
    capability.w.setZero(program.columns());  // a second contact exerts nothing
    capability.w[0] = high;
    capability.lambda.noalias() = K_.row(active_).transpose() * (-program.c_w[0] / slope_[active_]);
    return Status::kOptimal;
  }

  /// The balance in the robot's own rows; optimality in the rows of u = K (tau_d + J'W w).
  void recover(const WrenchProgram& program, Capability& capability) const {
    WrenchProgram ratios = program;
    ratios.actuation = &box_;
    ratios.tau_d = load_;
    ratios.JtW = slope_;
    ratios.c_w = program.c_w.head(1);
    ratios.w_min = program.w_min.head(1);
    ratios.w_max = program.w_max.head(1);
    capability.u = load_ + slope_ * capability.w[0];
    const Eigen::VectorXd multiplier =
        Eigen::VectorXd::Unit(slope_.size(), active_) * (-program.c_w[0] / slope_[active_]);
    capability.residual = recheck(ratios, capability.u, capability.w.head(1), multiplier);
    capability.residual.balance =
        recheck(program, capability.u, capability.w, capability.lambda).balance;
  }

  Zonotope box_;
  Eigen::MatrixXd K_;
  Eigen::VectorXd load_, slope_;  ///< of each actuator: K tau_d, K J'W
  Eigen::Index active_ = 0;
};

}  // namespace

std::unique_ptr<Measure> make_saturating_wrench(const Robot& robot) {
  require_full_row_rank(robot, "saturating_wrench");
  require_both_directions(robot, "saturating_wrench");
  return std::make_unique<SaturatingWrench>(robot);
}

}  // namespace maxwrench
