#include "solvers/solve/active_limits.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "lib/robot/chain.h"
#include "lib/scenario/scenario_list.h"
#include "maxwrench/solve.h"
#include "solvers/solve/format.h"

namespace maxwrench {
namespace {

constexpr double kCounts = 1e-3;  ///< a significant multiplier: share of the largest, or of the sum
constexpr std::size_t kMostLimits = 6, kMostInstants = 6;

struct WorthyLimit {
  double worth;  ///< multiplier times the width of the limits [N or N m]
  std::string text;
};

/// The significant limits, largest effect first.
std::vector<WorthyLimit> dearest_first(std::vector<WorthyLimit> limits) {
  std::stable_sort(limits.begin(), limits.end(),
                   [](const auto& a, const auto& b) { return a.worth > b.worth; });
  std::erase_if(limits, [most = limits.front().worth](const WorthyLimit& limit) {
    return !(limit.worth > kCounts * most);
  });
  return limits;
}

std::vector<WorthyLimit> limits_at(const Answer& answer, Eigen::Index i) {
  const Robot& robot = answer.task->robot;
  const TrajectorySolution& solution = answer.trajectory.solution;
  const Zonotope& set = *answer.program.instants[static_cast<std::size_t>(i)].actuation;
  std::vector<WorthyLimit> limits;
  const Eigen::VectorXd prices = effort_prices(robot, answer.program, solution, i);
  for (Eigen::Index j = 0; j < prices.size(); ++j) {
    const bool upper = prices[j] > 0;
    const double width = set.u_max[j] - set.u_min[j];
    limits.push_back(
        {prices[j] == 0 ? 0 : std::abs(prices[j]) * width,
         fmt::format("{} at {:g}{}", actuator_name(robot, j), upper ? set.u_max[j] : set.u_min[j],
                     robot.limits.empty() ? "" : fmt::format(" ({})", robot.limits))});
  }
  for (const Eigen::Index pair : {i - 1, i}) {
    if (pair < 0 || pair >= solution.mu.cols()) continue;
    for (Eigen::Index j = 0; j < prices.size(); ++j) {
      const double width = 2 * answer.program.du_max(j, pair);
      if (!(width < kInfinity)) continue;
      limits.push_back(
          {std::abs(solution.mu(j, pair)) * width,
           fmt::format("rate of {} {}", actuator_name(robot, j), pair < i ? "before" : "after")});
    }
  }
  for (Eigen::Index j = 0; i > 0 && j < solution.kappa.rows(); ++j) {
    const double kappa = solution.kappa(j, i - 1);
    if (kappa == 0) continue;
    limits.push_back({std::abs(kappa) * (set.u_max[j] - set.u_min[j]),
                      fmt::format("command of {} at {:g}", actuator_name(robot, j),
                                  kappa > 0 ? set.u_max[j] : set.u_min[j])});
  }
  return dearest_first(std::move(limits));
}

std::string describe(const std::vector<WorthyLimit>& limits) {
  std::vector<std::string> texts;
  for (const WorthyLimit& limit : limits) {
    if (texts.size() < kMostLimits) texts.push_back(limit.text);
  }
  const std::size_t more = limits.size() - texts.size();
  return fmt::format("{}{}", fmt::join(texts, ", "),
                     more > 0 ? fmt::format(" and {} more", more) : "");
}

}  // namespace

Eigen::VectorXd effort_prices(const Robot& robot, const TrajectoryProgram& program,
                              const TrajectorySolution& solution, Eigen::Index i) {
  Eigen::VectorXd prices = -robot.actuation.B.transpose() * solution.lambda.col(i);
  if (i > 0) prices -= solution.mu.col(i - 1);
  if (i < solution.mu.cols()) prices += solution.mu.col(i);
  if (program.lag.size() == 0) return prices;
  if (i > 0) {
    prices -= ((1 + program.lag.col(i - 1).array()) * solution.kappa.col(i - 1).array()).matrix();
  }
  if (i < program.lag.cols()) prices += program.lag.col(i).cwiseProduct(solution.kappa.col(i));
  return prices;
}

const Instant& instant_of_block(const Answer& answer, Eigen::Index i) {
  const std::vector<Instant>& instants = answer.trajectory.instants;
  const Eigen::Index length = answer.program.length();
  const Eigen::Index skipped = static_cast<Eigen::Index>(instants.size()) - length;
  return instants[static_cast<std::size_t>(i % length + skipped)];
}

std::string scenario_of_block(const Answer& answer, Eigen::Index i) {
  const ScenarioList& list = answer.task->scenarios;
  if (list.empty()) return "";
  const auto number = static_cast<std::size_t>(i / answer.program.length());
  return describe(list, all_scenarios(list)[number]);
}

std::vector<std::string> binding_limits(const Answer& answer) {
  const Eigen::VectorXd& pi = answer.trajectory.solution.pi;
  std::vector<Eigen::Index> worst;
  for (Eigen::Index i = 0; i < pi.size(); ++i) {
    if (pi[i] > kCounts) worst.push_back(i);
  }
  std::stable_sort(worst.begin(), worst.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return pi[a] > pi[b]; });
  if (worst.size() > kMostInstants) worst.resize(kMostInstants);
  std::sort(worst.begin(), worst.end());
  std::vector<std::string> lines;
  for (const Eigen::Index i : worst) {
    const std::string scenario = scenario_of_block(answer, i);
    lines.push_back(fmt::format("binds at {:.4f} s{}: {}", instant_of_block(answer, i).t,
                                scenario.empty() ? "" : " (" + scenario + ")",
                                describe(limits_at(answer, i))));
  }
  return lines;
}

std::string dearest_efforts(const Answer& answer) {
  const Robot& robot = answer.task->robot;
  const Zonotope& set = robot.actuation;
  std::vector<WorthyLimit> limits;
  for (Eigen::Index j = 0; j < set.u_min.size(); ++j)
    limits.push_back({0, actuator_name(robot, j)});
  for (Eigen::Index i = 0; i < answer.trajectory.solution.lambda.cols(); ++i) {
    const Eigen::VectorXd prices =
        effort_prices(robot, answer.program, answer.trajectory.solution, i);
    for (Eigen::Index j = 0; j < prices.size(); ++j) {
      if (std::abs(prices[j]) < 1e-9) continue;  // it may have no limits
      limits[static_cast<std::size_t>(j)].worth +=
          std::abs(prices[j]) * (set.u_max[j] - set.u_min[j]);
    }
  }
  const Eigen::MatrixXd& kappa = answer.trajectory.solution.kappa;
  for (Eigen::Index j = 0; j < kappa.rows(); ++j) {
    const double price = kappa.row(j).cwiseAbs().sum();
    if (price < 1e-9) continue;
    limits[static_cast<std::size_t>(j)].worth += price * (set.u_max[j] - set.u_min[j]);
  }
  return describe(dearest_first(std::move(limits)));
}

std::string fastest_joint(const Robot& robot, const Trajectory& trajectory) {
  double most = 0;
  const std::string* name = nullptr;
  for (const Instant& instant : trajectory.instants) {
    const auto rates = instant.v.tail(static_cast<Eigen::Index>(robot.joints.size()));
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      const double share =
          std::abs(rates[static_cast<Eigen::Index>(j)]) / robot.joints[j].velocity_max;
      if (!(share > most + 1e-9)) continue;
      most = share;
      name = &robot.joints[j].name;
    }
  }
  return name == nullptr ? "none moves" : fmt::format("{:.0f} % {}", 100 * most, *name);
}

const Zonotope& reported_limits(const Answer& answer) {
  const Problem& task = *answer.task;
  if (task.scenarios.empty()) return task.robot.actuation;
  const auto limits = static_cast<std::size_t>(answer.trajectory.decides.limits);
  return task.scenarios.limits[limits].actuation;
}

std::string nearest_limit(const Robot& robot, const Zonotope& set, const Eigen::VectorXd& u) {
  double most = -1;
  Eigen::Index at = 0;
  for (Eigen::Index j = 0; j < u.size(); ++j) {
    const double limit = u[j] > 0 ? set.u_max[j] : -set.u_min[j];
    const double share = limit > 0 ? std::abs(u[j]) / limit : 0;
    if (share > most + 1e-9) {
      most = share;
      at = j;
    }
  }
  return u.size() == 0 ? "" : fmt::format("{:.0f} % {}", 100 * most, actuator_name(robot, at));
}

}  // namespace maxwrench
