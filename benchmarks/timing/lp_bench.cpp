// Times only the lower level: our solvers that exploit the structure, without and with the efforts
// (+u, the output of general solvers), and every general simplex in three forms of the program, on
// random postures and along a walk in small steps. Then prints how many times faster ours are than
// the better of Clp and GLPK in the same run. All solvers use tolerances of 1e-9.
//
// The assembly of a general solver's program is not timed. The time includes checking the answer,
// as everywhere, and passing the program to the library in one of three ways:
//
//     cold   loaded anew, from the slack basis
//     basis  loaded anew, from the last basis
//     model  the library's model is kept, edited in place, and keeps its basis

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/timing/lp_forms.h"
#include "lib/math/random.h"
#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "maxwrench/strategies.h"
#include "solvers/lp/makers.h"

namespace maxwrench {
namespace {

constexpr int kPrograms = 1024;
constexpr double kWalkStep = 0.01;  // share of each coordinate's range

/// Wrench programs of one problem and wrench, and their forms.
struct Set {
  std::string title;  ///< problem/wrench/postures
  bool pure = false;
  const Problem* problem = nullptr;
  std::vector<Eigen::VectorXd> theta_r;
  std::vector<WrenchProgram> programs;
  std::map<ProgramForm, std::vector<LinearProgram>> forms;
};

std::vector<Eigen::VectorXd> postures(const Problem& problem, bool walk) {
  Random random(1);
  std::vector<Eigen::VectorXd> result;
  Eigen::VectorXd theta_r = problem.theta_r_default;
  Eigen::VectorXd next = theta_r;
  PostureEvaluator model(problem, false);
  while (static_cast<int>(result.size()) < kPrograms) {
    for (int j = 0; j < problem.redundancy(); ++j) {
      const double low = problem.theta_r_min[j];
      const double high = problem.theta_r_max[j];
      const double step = kWalkStep * (high - low) * random.uniform(-1, 1);
      next[j] = walk ? std::clamp(theta_r[j] + step, low, high) : random.uniform(low, high);
    }
    // The second arm must reach its contact.
    if (problem.contact && model.evaluate(next).status != Status::kValid) continue;
    theta_r = next;
    result.push_back(theta_r);
  }
  return result;
}

/// Scales tau_d up until it cannot be balanced. The planar vehicle has no load, so it gets one.
void overload(WrenchProgram& program, WrenchSolver& judge, Random& random) {
  Capability capability;
  if (program.tau_d.norm() < 1e-9) {
    for (double& t : program.tau_d) t = random.normal();
  }
  for (int attempt = 0; attempt < 20; ++attempt) {
    judge.solve(program, false, capability);
    if (capability.status == Status::kInfeasible) return;
    program.tau_d *= 3;
  }
}

std::unique_ptr<Set> make_set(const Problem& problem, Wrench wrench, bool walk, bool overloaded) {
  auto set = std::make_unique<Set>();
  set->title = fmt::format("{}/{}/{}{}", problem.name, to_string(wrench), walk ? "walk" : "random",
                           overloaded ? "+infeasible" : "");
  set->pure = wrench == Wrench::kPure && !problem.contact;
  set->problem = &problem;
  set->theta_r = postures(problem, walk);
  PostureEvaluator model(problem, false);
  WrenchProgram program = make_wrench_program(problem, wrench);
  const auto judge = find_wrench_solver("condensed").make();
  Random random(2);
  for (const Eigen::VectorXd& theta_r : set->theta_r) {
    set_posture(model.evaluate(theta_r), program);
    set->programs.push_back(program);
    if (overloaded && set->programs.size() % 2 == 0) {
      overload(set->programs.back(), *judge, random);
    }
    for (const ProgramForm form :
         {ProgramForm::kPaper, ProgramForm::kSubstituted, ProgramForm::kReduced}) {
      set->forms[form].push_back(make_form(set->programs.back(), form));
    }
  }
  return set;
}

void time_own(benchmark::State& state, const Set& set, const char* name, bool efforts) {
  const auto solver = find_wrench_solver(name).make();
  Capability capability;
  std::size_t i = 0;
  for (auto _ : state) {
    solver->solve(set.programs[i++ % kPrograms], efforts, capability);
    benchmark::DoNotOptimize(capability.beta);
  }
}

/// Times theta_r -> J, tau_d -> beta without the collision check.
void time_total(benchmark::State& state, const Set& set, const char* name) {
  PostureEvaluator model(*set.problem, false);
  WrenchProgram program = set.programs.front();
  const auto solver = find_wrench_solver(name).make();
  Capability capability;
  std::size_t i = 0;
  for (auto _ : state) {
    set_posture(model.evaluate(set.theta_r[i++ % kPrograms]), program);
    solver->solve(program, false, capability);
    benchmark::DoNotOptimize(capability.beta);
  }
}

/// How a general solver gets its programs.
enum class Start { kCold, kBasis, kModel };
constexpr std::pair<Start, const char*> kStarts[] = {
    {Start::kCold, "cold"}, {Start::kBasis, "basis"}, {Start::kModel, "model"}};

/// Null if the solver cannot keep its model.
std::unique_ptr<LpSolver> make_general(const LpEntry& entry, Start start) {
  if (start != Start::kModel) return entry.make();
  if (std::string_view(entry.name) == "clp") return make_clp_keeping_its_model();
  if (std::string_view(entry.name) == "glpk") return make_glpk_keeping_its_model();
  return nullptr;
}

void time_general(benchmark::State& state, const std::vector<LinearProgram>& programs,
                  const LpEntry& entry, Start start) {
  const auto solver = make_general(entry, start);
  LpSolution solution;
  std::size_t i = 0;
  for (auto _ : state) {
    if (start == Start::kCold) solution.basis.clear();
    solver->solve(programs[i++ % kPrograms], solution);
    benchmark::DoNotOptimize(solution.objective);
  }
}

const char* own_solver(const Set& set) { return set.pure ? "facets" : "condensed"; }

void add_set(const Set& set) {
  const auto add = [&](const std::string& rest, auto body) {
    benchmark::RegisterBenchmark((set.title + "/" + rest).c_str(), body)
        ->Unit(benchmark::kMicrosecond)
        ->MinTime(0.05)
        ->Repetitions(5)
        ->ReportAggregatesOnly();
  };
  for (const char* name : {"facets", "condensed"}) {
    if (!set.pure && find_wrench_solver(name).one_column_only) continue;
    for (const bool efforts : {false, true}) {
      add(std::string(name) + (efforts ? "+u" : ""),
          [&set, name, efforts](benchmark::State& state) { time_own(state, set, name, efforts); });
    }
  }
  add("total", [&set](benchmark::State& state) { time_total(state, set, own_solver(set)); });
  for (const LpEntry& entry : lp_solvers()) {
    if (std::string_view(entry.name) == "ipopt") continue;  // no simplex, and 100 times slower
    for (const auto& [form, programs] : set.forms) {
      for (const auto& [start, label] : kStarts) {
        if (!make_general(entry, start)) continue;
        add(fmt::format("{}/{}/{}", entry.name, to_string(form), label),
            [&programs = programs, &entry, start = start](benchmark::State& state) {
              time_general(state, programs, entry, start);
            });
      }
    }
  }
}

/// Prints as usual and keeps the medians, in microseconds of processor time.
class Collector : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      if (run.aggregate_name == "median") {
        medians[run.run_name.function_name] = run.GetAdjustedCPUTime();
      }
    }
  }
  std::map<std::string, double> medians;
};

/// The faster of Clp and GLPK on a form, NaN if they were filtered out.
double best_peer(const Collector& collector, const Set& set, const char* form, const char* start) {
  double best = NAN;
  for (const char* peer : {"clp", "glpk"}) {
    const auto found =
        collector.medians.find(fmt::format("{}/{}/{}/{}", set.title, peer, form, start));
    if (found != collector.medians.end()) best = std::fmin(best, found->second);
  }
  return best;
}

void print_legend() {
  fmt::print(
      "\nHow many times faster than the best of Clp and GLPK (medians, microseconds).\n"
      "facets, box: always cold; without efforts, +u with them. total: from theta_r, with poses,\n"
      "J and tau_d, without efforts, against the peers' solve alone; no collision check.\n"
      "Peers: tolerances 1e-9 as ours, with efforts (F3: those of the thrusters), multipliers.\n"
      "cold: loaded, slack basis; basis: loaded, last basis; model: edited in place, last basis.\n"
      "No peer knows the facets of {{B u}} or eliminates by structure: it gets F3 for free.\n");
  fmt::print("{:<36} {:<17} {:>8}  {:>20}   {:>20}   {:>20}\n", "programs", "solver", "us",
             "cold F1    F2    F3", "basis F1    F2    F3", "model F1    F2    F3");
}

void print_ratios(const Collector& collector, const std::vector<std::unique_ptr<Set>>& sets) {
  print_legend();
  for (const auto& set : sets) {
    const std::string own = own_solver(*set);
    std::vector<std::pair<std::string, std::string>> rows = {
        {own, own}, {own + "+u", own + "+u"}, {"total", "total"}};
    for (const char* form : {"F2", "F3"}) {
      for (const char* start : {"cold", "basis"}) {
        rows.emplace_back(fmt::format("simplex {} {}", form, start),
                          fmt::format("simplex/{}/{}", form, start));
      }
    }
    for (const auto& [label, path] : rows) {
      const auto found = collector.medians.find(set->title + "/" + path);
      if (found == collector.medians.end()) continue;
      fmt::print("{:<36} {:<17} {:>8.3f} ", set->title, label, found->second);
      for (const auto& [start, name] : kStarts) {
        for (const char* form : {"F1", "F2", "F3"}) {
          fmt::print(" {:>6.1f}", best_peer(collector, *set, form, name) / found->second);
        }
        fmt::print("  ");
      }
      fmt::print("\n");
    }
  }
}

}  // namespace
}  // namespace maxwrench

int main(int argc, char** argv) {
  using namespace maxwrench;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  std::vector<std::unique_ptr<Problem>> problems;
  std::vector<std::unique_ptr<Set>> sets;
  for (const std::string& name : shipped_problems()) {
    const bool chosen = name == "planar/force" || name == "uvms/valve" ||
                        name == "dual_arm/bar_wall" || name == "dual_arm/two_arms";
    if (!chosen) continue;  // one task for each robot
    problems.push_back(std::make_unique<Problem>(load_problem(name)));
    for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
      for (const bool overloaded : {false, true}) {
        for (const bool walk : {false, true}) {
          sets.push_back(make_set(*problems.back(), wrench, walk, overloaded));
          add_set(*sets.back());
        }
      }
    }
  }
  Collector collector;
  benchmark::RunSpecifiedBenchmarks(&collector);
  print_ratios(collector, sets);
}
