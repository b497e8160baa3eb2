// A measure of your own: how little effort a posture costs at rest, -|tau_d|^2. It does not depend
// on a wrench. A measure returns its derivatives with respect to tau_d and J. The library computes
// from them those with respect to theta_r, so methods with gradients work as well.
#include <cstdio>

#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"

using namespace maxwrench;

class Ease : public Measure {
 public:
  void evaluate_well_formed(const Posture& posture, const WrenchProgram&, bool,
                            Capability& capability) override {
    capability.conclude(Status::kOptimal);
    capability.beta = -posture.tau_d.squaredNorm();
    capability.lambda = -2 * posture.tau_d;          // d beta / d tau_d
    capability.beta_J.setZero(6, posture.J.cols());  // d beta / d J
    capability.w.resize(0);
    capability.u.resize(0);
    capability.h.setZero();
  }
};

int main() {
  const Problem problem = load_problem("fixed/push");
  const auto objective =
      make_capability_objective(problem, Wrench::kPure, [] { return std::make_unique<Ease>(); });
  Eigen::VectorXd theta_r = problem.theta_r_default, gradient(theta_r.size());
  std::printf("default  %.6f\n", objective->evaluate(theta_r, &gradient));
  std::printf("gradient %.6f\n", gradient[0]);
  const double step = 1e-5;
  theta_r[0] += step;
  const double ahead = objective->evaluate(theta_r);
  theta_r[0] -= 2 * step;
  std::printf("slope    %.6f\n", (ahead - objective->evaluate(theta_r)) / (2 * step));

  SearchOptions options;
  options.budget = 2000;
  const SearchResult best = find_search("annealing+cmaes").make()->maximize(*objective, options);
  std::printf("best     %.6f\n", best.value);
}
