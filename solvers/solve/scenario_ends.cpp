#include <cmath>
#include <optional>
#include <stdexcept>

#include "lib/scenario/ball_across.h"
#include "lib/scenario/scenario_facets.h"
#include "lib/scenario/scenario_list.h"
#include "lib/scenario/scenario_program.h"
#include "maxwrench/problem.h"
#include "maxwrench/sensitivity.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"
#include "maxwrench/wrench_solver.h"

namespace maxwrench {
namespace {

/// The ends of one scenario after the other, by facets where they serve, else by two programs.
class Ends {
 public:
  Ends(const Problem& problem, Wrench wrench, const Posture& posture)
      : list_(problem.scenarios),
        one_(problem),
        at_(one_),
        program_(problem, wrench),
        solver_(find_wrench_solver("condensed").make()),
        facets_((wrench == Wrench::kPure || list_.F.cols() == 0) &&
                ScenarioFacets::supports(problem)) {
    at_.set(posture);
    if (list_.ball && !facets_) ball_.emplace(problem, wrench);
  }

  ScenarioEnds of(const ScenarioChoice& choice) {
    const bool in_ball = ball_ && !list_.wrenches[static_cast<std::size_t>(choice.wrench)].hold;
    ScenarioEnds ends = facets_   ? by_facets(choice)
                        : in_ball ? by_edges(choice)
                                  : by_programs(choice);
    ends.name = describe(list_, choice);
    return ends;
  }

 private:
  /// The list of this scenario alone.
  ScenarioEnds by_facets(const ScenarioChoice& choice) {
    ScenarioList& alone = one_.scenarios;
    alone.wrenches.assign(1, list_.wrenches[static_cast<std::size_t>(choice.wrench)]);
    const ScenarioLimits& limits = list_.limits[static_cast<std::size_t>(choice.limits)];
    if (choice.limits != limits_) alone.limits.assign(1, limits);
    limits_ = choice.limits;
    for (std::size_t group = 0; group < choice.cases.size(); ++group) {
      alone.loads[group].assign(1,
                                list_.loads[group][static_cast<std::size_t>(choice.cases[group])]);
    }
    ScenarioFacets facets(one_);
    facets.scan(at_);
    return {"", facets.low, facets.high,
            !facets.missed && facets.low <= facets.high + 1e-9 * (1 + std::abs(facets.high))};
  }

  ScenarioEnds by_edges(ScenarioChoice choice) {
    const Status status = ball_->find(at_, choice, kInfinity, *solver_);
    ScenarioEnds ends{"", 0, kInfinity, status == Status::kUnbounded};
    if (status != Status::kOptimal) return ends;
    ends.high = ball_->high;
    ends.held = ends.high >= -kEndTolerance * (1 + std::abs(ends.high));
    return ends;
  }

  ScenarioEnds by_programs(const ScenarioChoice& choice) {
    ScenarioChoice with_wrench = choice;
    with_wrench.c = at_.wrench(choice.wrench);
    program_.write(at_, with_wrench);
    ScenarioEnds ends;
    ends.high = end(1);
    ends.low = end(-1);
    ends.held = result_.status == Status::kOptimal || result_.status == Status::kUnbounded;
    if (list_.non_negative) ends.low = std::max(ends.low, 0.0);
    return ends;
  }

  double end(double sign) {
    solver_->solve(program_.aim(sign), false, result_);
    return sign * (result_.status == Status::kOptimal ? result_.beta : kInfinity);
  }

  const ScenarioList& list_;
  Problem one_;
  ScenarioPosture at_;
  ScenarioProgram program_;
  std::unique_ptr<WrenchSolver> solver_;
  bool facets_;
  std::optional<BallAcross> ball_;
  int limits_ = -1;
  Capability result_;
};

/// The value of each scenario of a task in time alone, at the same knots.
std::vector<ScenarioEnds> ends_in_time(const Answer& answer) {
  if (answer.trajectory.status == Status::kInvalidPosture || answer.trajectory.knots.size() == 0) {
    throw std::invalid_argument("scenarios: got an invalid trajectory, expected a valid one");
  }
  const ScenarioList& list = answer.task->scenarios;
  const auto make = find_trajectory_solver(answer.choice.solver).make;
  std::vector<ScenarioEnds> all;
  Problem one = *answer.task;
  for (const ScenarioChoice& choice : all_scenarios(list)) {
    if (list.wrenches[static_cast<std::size_t>(choice.wrench)].hold && answer.has_value()) {
      all.push_back({describe(list, choice), -kInfinity, kInfinity, true});
      continue;
    }
    one.scenarios.wrenches = {list.wrenches[static_cast<std::size_t>(choice.wrench)]};
    one.scenarios.limits = {list.limits[static_cast<std::size_t>(choice.limits)]};
    TrajectoryEvaluator evaluator(one, answer.choice.wrench, make, false);
    const Trajectory& alone = evaluator.evaluate(answer.trajectory.knots);
    ScenarioEnds ends{describe(list, choice), -kInfinity, kInfinity, true};
    if (alone.status == Status::kOptimal) ends.high = alone.value;
    ends.held = alone.status == Status::kOptimal || alone.status == Status::kUnbounded;
    if (answer.task->motion->payload) ends.low = 0;
    all.push_back(ends);
  }
  return all;
}

}  // namespace

std::vector<ScenarioEnds> scenario_ends(const Answer& answer) {
  if (!answer.task || answer.task->scenarios.empty()) {
    throw std::invalid_argument("scenarios: got a task without a list, expected one with " +
                                std::string("wrench.set, uncertainty, loss or payload"));
  }
  if (answer.task->motion) return ends_in_time(answer);
  if (answer.posture.status != Status::kValid) {
    throw std::invalid_argument("scenarios: got an invalid posture, expected a valid one");
  }
  const ScenarioList& list = answer.task->scenarios;
  std::vector<ScenarioEnds> all;
  Ends ends(*answer.task, answer.choice.wrench, answer.posture);
  for (const ScenarioChoice& each : all_scenarios(list)) all.push_back(ends.of(each));
  return all;
}

}  // namespace maxwrench
