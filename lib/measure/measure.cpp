#include "maxwrench/measure.h"

#include <cmath>

#include "maxwrench/posture.h"
#include "maxwrench/wrench_program.h"

namespace maxwrench {

void Capability::clear() {
  conclude(Status::kNumericalError, "nothing was computed");
  beta = 0;
  for (Eigen::VectorXd* each : {&w, &u, &lambda, &beta_q}) each->setZero();
  h.setZero();
  h_2.setZero();
  for (Matrix6Xd* each : {&beta_J, &beta_J2, &beta_C2}) each->setZero();
  iterations = 0;
  residual = {};
}

void Measure::evaluate(const Posture& posture, const WrenchProgram& program, bool efforts,
                       Capability& capability) {
  evaluate_if(maxwrench::well_formed(program), posture, program, efforts, capability);
}

void Measure::differentiate(const Posture& /*posture*/, const WrenchProgram& /*program*/,
                            Capability& /*capability*/) {}

void Measure::evaluate_if(bool well_formed, const Posture& posture, const WrenchProgram& program,
                          bool efforts, Capability& capability) {
  if (!well_formed || !solves_program()) capability.clear();
  capability.beta_q.setZero();  // a program has none, whatever was in the capability before
  if (!well_formed) {
    capability.conclude(Status::kNumericalError, kMalformed);
    return;
  }
  evaluate_well_formed(posture, program, efforts, capability);
  if (capability.status == Status::kOptimal && !std::isfinite(capability.beta)) {
    capability.conclude(Status::kNumericalError, "the value is not finite");
  }
}

const Posture& evaluate_best(PostureEvaluator& model, const Eigen::VectorXd& theta_r,
                             Measure& measure, bool efforts, WrenchProgram& program,
                             Capability& capability) {
  const Posture& first = model.evaluate(theta_r);
  if (first.status != Status::kValid) return first;
  const auto value = [&](const Posture& posture, bool fill_efforts) {
    const bool finite = set_posture(posture, program);
    measure.evaluate_if(finite, posture, program, fill_efforts, capability);
    return capability.status == Status::kOptimal ? capability.beta : -kInfinity;
  };
  const int ik_solutions = model.ik_solutions();
  if (ik_solutions == 1) {
    value(first, efforts);
    return first;
  }
  int best = 0;
  double most = -kInfinity;
  for (int i = 0; i < ik_solutions; ++i) {
    const double beta = value(model.select(i), false);
    if (beta <= most) continue;
    most = beta;
    best = i;
  }
  const Posture& posture = model.select(best);
  if (efforts || best != ik_solutions - 1) value(posture, efforts);
  return posture;
}

}  // namespace maxwrench
