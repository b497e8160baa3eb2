// A measure of your own, by its name: how little effort a posture costs at rest, -|tau_d|^2. It
// does not depend on a wrench. "ease" returns its derivatives with respect to tau_d and J, from
// which the library computes those with respect to theta_r. "ease_value" returns the value alone,
// and the library takes differences.
#include <cstdio>

#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"

using namespace maxwrench;

class Ease : public Measure {
 public:
  void evaluate_well_formed(const Posture& posture, const WrenchProgram&, bool,
                            Capability& capability) override {
    capability.conclude(Status::kOptimal);
    capability.beta = -posture.tau_d.squaredNorm();
    capability.lambda = -2 * posture.tau_d;          // d beta / d tau_d
    capability.beta_J.setZero(6, posture.J.cols());  // d beta / d J
  }
};

double ease(const Posture& posture, const WrenchProgram&) { return -posture.tau_d.squaredNorm(); }

int main() {
  add_measure({"ease", "minus the squared load at rest", false, false, "N^2 m^2",
               [](const Problem&, auto) { return std::make_unique<Ease>(); }});
  add_measure({"ease_value", "the same without derivatives", false, false, "N^2 m^2",
               [](const Problem&, auto) { return make_value_measure(ease); }});

  const Problem task = load_problem("fixed/push");
  Options options;
  options.measure = "ease";
  const Answer start = evaluate(task, task.theta_r_default, options);
  std::printf("default  %.6f\n", start.beta());
  std::printf("gradient %.4f\n", start.trajectory.gradient(0, 0));
  options.measure = "ease_value";
  const Answer by_value = evaluate(task, task.theta_r_default, options);
  std::printf("slope    %.4f\n", by_value.trajectory.gradient(0, 0));

  options.budget = 2000;
  const Answer best = solve(task, options);
  std::printf("best     %.6f %s\n", best.beta(), best.unit.c_str());
}
