#include "lib/trajectory/motion_scenarios.h"

#include "lib/scenario/scenario_list.h"

namespace maxwrench {

std::vector<MotionScenario> motion_scenarios(const Problem& problem, Wrench wrench) {
  std::vector<MotionScenario> scenarios;
  const ScenarioList& list = problem.scenarios;
  if (list.empty()) {
    MotionScenario only;
    only.choice.c = problem.c;
    only.actuation = &problem.robot.actuation;
    only.W = wrench == Wrench::kPure ? Matrix6Xd(problem.c) : problem.W_any;
    only.c_w = only.W.transpose() * problem.c;
    scenarios.push_back(std::move(only));
    return scenarios;
  }
  for (const ScenarioChoice& choice : all_scenarios(list)) {
    const ScenarioWrench& stated = list.wrenches[static_cast<std::size_t>(choice.wrench)];
    MotionScenario each;
    each.choice = choice;
    each.choice.c = stated.c;
    each.actuation = &list.limits[static_cast<std::size_t>(choice.limits)].actuation;
    const Eigen::Index own = stated.hold ? 0 : 1;
    const Eigen::Index free = wrench == Wrench::kAny ? list.F.cols() : 0;
    each.W.resize(6, own + free);
    if (own > 0) each.W.col(0) = stated.c;
    each.W.rightCols(free) = list.F.leftCols(free);
    each.c_w.setZero(own + free);
    each.c_w.head(own).setOnes();
    scenarios.push_back(std::move(each));
  }
  return scenarios;
}

void set_peak(const std::vector<MotionScenario>& scenarios, int peak, TrajectoryProgram& program) {
  if (program.scenarios == 1) {
    program.peak = peak;
    return;
  }
  for (int i = 0; i < program.size(); ++i) {
    WrenchProgram& at = program.instants[static_cast<std::size_t>(i)];
    const Eigen::VectorXd& c_w = scenarios[static_cast<std::size_t>(i / program.length())].c_w;
    if (i % program.length() == peak && at.c_w.size() == c_w.size()) {
      at.c_w = c_w;
    } else {
      at.c_w.setZero();
    }
  }
}

DecidingBlock deciding_block(const TrajectoryProgram& program, const Eigen::VectorXd& of) {
  DecidingBlock decides;
  if (of.size() != program.size()) return decides;
  double most = 0;
  for (int s = 0; s < program.scenarios; ++s) {
    const double sum = of.segment(s * program.length(), program.length()).sum();
    if (s > 0 && !(sum > most)) continue;
    most = sum;
    decides.scenario = s;
  }
  of.segment(decides.scenario * program.length(), program.length()).maxCoeff(&decides.block);
  return decides;
}

std::string infeasible_scenario(const Problem& problem,
                                const std::vector<MotionScenario>& scenarios,
                                const TrajectoryProgram& program,
                                const TrajectorySolution& solution) {
  const Eigen::MatrixXd& lambda = solution.lambda;
  if (problem.scenarios.empty() || lambda.cols() != program.size() || !lambda.allFinite())
    return "";
  const Eigen::VectorXd sizes = lambda.colwise().lpNorm<1>();
  const auto s = static_cast<std::size_t>(deciding_block(program, sizes).scenario);
  return describe(problem.scenarios, scenarios[s].choice);
}

}  // namespace maxwrench
