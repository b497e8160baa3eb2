// Single local solves of beta_2 from the same random postures with a value: the share that reaches
// the best known value within 0.1 %, and the evaluations and the time of one solve. Where a second
// arm has several IK solutions, the solves between facets start from each of them.

#include <benchmark/benchmark.h>

#include <memory>
#include <vector>

#include "lib/math/random.h"
#include "lib/search/facet_program.h"
#include "maxwrench/load.h"
#include "maxwrench/objective.h"
#include "maxwrench/problem.h"
#include "solvers/search/facet_nlp.h"
#include "solvers/search/facet_sqp.h"
#include "solvers/search/multistart.h"
#include "solvers/solve/method.h"

namespace maxwrench {
namespace {

constexpr int kStarts = 1000;
constexpr long kMostEvaluations = 1000;  // limit of one solve; none needs as many
constexpr double kShort = 1e-3;

struct Target {
  const char* problem;
  double best;  ///< the best value found by any search
};
constexpr Target kTargets[] = {
    {"planar/force", 3.47748},       {"uvms/valve", 35.40830},        {"uvms/lift", 108.40954},
    {"dual_arm/bar_wall", 37.94392}, {"dual_arm/two_arms", 87.85696},
};

/// A start: x in the unit cube of the bounds, and an IK solution.
struct LocalStart {
  Eigen::VectorXd x;
  int ik_solution = 0;
};

/// One local solve; returns the best value that it evaluated.
using LocalSolve = double (*)(Probe& probe, FacetProgram& program, const Box& box,
                              const LocalStart& start);

template <FacetEnd (*solve)(FacetView&)>
double between_facets(Probe& probe, FacetProgram& program, const Box& box,
                      const LocalStart& start) {
  return solve_from(probe, program, box, box.theta_r(start.x), start.ik_solution, solve);
}

double bilevel(Probe& probe, FacetProgram& /*program*/, const Box& box, const LocalStart& start) {
  optimise_by_ipopt(probe, box, box.theta_r(start.x));
  return probe.found().best.value;
}

/// With `every_ik_solution`, each IK solution is a start of its own.
std::vector<LocalStart> random_starts(Objective& objective, FacetProgram& program,
                                      bool every_ik_solution) {
  const Box box(objective);
  Random random(1);
  std::vector<LocalStart> starts;
  for (int found = 0; found < kStarts;) {
    LocalStart start{Eigen::VectorXd(box.free()), 0};
    for (double& x_j : start.x) x_j = random.uniform();
    const Eigen::VectorXd theta_r = box.theta_r(start.x);
    if (evaluate_one(objective, theta_r) == -kInfinity) continue;
    ++found;
    const int ik_solutions = every_ik_solution ? program.ik_solutions(theta_r) : 1;
    for (start.ik_solution = 0; start.ik_solution < ik_solutions; ++start.ik_solution)
      starts.push_back(start);
  }
  return starts;
}

void time_solves(benchmark::State& state, const Target& target, LocalSolve solve,
                 bool every_ik_solution) {
  const Problem problem = load_problem(target.problem);
  const MeasureMaker make = resolve(problem, Case{problem.name}).make_measure;
  const auto objective = make_capability_objective(problem, Wrench::kPure, make);
  FacetProgram program(problem, Wrench::kPure, make);
  const std::vector<LocalStart> starts = random_starts(*objective, program, every_ik_solution);
  const Box box(*objective);
  const SearchOptions options;
  SearchRun run(options);
  long reached = 0, evaluations = 0;
  for (auto _ : state) {
    for (const LocalStart& start : starts) {
      Probe probe(*objective, kMostEvaluations, run);
      reached += solve(probe, program, box, start) >= (1 - kShort) * target.best;
      evaluations += probe.found().trace.evaluations();
    }
  }
  const auto solves = static_cast<double>(state.iterations()) * static_cast<double>(starts.size());
  state.counters["reached_%"] = 100 * static_cast<double>(reached) / solves;
  state.counters["evaluations"] = static_cast<double>(evaluations) / solves;
  state.counters["solves"] = static_cast<double>(starts.size());
}

void add_target(const Target& target) {
  const auto add = [&](const char* name, LocalSolve solve, bool every_ik_solution) {
    benchmark::RegisterBenchmark((std::string(target.problem) + "/" + name).c_str(),
                                 [=, &target](benchmark::State& state) {
                                   time_solves(state, target, solve, every_ik_solution);
                                 })
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond);
  };
  add("facet_sqp", between_facets<solve_facets_by_slsqp>, true);
  add("facet_nlp", between_facets<solve_facets_by_ipopt>, true);
  add("bilevel", bilevel, false);
}

}  // namespace
}  // namespace maxwrench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  for (const maxwrench::Target& target : maxwrench::kTargets) maxwrench::add_target(target);
  benchmark::RunSpecifiedBenchmarks();
}
