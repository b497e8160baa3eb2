// Times the lower level over the instants of a slow motion, cold. Our solvers are the interior
// point method, the same after its attempt on the worst instant, and our general simplex. The peers
// are GLPK and Clp, by its dual and its primal simplex and by its choice after presolving. The
// assembly of the peers' program is not timed. Then prints how many times faster ours are than the
// best peer of the same run. Every answer is checked, as everywhere.
//
// Robots: the underwater vehicle of uvms/valve, the planar one, the wheeled one, and the underwater
// one with nine joints. Each row also shows the number of variables of an instant in the interior
// point method, and whether code for this number is compiled in.
//
// The primal simplex of Clp takes minutes for 1,000 instants and is left out there, as are GLPK and
// our simplex.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/timing/slow_trajectory.h"
#include "maxwrench/load.h"
#include "maxwrench/strategies.h"
#include "solvers/lp/makers.h"
#include "solvers/trajectory/blocks.h"
#include "solvers/trajectory/forms.h"
#include "solvers/trajectory/makers.h"

namespace maxwrench {
namespace {

constexpr double kDuration = 5;  // s
constexpr const char* kOwn[] = {"ipm", "facets_or_ipm"};

struct TimedRobot {
  std::string name;
  Problem problem;
};

/// Repeats the arm's chain of joints behind itself until there are `joints`.
Problem lengthened(Problem problem, std::size_t joints) {
  Robot& robot = problem.robot;
  const std::size_t arm = robot.joints.size();
  for (std::size_t i = arm; i < joints; ++i) {
    Joint joint = robot.joints[i - arm];
    joint.parent = static_cast<int>(i);
    robot.joints.push_back(joint);
    robot.links.push_back(robot.links[i - arm + 1]);
    problem.redundant.push_back(static_cast<int>(i));
  }
  robot.end_effectors[static_cast<std::size_t>(problem.end_effector)].link =
      static_cast<int>(joints);
  robot.collision = nullptr;
  complete_actuation(robot);
  for (Eigen::VectorXd* v :
       {&problem.theta_r_min, &problem.theta_r_max, &problem.theta_r_default}) {
    const Eigen::VectorXd of_arm = *v;
    *v = Eigen::VectorXd::NullaryExpr(static_cast<Eigen::Index>(joints),
                                      [&](Eigen::Index j) { return of_arm[j % of_arm.size()]; });
  }
  return problem;
}

std::vector<TimedRobot> timed_robots() {
  std::vector<TimedRobot> robots;
  for (const char* name : {"uvms/valve", "planar/trajectory", "mobile/trajectory"}) {
    robots.push_back({name, load_problem(name)});
  }
  robots.push_back({"nine_joints", lengthened(robots.front().problem, 9)});
  return robots;
}

/// Programs of one robot and one size.
struct Set {
  std::string robot;
  Wrench wrench;
  int instants;
  std::vector<TrajectoryProgram> programs;
  std::vector<LinearProgram> assembled;
  std::string title() const { return fmt::format("{}/{}/{}", robot, to_string(wrench), instants); }
  /// The size of an instant's block in the normal equations of `ipm`.
  std::string path() const {
    Forms forms;
    forms.build(programs.front(), true, false);
    const int d = forms.stages.front().d;
    return fmt::format("{} {}", d, is_compiled(d) ? "compiled" : "generic");
  }
};

std::unique_ptr<Set> make_set(const TimedRobot& robot, Wrench wrench, int instants) {
  const Problem& problem = robot.problem;
  auto set = std::make_unique<Set>(Set{robot.name, wrench, instants, {}, {}});
  Random random(7);
  const auto judge = find_trajectory_solver("ipm").make();
  TrajectorySolution solution;
  const std::size_t count = instants < 1000 ? 5 : 1;
  while (set->programs.size() < count) {
    TrajectoryProgram program = slow_trajectory(problem, wrench, instants, kDuration, random);
    judge->solve(program, solution);
    if (solution.status != Status::kOptimal) continue;
    set->assembled.push_back(assemble(program));
    set->programs.push_back(std::move(program));
  }
  return set;
}

void time_own(benchmark::State& state, const Set& set, const char* name) {
  const auto solver = find_trajectory_solver(name).make();
  TrajectorySolution solution;
  std::size_t i = 0;
  long iterations = 0;
  for (auto _ : state) {
    solver->solve(set.programs[i++ % set.programs.size()], solution);
    iterations += solution.iterations;
    if (solution.status != Status::kOptimal) state.SkipWithError(solution.reason.c_str());
  }
  state.counters["iterations"] =
      benchmark::Counter(static_cast<double>(iterations), benchmark::Counter::kAvgIterations);
}

using Make = std::unique_ptr<LpSolver> (*)();

void time_general(benchmark::State& state, const Set& set, Make make) {
  const auto solver = make();
  LpSolution solution;
  std::size_t i = 0;
  for (auto _ : state) {
    solution.basis.clear();
    solver->solve(set.assembled[i++ % set.assembled.size()], solution);
    if (solution.status != Status::kOptimal) state.SkipWithError(solution.reason.c_str());
  }
}

struct Peer {
  const char* name;
  Make make;
  int most;  ///< instants
};
const Peer kPeers[] = {
    {"simplex", [] { return make_simplex(); }, 100},
    {"clp", make_clp, 1000},
    {"clp_primal", [] { return make_clp_by(ClpMethod::kPrimal); }, 100},
    {"clp_presolved", [] { return make_clp_by(ClpMethod::kPresolved); }, 1000},
    {"glpk", make_glpk, 100},
};

void add_set(const Set& set) {
  const auto add = [&](const std::string& name, auto body) {
    auto* const added = benchmark::RegisterBenchmark((set.title() + "/" + name).c_str(), body);
    added->Unit(benchmark::kMicrosecond)->ReportAggregatesOnly();
    if (set.instants < 1000 || name == kOwn[0] || name == kOwn[1]) {
      added->MinTime(0.05)->Repetitions(5);
    } else {
      added->Iterations(1)->Repetitions(1);
    }
  };
  for (const char* name : kOwn) {
    add(name, [&set, name](benchmark::State& state) { time_own(state, set, name); });
  }
  for (const Peer& peer : kPeers) {
    if (set.instants > peer.most) continue;
    add(peer.name, [&set, &peer](benchmark::State& state) { time_general(state, set, peer.make); });
  }
}

/// Prints as usual and keeps the medians, in microseconds of processor time.
class Medians : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      if (run.error_occurred) continue;
      const bool single = run.run_type == Run::RT_Iteration && run.repetitions <= 1;
      if (!single && run.aggregate_name != "median") continue;
      times[run.run_name.function_name] = run.GetAdjustedCPUTime();
      const auto found = run.counters.find("iterations");
      if (found != run.counters.end()) iterations[run.run_name.function_name] = found->second;
    }
  }
  std::map<std::string, double> times, iterations;
};

double look_up(const std::map<std::string, double>& values, const std::string& name) {
  const auto found = values.find(name);
  return found == values.end() ? NAN : found->second;
}

void print_ratios(const Medians& medians, const std::vector<std::unique_ptr<Set>>& sets) {
  fmt::print("\n{:<26} {:<11} {:<11} {:>10} {:>11} {:>13} {:>15} {:>13}\n", "programs", "block",
             "solver", "us", "iterations", "us/iteration", "best peer [us]", "times faster");
  for (const auto& set : sets) {
    double best = NAN;
    for (const Peer& peer : kPeers) {
      if (std::string_view(peer.name) == "simplex") continue;
      best = std::fmin(best, look_up(medians.times, set->title() + "/" + peer.name));
    }
    for (const char* name : {kOwn[0], kOwn[1], "simplex"}) {
      const double own = look_up(medians.times, set->title() + "/" + name);
      const double iterations = look_up(medians.iterations, set->title() + "/" + name);
      if (std::isnan(own)) continue;
      fmt::print("{:<26} {:<11} {:<11} {:>10.1f} {:>11.1f} {:>13.2f} {:>15.1f} {:>13.1f}\n",
                 set->title(), set->path(), name, own, iterations, own / iterations, best,
                 best / own);
    }
  }
}

}  // namespace
}  // namespace maxwrench

int main(int argc, char** argv) {
  using namespace maxwrench;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  const std::vector<TimedRobot> robots = timed_robots();
  std::vector<std::unique_ptr<Set>> sets;
  for (const TimedRobot& robot : robots) {
    for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
      for (const int instants : {10, 100, 1000}) {
        sets.push_back(make_set(robot, wrench, instants));
        add_set(*sets.back());
      }
    }
  }
  Medians medians;
  benchmark::RunSpecifiedBenchmarks(&medians);
  print_ratios(medians, sets);
}
