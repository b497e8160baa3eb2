#include "maxwrench/measure.h"
#include "maxwrench/posture.h"
#include "maxwrench/wrench_program.h"

namespace maxwrench {

const Posture& evaluate_best(PostureEvaluator& model, const Eigen::VectorXd& theta_r,
                             Measure& measure, bool efforts, WrenchProgram& program,
                             Capability& capability) {
  const Posture& first = model.evaluate(theta_r);
  if (first.status != Status::kValid) return first;
  const auto value = [&](const Posture& posture, bool fill_efforts) {
    set_posture(posture, program);
    measure.evaluate(posture, program, fill_efforts, capability);
    return capability.status == Status::kOptimal ? capability.beta : -kInfinity;
  };
  const int branches = model.branches();
  if (branches == 1) {
    value(first, efforts);
    return first;
  }
  int best = 0;
  double most = -kInfinity;
  for (int i = 0; i < branches; ++i) {
    const double beta = value(model.select(i), false);
    if (beta <= most) continue;
    most = beta;
    best = i;
  }
  const Posture& posture = model.select(best);
  if (efforts || best != branches - 1) value(posture, efforts);
  return posture;
}

}  // namespace maxwrench
