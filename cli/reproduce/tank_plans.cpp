#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/suite/product.h"
#include "benchmarks/tables/write_file.h"
#include "cli/reproduce/reproduce.h"
#include "maxwrench/load.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory_proof.h"
#include "solvers/solve/method.h"
#include "solvers/solve/tank.h"

namespace maxwrench {
namespace {

/// A table of theta_r for a task.
struct TankPlan {
  Problem problem;
  std::string name;  ///< how it was found
  Eigen::MatrixXd knots;
};

/// What is proven; none for schemes that are no motion.
double proven_value(const TankPlan& plan, int threads) {
  if (plan.problem.motion->scheme != Scheme::kSpline) return std::nan("");
  Options options;
  options.threads = threads;
  const TrajectoryProof proof = certify_trajectory(plan.problem, plan.knots, options);
  return proof.status == Status::kProven ? proof.guaranteed : std::nan("");
}

/// The line of a plan, executed with or without the inverse of the lag.
std::string plan_line(const TankPlan& plan, double proven, bool inverse) {
  const Problem& problem = plan.problem;
  const TrajectorySolverEntry& solver = trajectory_solvers().front();
  TrajectoryEvaluator evaluator(problem, Wrench::kPure, solver.make);
  evaluator.evaluate(plan.knots);
  if (evaluator.trajectory().status == Status::kOptimal) evaluator.evaluate_between_knots();
  const Trajectory& trajectory = evaluator.trajectory();
  TankOptions tank;
  tank.invert_lag = inverse;
  const ScriptOptions script{.interpolation = usual_interpolation(problem)};
  const TrajectoryExperiment done =
      simulate_trajectory(problem, trajectory, Wrench::kPure, solver, script, "cvode", tank);
  const TankSummary& summary = done.run.summary;
  const bool ran = !done.run.samples.empty();
  const double reading = ran ? reading_of(summary) : std::nan("");
  const char* const held = !ran ? "-" : summary.held ? "yes" : summary.lost ? "lost" : "no";
  const double lag = problem.motion->thruster_lag;
  return fmt::format(
      "{:<9} {:<10} {:<5} {:<8} {} {} {} {} {:>8} {:>6} {:>5}\n", to_string(problem.motion->scheme),
      plan.name, lag > 0 ? fmt::format("{:g}", lag) : "none", inverse ? "inverse" : "lead",
      in_column(trajectory.value, 8, 3), in_column(trajectory.value_between_knots, 8, 3),
      in_column(proven, 8, 3), in_column(reading, 8, 3),
      ran ? fmt::format("{:.4f}", reading / done.script.planned) : "none",
      ran ? fmt::format("{:.3f}", summary.configuration_error) : "-", held);
}

/// The trajectories of `reproduce_motion`; then, without and with the lag of the tank's thrusters,
/// the constant default and the best trajectory that is proven.
std::vector<TankPlan> plans_of(const char* name, const std::filesystem::path& folder, int threads,
                               long budget) {
  std::vector<TankPlan> plans;
  const Problem task = load_problem(name);
  for (const std::string& scheme : scheme_names(task.motion->impulse)) {
    Problem problem = task;
    set_scheme("scheme", scheme, problem);
    const std::filesystem::path file = trajectory_file(folder, problem);
    if (!std::filesystem::exists(file)) continue;
    plans.push_back({problem, "optimised", load_knots(file, problem)});
  }
  Options options;
  options.budget = budget;
  options.threads = threads;
  for (const bool lagged : {false, true}) {
    Problem planned = task;
    if (lagged) planned.motion->thruster_lag = TankOptions().thruster_lag;
    plans.push_back({planned, "constant", default_knots(task)});
    const TrajectoryProof found = solve_proven(planned, options);
    if (found.status != Status::kProven) continue;
    const Eigen::MatrixXd& knots = found.answer.trajectory.knots;
    plans.push_back({planned, "proven", knots});
    write_file(trajectory_file(folder, planned, lagged ? "_lag" : "_proven"),
               knots_csv(planned, knots));
  }
  return plans;
}

}  // namespace

PaperTable reproduce_tank(const std::filesystem::path& folder, int threads, long budget) {
  std::string text = fmt::format(
      "What each trajectory is worth when the virtual tank executes it (docs/tank.md).\n"
      "lag: time constant of the thrusters that the trajectory allows for, s; none: none.\n"
      "found_by: optimised: of uvms_motion.txt; constant: the default posture; proven: --proven.\n"
      "feedforward: lead: as always; inverse: efforts that the thrusters reach (--invert-lag).\n"
      "value: at the instants; between: between knots; proven: at every instant; reading: the\n"
      "least along a path, in an impulse that at t_h; share: the reading over the value that is\n"
      "planned, of which {:g} % less is requested; error: of all joints and the base, rad or m,\n"
      "at most {:g} is allowed.\n",
      100 * TankOptions().margin, kTrackedConfigurationError);
  for (const char* name : {"uvms/valve_trajectory", "uvms/valve_impulse", "uvms/lift_impulse"}) {
    text += fmt::format(
        "\n{}: {}\n"
        "scheme    found_by   lag   feedfwd     value  between   proven  reading    share  error  "
        "held\n",
        name, load_problem(name).unit());
    for (const TankPlan& plan : plans_of(name, folder, threads, budget)) {
      const double proven = proven_value(plan, threads);
      for (const bool inverse : {false, true}) text += plan_line(plan, proven, inverse);
    }
  }
  write_file(folder / "tank_plans.txt", text);
  return {text, true};
}

}  // namespace maxwrench
