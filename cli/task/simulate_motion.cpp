#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "benchmarks/tables/write_file.h"
#include "cli/output.h"
#include "cli/task/simulate.h"
#include "maxwrench/figures.h"
#include "maxwrench/strategies.h"
#include "maxwrench/tank.h"
#include "maxwrench/trajectory.h"
#include "maxwrench/version.h"
#include "solvers/solve/tank_scenarios.h"

namespace maxwrench {
namespace {

/// A trajectory and its experiment.
struct MotionAnswer : TrajectoryExperiment {
  Trajectory trajectory;
};

void require_motion_options(const Problem& problem, const SimulateOptions& options) {
  reject_given(*options.command, {"--ramp", "--hold", "--load", "--heaviest"},
               fmt::format("{} {}, expected a static task", problem.motion->impulse ? "an" : "a",
                           problem.type()));
  if (options.choice.measure != "linf_polytope") {
    throw std::invalid_argument("--measure: got " + options.choice.measure +
                                ", expected linf_polytope for a task in time");
  }
}

Interpolation interpolation_of(const Problem& problem, const SimulateOptions& options) {
  if (!options.interpolation) return usual_interpolation(problem);
  const Interpolation chosen = parse_interpolation(*options.interpolation);
  if (chosen == Interpolation::kSpline && problem.motion->k < 2 && !problem.motion->impulse) {
    throw std::invalid_argument("--interpolation: got spline for k = 1, expected linear");
  }
  return chosen;
}

/// A trajectory, and what is needed to carry it out.
struct MotionPlan {
  Wrench wrench = Wrench::kPure;
  const TrajectorySolverEntry* lp = nullptr;
  ScriptOptions script;
  Trajectory trajectory;
};

MotionPlan plan_of(const Problem& problem, const SimulateOptions& options) {
  MotionPlan plan;
  plan.wrench = options.read_options().wrench;
  plan.lp = options.choice.solver.empty() ? &trajectory_solvers().front()
                                          : &find_trajectory_solver(options.choice.solver);
  plan.script.interpolation = interpolation_of(problem, options);
  plan.script.planned = options.planned;
  plan.script.margin = options.tank.margin;
  TrajectoryEvaluator evaluator(problem, plan.wrench, plan.lp->make);
  evaluator.evaluate(knots_of(problem, options.theta_r));
  if (evaluator.trajectory().status == Status::kOptimal) evaluator.evaluate_between_knots();
  plan.trajectory = evaluator.trajectory();
  return plan;
}

MotionAnswer answer_of(const Problem& problem, const SimulateOptions& options) {
  const MotionPlan plan = plan_of(problem, options);
  return {simulate_trajectory(problem, plan.trajectory, plan.wrench, *plan.lp, plan.script,
                              options.integrator, options.tank),
          plan.trajectory};
}

int simulate_motion_list(const Problem& problem, const SimulateOptions& options) {
  require_tank_scenarios(problem);
  const MotionPlan plan = plan_of(problem, options);
  return report_experiments(problem, options,
                            simulate_scenarios(problem, plan.trajectory, plan.wrench, *plan.lp,
                                               plan.script, options.integrator, options.tank));
}

/// Adds the measurements; null where there is none.
void add_measured(const TankRun& run, nlohmann::ordered_json& object) {
  const bool ran = !run.samples.empty();
  const TankSummary& s = run.summary;
  const MotionSummary m = s.motion.value_or(MotionSummary{});
  for (const auto& [key, value] :
       {std::pair("mean", s.mean), std::pair("low", s.low), std::pair("t_low", m.t_low),
        std::pair("high", s.high), std::pair("t_high", m.t_high), std::pair("at_t_h", m.at_peak),
        std::pair("deviation", m.deviation), std::pair("off_axis_force", m.off_axis_force),
        std::pair("off_axis_torque", m.off_axis_torque),
        std::pair("theta_r_error", s.theta_r_error),
        std::pair("configuration_error", s.configuration_error),
        std::pair("position_error", s.position_error),
        std::pair("deflection_error", s.deflection_error), std::pair("saturated", s.saturated),
        std::pair("relaxed", s.relaxed), std::pair("shortfall", s.shortfall),
        std::pair("violation", s.violation), std::pair("speed", m.speed)}) {
    object[key] = ran ? value : std::nan("");
  }
  object["violations"] = m.violations;
  object["held"] = s.held;
  object["missed"] = s.missed;
  object["end"] = ran ? run.samples.back().t : 0;
}

void print_motion_object(const Problem& problem, const SimulateOptions& options,
                         const MotionAnswer& answer) {
  nlohmann::ordered_json object = {{"problem", problem.name},
                                   {"integrator", options.integrator},
                                   {"status", to_string(answer.run.status)},
                                   {"reason", answer.run.reason.str()},
                                   {"unit", problem.unit()},
                                   {"scheme", to_string(problem.motion->scheme)},
                                   {"interpolation", to_string(answer.script.interpolation)},
                                   {"wrench", to_string(answer.script.wrench)},
                                   {"value", answer.trajectory.value},
                                   {"value_between_knots", answer.trajectory.value_between_knots},
                                   {"planned", answer.script.planned},
                                   {"asked", (1 - answer.script.margin) * answer.script.planned},
                                   {"slack", answer.script.slack},
                                   {"t_h", answer.script.t_h}};
  add_measured(answer.run, object);
  if (!options.tank.deaths.empty()) object["dies"] = deaths_object(problem.robot, options.tank);
  if (answer.run.summary.after) object["after"] = after_object(*answer.run.summary.after);
  object["wall_s"] = answer.run.total_s;
  object["version"] = version();
  print_json(object);
}

void print_motion_reading(const MotionAnswer& answer) {
  const TankSummary& s = answer.run.summary;
  const MotionSummary& m = *s.motion;
  if (std::isfinite(answer.script.t_h)) {
    fmt::print("peak        {:.5f} at t_h = {:g} s, highest {:.5f} at {:g} s\n", m.at_peak,
               answer.script.t_h, s.high, m.t_high);
  } else {
    fmt::print("reading     {:.5f}, least {:.5f} at {:g} s, most {:.5f} at {:g} s\n", s.mean, s.low,
               m.t_low, s.high, m.t_high);
  }
  fmt::print("deviation   {:.3g} along c, {:.2g} N and {:.2g} N m across\n", m.deviation,
             m.off_axis_force, m.off_axis_torque);
  fmt::print("error       {:.2g} rad of theta_r, {:.2g} of all joints and the base\n",
             s.theta_r_error, s.configuration_error);
  fmt::print("deflection  {:.2g} m or rad from the expected pose of the end effector\n",
             s.deflection_error);
  fmt::print(
      "efforts     saturated {:.0f} %, request relaxed {:.0f} % of the time, shortfall {:.2g}\n",
      100 * s.saturated, 100 * s.relaxed, s.shortfall);
  fmt::print("limits      exceeded by {:.2g}, those of joint speeds by {:.2g}; {} of {} samples\n",
             s.violation, m.speed, m.violations, answer.run.samples.size());
}

void print_motion_text(const Problem& problem, const SimulateOptions& options,
                       const MotionAnswer& answer) {
  const TankRun& run = answer.run;
  fmt::print("{}  virtual tank  integrator {}  scheme {}  interpolation {}\n", problem.name,
             options.integrator, to_string(problem.motion->scheme),
             to_string(answer.script.interpolation));
  if (std::isfinite(answer.trajectory.value)) {
    fmt::print("trajectory  value {:.5f}, between knots {}\n", answer.trajectory.value,
               std::isfinite(answer.trajectory.value_between_knots)
                   ? fmt::format("{:.5f} {}", answer.trajectory.value_between_knots, problem.unit())
                   : "none: " + answer.trajectory.between_knots_reason.str());
  }
  if (std::isfinite(answer.script.planned)) {
    fmt::print("planned     {:.5f} {}\n", answer.script.planned, problem.unit());
  }
  print_deaths(problem.robot, options.tank);
  if (!run.samples.empty()) print_motion_reading(answer);
  if (run.summary.after) print_after(*run.summary.after);
  print_end(run);
}

}  // namespace

int simulate_motion(const Problem& problem, const SimulateOptions& options) {
  require_motion_options(problem, options);
  if (!problem.scenarios.empty()) return simulate_motion_list(problem, options);
  const MotionAnswer answer = answer_of(problem, options);
  if (!options.out.empty() && answer.script.status == Status::kOptimal) {
    write_file(options.out, tank_csv(problem, answer.run));
  }
  (options.json ? print_motion_object : print_motion_text)(problem, options, answer);
  // Comes last: it rejects an experiment without samples, but the answer is valid even then.
  if (!options.figure.empty() && answer.script.status == Status::kOptimal) {
    write_file(options.figure, motion_figure(problem, {{problem.name, &answer.run}}));
  }
  return answer.run.status == Status::kReached ? kAnswered : kOtherStatus;
}

}  // namespace maxwrench
