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

/// A measure by its value, and its derivatives by central differences.
class ValueMeasure final : public Measure {
 public:
  explicit ValueMeasure(std::function<double(const Posture&, const WrenchProgram&)> value)
      : value_(std::move(value)) {}

  void evaluate_well_formed(const Posture& posture, const WrenchProgram& program, bool /*efforts*/,
                            Capability& capability) override {
    capability.conclude(Status::kOptimal);
    capability.beta = value_(posture, program);
    capability.lambda.setZero(posture.tau_d.size());
    capability.beta_J.setZero(6, posture.J.cols());
  }

  void differentiate(const Posture& posture, const WrenchProgram& program,
                     Capability& capability) override {
    moved_ = posture;
    program_ = program;
    differentiate_by(moved_.tau_d, capability.lambda);
    differentiate_by(moved_.J, capability.beta_J);
    differentiate_by(moved_.J_2, capability.beta_J2);
    differentiate_by(moved_.C_2, capability.beta_C2);
  }

 private:
  /// `part` is a part of `moved_`.
  template <class Matrix>
  void differentiate_by(Matrix& part, Matrix& slopes) {
    slopes.resizeLike(part);
    for (Eigen::Index i = 0; i < part.size(); ++i) {
      const double x = part.data()[i], step = kDifference * (1 + std::abs(x));
      const auto value_at = [&](double changed) {
        part.data()[i] = changed;
        set_posture(moved_, program_);
        return value_(moved_, program_);
      };
      const double up = value_at(x + step);
      slopes.data()[i] = (up - value_at(x - step)) / (2 * step);
      part.data()[i] = x;
    }
  }

  std::function<double(const Posture&, const WrenchProgram&)> value_;
  Posture moved_;
  WrenchProgram program_;
};

}  // namespace

std::unique_ptr<Measure> make_value_measure(
    std::function<double(const Posture&, const WrenchProgram&)> value) {
  return std::make_unique<ValueMeasure>(std::move(value));
}

}  // namespace maxwrench
