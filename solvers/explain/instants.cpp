#include <algorithm>
#include <cmath>

#include "lib/robot/chain.h"
#include "solvers/explain/parts.h"
#include "solvers/solve/active_limits.h"
#include "solvers/solve/format.h"

namespace maxwrench {
namespace {

/// A multiplier below this share of the largest of all instants is rounding.
constexpr double kLeastPrice = 1e-6;

/// The limit of effort j at block i that a price belongs to. At rest before the first block, the
/// limit of the rate may be tighter than that of the effort.
LimitRate limit_at(const Answer& answer, Eigen::Index j, Eigen::Index i, double price) {
  const Robot& robot = answer.task->robot;
  const TrajectoryProgram& program = answer.program;
  const auto actuator = static_cast<int>(j), block = static_cast<int>(i);
  const Zonotope& set = *program.instants[static_cast<std::size_t>(i)].actuation;
  const bool upper = price > 0;
  const double own = upper ? set.u_max[j] : set.u_min[j];
  const double first = upper ? program.u_max(actuator, block) : program.u_min(actuator, block);
  const bool starts = block % program.length() == 0 && first != own;
  return {(starts ? "change from rest of " : "") + actuator_name(robot, j), actuator_unit(robot, j),
          upper ? LimitSide::kUpper : LimitSide::kLower, starts ? first : own, price};
}

}  // namespace

void explain_instants(const Answer& answer, Explanation& explanation) {
  const Robot& robot = answer.task->robot;
  const TrajectorySolution& solution = answer.trajectory.solution;
  const Eigen::Index blocks = solution.lambda.cols();
  Eigen::MatrixXd prices(robot.actuators(), blocks);
  for (Eigen::Index i = 0; i < blocks; ++i)
    prices.col(i) = effort_prices(robot, answer.program, solution, i);
  double most = prices.cwiseAbs().maxCoeff();
  if (solution.kappa.size() > 0) most = std::max(most, solution.kappa.cwiseAbs().maxCoeff());
  const double least = kLeastPrice * most;
  for (Eigen::Index i = 0; i < blocks; ++i) {
    InstantLimits at{instant_of_block(answer, i).t, {}, scenario_of_block(answer, i)};
    const auto add = [&](const LimitRate& limit) {
      if (std::abs(limit.rate) > least && std::isfinite(limit.limit)) at.limits.push_back(limit);
    };
    for (Eigen::Index j = 0; i > 0 && j < solution.kappa.rows(); ++j) {
      const double kappa = solution.kappa(j, i - 1);
      const bool upper = kappa > 0;
      const auto actuator = static_cast<int>(j), block = static_cast<int>(i);
      add({"command of " + actuator_name(robot, j), actuator_unit(robot, j),
           upper ? LimitSide::kUpper : LimitSide::kLower,
           upper ? answer.program.u_max(actuator, block) : answer.program.u_min(actuator, block),
           kappa});
    }
    for (Eigen::Index j = 0; j < prices.rows(); ++j) {
      add(limit_at(answer, j, i, prices(j, i)));
      if (i == solution.mu.cols()) continue;
      add({"change to the next instant of " + actuator_name(robot, j), actuator_unit(robot, j),
           LimitSide::kUpper, answer.program.du_max(j, i), std::abs(solution.mu(j, i))});
    }
    std::stable_sort(at.limits.begin(), at.limits.end(), [](const auto& a, const auto& b) {
      return std::abs(a.rate * a.limit) > std::abs(b.rate * b.limit);
    });
    if (!at.limits.empty()) explanation.instants.push_back(std::move(at));
  }
}

}  // namespace maxwrench
