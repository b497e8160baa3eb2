#include <cmath>
#include <stdexcept>

#include "lib/measure.h"
#include "lib/posture.h"
#include "lib/wrench_program.h"

namespace maxwrench {
namespace {

/// Pivots of G'G below this share of the largest mean that J'W has not full column rank.
constexpr double kRankTolerance = 1e-14;

/// max c_w'w subject to |G w + g| <= 1, G = W_u B^+ J'W (m×k), g = W_u B^+ tau_d (m), by
///
///     z = -(G'G)^-1 G'g,  rho^2 = 1 - |g + G z|^2,  s^2 = c_w'(G'G)^-1 c_w,
///     beta = c_w'z + rho s,  w = z + (rho/s) (G'G)^-1 c_w.
///
/// With e = G w + g the multiplier of the constraint is s/rho (from c_w = (s/rho) G'e), so lambda =
/// -(s/rho) (W_u B^+)'e. For W = c this is the positive root of eq:transmissionUVMS.
class Ellipsoid : public Measure {
 public:
  explicit Ellipsoid(const Zonotope& actuation) : B_pinv_(actuation.B_pinv) {
    const Eigen::VectorXd limit = actuation.u_min.cwiseAbs().cwiseMin(actuation.u_max.cwiseAbs());
    K_ = limit.cwiseInverse().asDiagonal() * actuation.B_pinv;
  }

  void evaluate(const Posture& /*posture*/, const WrenchProgram& program, bool efforts,
                Capability& capability) override {
    capability.iterations = 0;
    G_.noalias() = K_.lazyProduct(program.JtW);
    g_.noalias() = K_.lazyProduct(program.tau_d);
    const char* reason = solve(program, capability);
    capability.status = *reason == 0 ? Status::kOptimal : Status::kInfeasible;
    capability.reason = reason;
    if (*reason != 0) return;
    capability.h.noalias() = program.W * capability.w;
    capability.beta_J.noalias() = capability.h * capability.lambda.transpose();
    if (efforts) capability.u = B_pinv_ * (program.tau_d + program.JtW * capability.w);
  }

 private:
  /// Fills beta, w and lambda; returns why there is no value, or "".
  const char* solve(const WrenchProgram& program, Capability& capability) {
    if (g_.squaredNorm() > 1) return "the weights alone leave the ellipsoid: origin outside";
    normal_.noalias() = G_.transpose().lazyProduct(G_);
    ldlt_.compute(normal_);
    const auto pivots = ldlt_.vectorD();
    if (!(pivots.minCoeff() > kRankTolerance * pivots.maxCoeff())) {
      return "J'W has not full column rank";
    }
    capability.w.noalias() = G_.transpose().lazyProduct(-g_);
    ldlt_.solveInPlace(capability.w);  // z
    direction_ = program.c_w;
    ldlt_.solveInPlace(direction_);
    e_ = g_;
    e_.noalias() += G_.lazyProduct(capability.w);
    const double rho = std::sqrt(1 - e_.squaredNorm());
    const double s = std::sqrt(program.c_w.dot(direction_));
    if (!(rho > 0)) return "the ellipsoid is a point";
    capability.beta = program.c_w.dot(capability.w) + rho * s;
    capability.w += (rho / s) * direction_;
    e_.noalias() += (rho / s) * G_.lazyProduct(direction_);
    capability.lambda.noalias() = (-s / rho) * K_.transpose().lazyProduct(e_);
    return "";
  }

  Eigen::MatrixXd B_pinv_, K_, G_, normal_;
  Eigen::VectorXd g_, e_, direction_;
  Eigen::LDLT<Eigen::MatrixXd> ldlt_;
};

}  // namespace

std::unique_ptr<Measure> make_ellipsoid(const Robot& robot) {
  const Zonotope& actuation = robot.actuation;
  if (!actuation.full_row_rank()) {
    throw std::invalid_argument("measure ellipsoid: B of " + robot.name + " has rank " +
                                std::to_string(actuation.rank) + ", expected " +
                                std::to_string(actuation.dimension()));
  }
  if ((actuation.u_min.array() >= 0).any() || (actuation.u_max.array() <= 0).any()) {
    throw std::invalid_argument("measure ellipsoid: an actuator of " + robot.name +
                                " cannot act in both directions, expected min < 0 < max");
  }
  return std::make_unique<Ellipsoid>(actuation);
}

}  // namespace maxwrench
