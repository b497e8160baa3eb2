#include <cstdio>

#include "maxwrench/figures.h"
#include "maxwrench/load.h"
#include "maxwrench/objective.h"
#include "maxwrench/strategies.h"

double plain(int size);

/// Memory changes hands in both directions: what the library allocated is freed and resized here,
/// and the other way round.
int main() {
  using namespace maxwrench;
  const Problem problem = load_problem("planar/force");
  SearchOptions options;
  options.budget = 200;
  options.start = problem.theta_r_default;
  const auto objective = make_capability_objective(
      problem, Wrench::kPure, [&problem] { return make_ellipsoid(problem.robot); });
  SearchResult result;
  for (int size = 1; size < 200; ++size) {
    result.theta_r = Eigen::VectorXd::Constant(size, 1.0);
    Eigen::VectorXd gradient(size);
    objective->evaluate(problem.theta_r_default, &gradient);
    if (gradient.size() != problem.redundancy()) return 1;
    gradient.resize(size);
  }
  result = find_search("grid+annealing").make()->maximize(*objective, options);
  Problem copy = load_problem("uvms/lift");
  copy = problem;
  const std::string svg = posture_figure(copy, {{"beta", result.theta_r}});
  std::printf("native %.6f %d %.0f\n", result.value, svg.ends_with("</svg>\n"), plain(600));
}
