#include <algorithm>
#include <cmath>
#include <limits>

#include "maxwrench/measure.h"
#include "maxwrench/posture.h"
#include "maxwrench/wrench_program.h"

namespace maxwrench {
namespace {

/// The rounding of the value and the third derivative cause errors of the same order if a step is
/// the cube root of the rounding.
const double kDifference = std::cbrt(std::numeric_limits<double>::epsilon());

/// The size of the changes of each generalised force that matter: what the actuators can exert, and
/// 1 N or 1 N m where they are strong.
Eigen::VectorXd scales_of(const Zonotope& actuation) {
  const Eigen::VectorXd u = actuation.u_min.cwiseAbs().cwiseMax(actuation.u_max.cwiseAbs());
  Eigen::VectorXd scales = actuation.B.cwiseAbs() * u.cwiseMin(1 / kDifference);
  for (double& scale : scales) scale = scale > 0 ? std::min(scale, 1.0) : 1.0;
  return scales;
}

/// A measure by its value, and its derivatives by differences.
class ValueMeasure final : public Measure {
 public:
  explicit ValueMeasure(std::function<double(const Posture&, const WrenchProgram&)> value)
      : value_(std::move(value)) {}

  void evaluate_well_formed(const Posture& posture, const WrenchProgram& program, bool /*efforts*/,
                            Capability& capability) override {
    capability.conclude(Status::kOptimal);
    capability.beta = value_(posture, program);
    if (std::isnan(capability.beta)) {
      capability.conclude(Status::kInfeasible, "the measure has no value here");
    }
    capability.lambda.setZero(posture.tau_d.size());
    capability.beta_J.setZero(6, posture.J.cols());
  }

  void differentiate(const Posture& posture, const WrenchProgram& program,
                     Capability& capability) override {
    moved_ = posture;
    program_ = program;
    beta_ = capability.beta;
    differentiate_by(moved_.tau_d, scales_of(*program.actuation), capability.lambda);
    differentiate_by(moved_.J, none_, capability.beta_J);
    differentiate_by(moved_.J_2, none_, capability.beta_J2);
    differentiate_by(moved_.C_2, none_, capability.beta_C2);
  }

 private:
  /// `part` is a part of `moved_`; `scales` holds those of its entries, or nothing if they are 1.
  template <class Matrix>
  void differentiate_by(Matrix& part, const Eigen::VectorXd& scales, Matrix& slopes) {
    slopes.resizeLike(part);
    for (Eigen::Index i = 0; i < part.size(); ++i) {
      const double x = part.data()[i];
      const double step = kDifference * ((scales.size() > 0 ? scales[i] : 1) + std::abs(x));
      const double up = value_at(x + step, part.data()[i]);
      const double down = value_at(x - step, part.data()[i]);
      slopes.data()[i] = slope(up, down, step);
      part.data()[i] = x;
    }
  }

  double value_at(double changed, double& entry) {
    entry = changed;
    set_posture(moved_, program_);
    return value_(moved_, program_);
  }

  /// The central difference, or at an edge of where there is a value the one-sided one. An entry
  /// that cannot move to either side does not change the value.
  double slope(double up, double down, double step) const {
    if (!std::isfinite(up) && !std::isfinite(down)) return 0;
    if (!std::isfinite(up)) return (beta_ - down) / step;
    if (!std::isfinite(down)) return (up - beta_) / step;
    return (up - down) / (2 * step);
  }

  std::function<double(const Posture&, const WrenchProgram&)> value_;
  Posture moved_;
  WrenchProgram program_;
  double beta_ = 0;  ///< the value at the posture
  const Eigen::VectorXd none_;
};

}  // namespace

std::unique_ptr<Measure> make_value_measure(
    std::function<double(const Posture&, const WrenchProgram&)> value) {
  return std::make_unique<ValueMeasure>(std::move(value));
}

}  // namespace maxwrench
