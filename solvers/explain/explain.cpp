#include "maxwrench/explain.h"

#include <fmt/format.h>

#include <stdexcept>

#include "lib/robot/kinematics.h"
#include "lib/scenario/scenario_program.h"
#include "solvers/explain/parts.h"

namespace maxwrench {
namespace {

/// lambda'g, where g are weight, buoyancy and trim of a robot in a posture.
double worth_of_loads(const Robot& robot, const Posture& posture, const Eigen::VectorXd& lambda) {
  Kinematics<double> kinematics(robot);
  kinematics.set_joints(posture.q);
  Eigen::VectorXd loads(robot.velocities());
  kinematics.gravity_and_buoyancy(posture.base.R, loads);
  return lambda.dot(loads);
}

/// Why an answer has nothing to explain; empty: it has.
std::string without_value(const Answer& answer) {
  if (answer.status == Status::kReached) return "an experiment has no multipliers";
  if (answer.has_value()) return "";
  return fmt::format("there is no value: {}{}{}", to_string(answer.status),
                     answer.reason.empty() ? "" : ": ", answer.reason.c_str());
}

void explain_static(const Answer& answer, const WrenchProgram& program, Explanation& explanation) {
  explain_limits(answer, program, explanation);
  if (!explanation.missing.empty()) explanation.ranges_missing = explanation.missing;
  explain_best_posture(answer, explanation.best);
  explain_efforts(answer, program, explanation.efforts);
}

}  // namespace

const char* to_string(LimitSide side) {
  switch (side) {
    case LimitSide::kLower:
      return "min";
    case LimitSide::kUpper:
      return "max";
    case LimitSide::kSmaller:
      break;
  }
  return "smaller";
}

std::string contact_force_name(Eigen::Index i) { return fmt::format("contact force {}", i + 1); }

const char* contact_force_unit(const Problem& task, Eigen::Index i) {
  return task.contact->C.col(i).head<3>().norm() > 0 ? "N" : "N m";
}

void split_loads(const Answer& answer, const Eigen::VectorXd& lambda, ValueBudget& budget) {
  const Posture& posture = answer.posture;
  Robot robot = answer.task->robot;
  const double all = worth_of_loads(robot, posture, lambda);
  robot.trim.buoyancy_mass = 0;
  const double untrimmed = worth_of_loads(robot, posture, lambda);
  robot.water_density = 0;
  budget.weight = worth_of_loads(robot, posture, lambda);
  budget.buoyancy = untrimmed - budget.weight;
  budget.trim = all - untrimmed;
  budget.other = lambda.dot(posture.tau_d) - all;
}

Explanation explain(const Answer& answer, const ExplainOptions& options) {
  if (!answer.task) throw std::invalid_argument("answer: got none, expected one with a task");
  if (!(options.share >= 0 && options.share <= 1)) {
    throw std::invalid_argument(
        fmt::format("share: got {}, expected a number from 0 to 1", options.share));
  }
  Explanation explanation;
  explanation.unit = answer.unit;
  explanation.efforts.share = options.share;
  explanation.missing = without_value(answer);
  if (explanation.missing.empty()) explanation.beta = answer.beta();
  const bool in_time = answer.task->motion.has_value();
  if (!explanation.missing.empty() || in_time) {
    const std::string why = in_time ? "the task is in time" : explanation.missing;
    explanation.ranges_missing = explanation.best.missing = explanation.efforts.missing = why;
    if (explanation.missing.empty()) explain_instants(answer, explanation);
    return explanation;
  }
  const Problem& task = *answer.task;
  if (!task.scenarios.empty()) {
    ScenarioPosture at(task);
    at.set(answer.posture);
    ScenarioProgram scenario(task, answer.choice.wrench);
    explanation.scenario = describe(task.scenarios, answer.capability.decides);
    explain_static(answer, scenario.write(at, answer.capability.decides), explanation);
    return explanation;
  }
  WrenchProgram program = make_wrench_program(task, answer.choice.wrench);
  set_posture(answer.posture, program);
  explain_static(answer, program, explanation);
  return explanation;
}

}  // namespace maxwrench
