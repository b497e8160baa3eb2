#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "lib/robot/chain.h"
#include "maxwrench/sensitivity.h"
#include "maxwrench/solve.h"
#include "solvers/solve/active_limits.h"
#include "solvers/solve/format.h"
#include "solvers/solve/near_singular.h"

namespace maxwrench {
namespace {

constexpr int kMostLines = 21;  ///< of the table of instants

template <class... Values>
void add(std::string& text, fmt::format_string<Values...> format, Values&&... values) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Values>(values)...);
}

/// Whether a gear exerts this effort of u. Its bounds in the program only stand for "without
/// limit".
bool is_gear(const Robot& robot, Eigen::Index actuator) {
  const Eigen::Index joint = actuator - static_cast<Eigen::Index>(robot.thrusters.size());
  return joint >= 0 && robot.joints[static_cast<std::size_t>(joint)].gear.has_value();
}

/// The case in one line.
std::string headline(const Answer& answer) {
  const Case& c = answer.choice;
  const std::string& limits = answer.task->robot.limits;
  return fmt::format("{}  measure {}  wrench {}  solver {}{}", c.problem, c.measure,
                     to_string(c.wrench), c.solver, limits.empty() ? "" : "  limits " + limits);
}

/// Adds some of the instants at knots.
void add_instants(const Answer& answer, std::string& text) {
  const Problem& problem = *answer.task;
  const auto& instants = answer.trajectory.instants;
  const auto count = static_cast<int>(instants.size());
  const int per_knot = instants_per_interval(*problem.motion);
  const int step = per_knot * ((count - 1) / per_knot / kMostLines + 1);
  add(text, "    t [s]  {:>9}  {:<{}}  nearest limit of an effort\n", "beta", " theta_r",
      10 * problem.redundancy());
  for (int i = 0; i < count; i += step) {
    const Instant& instant = instants[static_cast<std::size_t>(i)];
    const std::string beta = answer.has_value() ? decimals(instant.beta()) : "-";
    add(text, "{:>9.4f}  {:>9}  {}  {}\n", instant.t, beta, line(instant.q(problem.redundant)),
        answer.has_value() ? nearest_limit(problem.robot, reported_limits(answer), instant.u) : "");
  }
}

void add_value(const Answer& answer, std::string& text) {
  const Trajectory& trajectory = answer.trajectory;
  add(text, "value    {:>10} {}\n", decimals(trajectory.value), answer.unit);
  if (trajectory.between_knots_reason.empty()) {
    add(text, "value_between_knots {} {}\n", decimals(trajectory.value_between_knots), answer.unit);
  } else {
    add(text, "value_between_knots none: {}\n", trajectory.between_knots_reason.c_str());
  }
  if (!answer.task->scenarios.empty() && trajectory.decides_at >= 0) {
    add(text, "decides  {} at {:.4f} s\n", describe(answer.task->scenarios, trajectory.decides),
        trajectory.instants[static_cast<std::size_t>(trajectory.decides_at)].t);
  }
  if (!std::isnan(trajectory.overshoot)) {
    add(text, "overshoot {:>9.5f} of the limits of efforts between instants\n",
        std::max(0.0, trajectory.overshoot));
  }
  if (!std::isnan(trajectory.speed_overshoot)) {
    add(text,
        "overshoot {:>9.5f} of the limits of speeds, {:.5f} rad or m beyond those of joints\n",
        std::max(0.0, trajectory.speed_overshoot), std::max(0.0, trajectory.limit_overshoot));
  }
  if (!trajectory.collision.empty()) add(text, "collides: {}\n", trajectory.collision.c_str());
}

std::string trajectory_summary(const Answer& answer) {
  const Problem& problem = *answer.task;
  std::string text;
  const MotionTask& task = *problem.motion;
  const Trajectory& trajectory = answer.trajectory;
  add(text, "{}\n", headline(answer));
  add(text, "{} of {:g} s, {} knots, scheme {}", problem.type(), task.T, task.k,
      to_string(task.scheme));
  if (answer.has_posture()) add(text, ", {} instants", trajectory.instants.size());
  if (!task.impulse && task.scheme == Scheme::kForward && task.k > 1) {
    add(text, " T/k apart at poses T/(k-1) apart");
  }
  if (task.impulse && trajectory.t_h > 0) add(text, ", peak at knot {}", trajectory.t_h);
  add(text, "\n{}{}{}\n", to_string(answer.status), answer.reason.empty() ? "" : ": ",
      answer.reason.c_str());
  if (!answer.stopped.empty()) add(text, "stopped   {}\n", answer.stopped);
  if (answer.has_value()) {
    add_value(answer, text);
    for (const std::string& limit : binding_limits(answer)) add(text, "{}\n", limit);
  }
  if (answer.clearance) {
    add(text, "clearance {:>9.5f} m at {:.4f} s: {}\n", answer.clearance->least,
        answer.clearance->t, answer.clearance->pair);
  }
  if (answer.has_posture()) add_instants(answer, text);
  if (answer.has_value()) add(text, "residual {}; ", line(trajectory.solution.residual));
  add(text, "{}\n", line(answer.evaluations, answer.wall_s));
  return text;
}

void add_dependent(const Answer& answer, const std::vector<int>& joints, std::string& text) {
  for (const int i : joints) {
    add(text, "dependent{:>10}  {}\n", decimals(answer.posture.q[i]),
        answer.task->robot.joints[i].name);
  }
}

/// The direction of the critical wrench of a ball, in world axes.
std::string words_of_direction(const WrenchBall& ball, const Vector6d& c) {
  constexpr double kShownPart = 1e-6;  // of the length
  const bool force = !ball.E.topRows<3>().isZero(0);
  const Eigen::Vector3d part = force ? c.head<3>() : c.tail<3>();
  std::vector<double> direction;
  for (const double x : part.stableNormalized()) {
    direction.push_back(std::abs(x) < kShownPart ? 0 : x);
  }
  return fmt::format("{} along [{:.5g}]", force ? "force" : "torque", fmt::join(direction, ", "));
}

/// What tells the scenario that decides from the others; empty: there are no others.
std::string words_of_decider(const ScenarioList& list, const ScenarioChoice& decides) {
  if (list.empty()) return "";
  std::string words = list.count() > 1 ? describe(list, decides) : "";
  if (!list.ball || list.wrenches[static_cast<std::size_t>(decides.wrench)].hold) return words;
  const std::string direction = words_of_direction(*list.ball, decides.c);
  return words.empty() ? direction : direction + "; " + words;
}

/// Adds the value with the wrench, efforts, gradient and residual.
void add_capability(const Answer& answer, std::string& text) {
  const Problem& problem = *answer.task;
  const Capability& capability = answer.capability;
  add(text, "beta     {:>10} {}\n", decimals(capability.beta), answer.unit);
  const ScenarioList& list = problem.scenarios;
  if (const std::string words = words_of_decider(list, capability.decides); !words.empty()) {
    add(text, "decides  {}\n", words);
  }
  add(text, "beta_linf{:>10} {}\n", decimals(answer.beta_linf), problem.unit());
  if (const std::optional<JointOff> off = find_joint_off(answer)) {
    add(text, "near singular along c: {} {} if {} is off by {} rad\n", decimals(off->beta),
        answer.unit, off->joint, off->by);
  }
  if (capability.w.size() > 0) add(text, "h        {}\n", line(capability.h));
  if (problem.contact) add(text, "h_2      {}\n", line(capability.h_2));
  const Zonotope& limits =
      list.empty() ? problem.robot.actuation
                   : list.limits[static_cast<std::size_t>(capability.decides.limits)].actuation;
  for (Eigen::Index i = 0; i < capability.u.size(); ++i) {
    add(text, "u {:>17}  of {}  {}\n", decimals(capability.u[i]),
        is_gear(problem.robot, i) ? "a gear, without limit"
                                  : fmt::format("{:g} .. {:g}", limits.u_min[i], limits.u_max[i]),
        actuator_name(problem.robot, i));
  }
  if (answer.trajectory.gradient.size() > 0) {
    add(text, "gradient {}\n", line(answer.trajectory.gradient.transpose()));
  }
  if (answer.undecided > 0) {
    add(text, "undecided {} (evaluations without a verdict)\n", answer.undecided);
  }
  add(text, "residual {}; {}\n", line(capability.residual),
      line(answer.evaluations, answer.wall_s));
}

std::string posture_summary(const Answer& answer) {
  const Problem& problem = *answer.task;
  std::string text;
  const Case& c = answer.choice;
  add(text, "{}\n", headline(answer));
  if (answer.has_posture()) {
    if (problem.redundancy() > 0) add(text, "theta_r  {}\n", line(answer.posture.theta_r));
    add(text, "base xyz {}\nbase rpy {}\n", line(answer.posture.base.p),
        line(rpy(answer.posture.base.R)));
    add_dependent(answer, problem.dependent, text);
    if (finds_pose(answer)) {
      const Pose<double> pose = pose_at(problem, answer.posture.theta_r);
      add(text, "tool xyz {}\ntool rpy {}\n", line(pose.p), line(rpy(pose.R)));
    }
  }
  if (problem.contact && answer.has_posture()) {
    add_dependent(answer, problem.contact->follow, text);
  }
  if (answer.ik_solutions.found + answer.ik_solutions.unreachable > 0) {
    add(text, "{}\n", describe(answer.ik_solutions));
  }
  if (!answer.has_value()) {
    add(text, "{}: {}\n", to_string(answer.status), answer.reason.c_str());
    return text;
  }
  if (!answer.answered()) {
    add(text, "{}: {}, the best so far\n", to_string(answer.status), answer.reason.c_str());
  }
  if (answer.status == Status::kBestFound) {
    add(text, "{} by {}: {}\n", to_string(answer.status), c.search, answer.stopped);
  }
  add_capability(answer, text);
  return text;
}

}  // namespace

std::string summary(const std::vector<ScenarioEnds>& ends) {
  std::string text = "scenarios    low        high\n";
  const auto end = [](bool held, double value) {
    return held ? decimals(value) : std::string("-");
  };
  for (const ScenarioEnds& each : ends) {
    add(text, "{:>14} {:>10}  {}\n", end(each.held, each.low), end(each.held, each.high),
        each.name);
  }
  return text;
}

std::string summary(const Answer& answer) {
  return answer.task->motion ? trajectory_summary(answer) : posture_summary(answer);
}

}  // namespace maxwrench
