#include "maxwrench/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "drawing/postures.h"
#include "drawing/svg.h"
#include "lib/scenario/scenario_list.h"
#include "maxwrench/measure.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"
#include "maxwrench/wrench_program.h"
#include "maxwrench/wrench_solver.h"

namespace maxwrench {
namespace {

/// The view from above, unless c points up or down.
View view_of(const Problem& problem) {
  return std::abs(problem.c[2]) < 1e-9 ? View::kTop : View::kSide;
}

/// The set of one measure. It has no value and no outline if the robot's actuators do not allow
/// this measure (B rank deficient, a one-sided limit).
ForceSet set_of(const Problem& problem, const Posture& posture, const MeasureEntry& entry,
                Wrench wrench, const char* name) {
  std::unique_ptr<Measure> measure;
  try {
    measure = entry.make(problem, find_wrench_solver("simplex").make());
  } catch (const std::invalid_argument&) {
    ForceSet none;
    none.name = name;
    none.beta = std::numeric_limits<double>::quiet_NaN();
    none.wrench = wrench;
    return none;
  }
  return force_set(problem, posture, *measure, wrench, view_of(problem), !entry.needs_solver, name);
}

DrawnPosture draw_robot(const Problem& problem, PostureEvaluator& model, const Panel& panel) {
  DrawnPosture drawn;
  drawn.title = with_letters(panel.title);
  drawn.problem = &problem;
  // If a second arm has several IK solutions, the best one is drawn.
  WrenchProgram program = make_wrench_program(problem, Wrench::kPure);
  const auto measure = make_linf_polytope(problem.robot, find_wrench_solver("condensed").make());
  Capability capability;
  drawn.posture = evaluate_best(model, panel.theta_r, *measure, false, program, capability);
  if (drawn.posture.status == Status::kInvalidPosture) {
    throw std::invalid_argument(
        "figure: got a theta_r of " + problem.name + " without a posture (" +
        describe_violation(problem, drawn.posture) + "), expected one that exists");
  }
  return drawn;
}

DrawnPosture draw(const Problem& problem, PostureEvaluator& model, const Panel& panel) {
  DrawnPosture drawn = draw_robot(problem, model, panel);
  const auto add = [&](const char* measure, Wrench wrench, const char* name) {
    drawn.sets.push_back(set_of(problem, drawn.posture, find_measure(measure), wrench, name));
  };
  add("ellipsoid", Wrench::kPure, "ellipsoid (\u03b2_1)");
  add("l2_polytope", Wrench::kPure, "L_2 polytope");
  add("linf_polytope", Wrench::kPure, "L_\u221e polytope (\u03b2_2)");
  add("linf_polytope", Wrench::kAny, "L_\u221e polytope, any wrench (\u03b2_3)");
  return drawn;
}

/// The static task of an instant.
Problem at_instant(const Problem& problem, const Instant& instant) {
  Problem still = problem;
  still.motion.reset();
  still.pose = instant.end_effector;
  still.c = std::isnan(instant.factor) ? instant.c : instant.c.stableNormalized();
  return still;
}

/// The angle for a path that turns, else the time.
std::string title_of(const Problem& problem, const Trajectory& trajectory, const Instant& instant) {
  const double angle = problem.motion->path.angle();
  // A pose does not show a rotation by more than half a turn.
  if (angle == 0 || std::abs(angle) > std::numbers::pi * (1 + 1e-12))
    return fmt::format("{:.4g} s", instant.t);
  const Eigen::AngleAxisd turned(trajectory.instants.front().end_effector.R.transpose() *
                                 instant.end_effector.R);
  return fmt::format("{:.3g}\u00b0", turned.angle() * 180 / std::numbers::pi);
}

}  // namespace

std::string figure(const Problem& problem, const std::vector<Panel>& panels) {
  if (problem.free.wrench_turns || !in_view(problem.c, view_of(problem)))
    return posture_figure(problem, panels);
  PostureEvaluator model(problem);
  std::vector<DrawnPosture> drawn;
  for (const Panel& panel : panels) drawn.push_back(draw(problem, model, panel));
  return draw_postures(drawn, view_of(problem));
}

std::string posture_figure(const Problem& problem, const std::vector<Panel>& panels) {
  require_no_scenarios(problem, "plot");
  PostureEvaluator model(problem);
  std::vector<DrawnPosture> drawn;
  for (const Panel& panel : panels) drawn.push_back(draw_robot(problem, model, panel));
  return draw_both_views(drawn);
}

std::string trajectory_figure(const Problem& problem, const Trajectory& trajectory,
                              const std::vector<double>& times) {
  std::deque<Problem> problems;  // a deque keeps the addresses of its elements
  std::vector<DrawnPosture> drawn;
  for (const double time : times) {
    const auto& instant = *std::min_element(trajectory.instants.begin(), trajectory.instants.end(),
                                            [time](const Instant& a, const Instant& b) {
                                              return std::abs(a.t - time) < std::abs(b.t - time);
                                            });
    const Problem& still = problems.emplace_back(at_instant(problem, instant));
    PostureEvaluator model(still, false);
    drawn.push_back(draw_robot(
        still, model, {title_of(problem, trajectory, instant), theta_r_at(problem, instant)}));
  }
  return draw_both_views(drawn);
}

}  // namespace maxwrench
