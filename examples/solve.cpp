// The strongest posture of a shipped problem, or of a task file: solve [PROBLEM]
#include <cstdio>
#include <exception>

#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"

using namespace maxwrench;

int main(int argc, char** argv) try {
  const Problem problem = load_problem(argc > 1 ? argv[1] : "planar/force");

  // beta_2: the wrench along c alone, with any efforts within their limits.
  const MeasureMaker make = [&problem] {
    return make_linf_polytope(problem.robot, find_wrench_solver("box").make());
  };
  const auto objective = make_capability_objective(problem, Wrench::kPure, make);
  std::printf("default posture  %.6f %s\n", objective->evaluate(problem.theta_r_default),
              problem.unit());

  const SearchResult best =
      find_search(general_search()).make()->maximize(*objective, SearchOptions());
  std::printf("best posture     %.6f %s, %s\n", best.value, problem.unit(), to_string(best.status));
  if (best.status != Status::kBestFound) return 1;

  // What the actuators do there.
  PostureEvaluator model(problem);
  WrenchProgram program = make_wrench_program(problem, Wrench::kPure);
  Capability capability;
  evaluate_best(model, best.theta_r, *make(), true, program, capability);
  for (int i = 0; i < best.theta_r.size(); ++i) {
    std::printf("%-16s %9.5f\n", problem.theta_r_name(i).c_str(), best.theta_r[i]);
  }
  for (const double effort : capability.u) std::printf("effort           %9.5f\n", effort);
} catch (const std::exception& error) {
  std::fprintf(stderr, "solve: %s\n", error.what());
  return 2;
}
