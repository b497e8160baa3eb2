// Times theta_r -> beta (model, lower level, nothing else) for every measure, wrench and solver, on
// random postures without collision checks; and the parts of it.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <memory>
#include <vector>

#include "benchmarks/case.h"
#include "lib/random.h"
#include "lib/wrench_program.h"
#include "problems/loader.h"
#include "solvers/strategies.h"

namespace maxwrench {
namespace {

constexpr int kPostures = 1024;

std::vector<Eigen::VectorXd> random_postures(const Problem& problem) {
  Random random(1);
  std::vector<Eigen::VectorXd> postures(kPostures, Eigen::VectorXd(problem.redundancy()));
  for (Eigen::VectorXd& theta_r : postures) {
    for (int i = 0; i < problem.redundancy(); ++i) {
      theta_r[i] = random.uniform(problem.theta_r_min[i], problem.theta_r_max[i]);
    }
  }
  return postures;
}

void time_objective(benchmark::State& state, const Problem& problem, const Case& c, bool gradient) {
  const auto objective =
      make_capability_objective(problem, c.wrench, measure_maker(problem, c), false);
  const std::vector<Eigen::VectorXd> postures = random_postures(problem);
  Eigen::VectorXd slope;
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        objective->evaluate(postures[i++ % kPostures], gradient ? &slope : nullptr));
  }
}

void time_model(benchmark::State& state, const Problem& problem, bool check_collision) {
  PostureModel model(problem, check_collision);
  const std::vector<Eigen::VectorXd> postures = random_postures(problem);
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(model.evaluate(postures[i++ % kPostures]).J.data());
  }
}

void add_problem(const Problem& problem) {
  const auto name = [&](const std::string& rest) { return problem.name + "/" + rest; };
  const auto add = [](const std::string& title, auto body) {
    benchmark::RegisterBenchmark(title.c_str(), body);
  };
  add(name("model"), [&](benchmark::State& state) { time_model(state, problem, false); });
  add(name("model+collision"), [&](benchmark::State& state) { time_model(state, problem, true); });
  for (const Case& c : product(problem.name, 1, 1)) {
    if (c.search != searches()[0].name) continue;
    const std::string title = name(fmt::format("{}/{}/{}", c.measure, to_string(c.wrench), c.lp));
    add(title,
        [&problem, c](benchmark::State& state) { time_objective(state, problem, c, false); });
    add(title + "+gradient",
        [&problem, c](benchmark::State& state) { time_objective(state, problem, c, true); });
  }
}

}  // namespace
}  // namespace maxwrench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  std::vector<std::unique_ptr<maxwrench::Problem>> problems;
  for (const std::string& name : maxwrench::shipped_problems()) {
    problems.push_back(std::make_unique<maxwrench::Problem>(maxwrench::load_problem(name)));
    maxwrench::add_problem(*problems.back());
  }
  benchmark::RunSpecifiedBenchmarks();
}
