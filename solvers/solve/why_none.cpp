#include "solvers/solve/why_none.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <vector>

#include "lib/math/random.h"
#include "maxwrench/measure.h"
#include "maxwrench/posture.h"
#include "maxwrench/trajectory.h"
#include "maxwrench/wrench_program.h"
#include "solvers/solve/method.h"

namespace maxwrench {
namespace {

constexpr int kPostures = 100;

/// A verdict with its number.
struct Count {
  Status status = Status::kInvalidPosture;
  int postures = 0;
  Eigen::VectorXd theta_r;  ///< of the first of them
};
using Counts = std::map<std::string, Count>;

void count(const Verdict& verdict, const Eigen::VectorXd& theta_r, Counts& counts) {
  if (verdict.status == Status::kOptimal) return;
  Count& entry = counts[verdict.reason.empty() ? to_string(verdict.status) : verdict.reason.str()];
  if (entry.postures++ > 0) return;
  entry.status = verdict.status;
  entry.theta_r = theta_r;
}

Counts count_postures(const Problem& task, const Method& method) {
  PostureEvaluator model(task);
  WrenchProgram program = make_wrench_program(task, method.choice.wrench);
  const auto measure = method.make_measure();
  Capability capability;
  Counts counts;
  Random random(method.choice.seed);
  Eigen::VectorXd theta_r = task.theta_r_default;
  for (int k = 0; k <= kPostures; ++k) {
    const Posture& posture = evaluate_best(model, theta_r, *measure, false, program, capability);
    count(verdict_of(task, posture, capability), theta_r, counts);
    for (Eigen::Index i = 0; i < theta_r.size(); ++i) {
      theta_r[i] = random.uniform(task.theta_r_min[i], task.theta_r_max[i]);
    }
    if (theta_r.size() == 0) break;  // there is one posture only
  }
  return counts;
}

/// Of a task in time: the default throughout. A transfer has its own ends.
Counts count_default(const Problem& task, const Method& method) {
  Counts counts;
  if (task.motion->transfer) return counts;
  Options how;
  static_cast<Case&>(how) = method.choice;
  how.search.clear();
  count(evaluate(task, task.theta_r_default, how), task.theta_r_default, counts);
  return counts;
}

/// The joints that nothing drives; empty if there are none.
std::string undriven_joints(const Robot& robot) {
  constexpr std::size_t kMost = 3;
  std::vector<std::string> names;
  for (const Joint& joint : robot.joints) {
    if (!joint.gear && joint.effort_max == 0) names.push_back(joint.name);
  }
  if (names.empty()) return "";
  const std::size_t more = names.size() > kMost ? names.size() - kMost : 0;
  names.resize(names.size() - more);
  return fmt::format("; without effort: {}{}", fmt::join(names, ", "),
                     more > 0 ? fmt::format(" and {} more", more) : "");
}

/// The most frequent reason. A measure that is no program says more where there is a posture than
/// that there is none elsewhere.
Counts::const_iterator most_telling(const Counts& counts, bool of_program) {
  return std::max_element(counts.begin(), counts.end(), [&](const auto& a, const auto& b) {
    const auto rank = [&](const Count& count) {
      return std::pair(!of_program && count.status != Status::kInvalidPosture, count.postures);
    };
    return rank(a.second) < rank(b.second);
  });
}

}  // namespace

std::string why_none(const Problem& task, const Method& method) {
  const Counts counts = task.motion ? count_default(task, method) : count_postures(task, method);
  const bool of_program = task.motion || method.make_measure()->solves_program();
  const auto most = most_telling(counts, of_program);
  if (most == counts.end()) return "";
  const auto& [reason, found] = *most;
  if (of_program) {
    return reason + (found.status == Status::kInfeasible ? undriven_joints(task.robot) : "");
  }
  if (found.status == Status::kInvalidPosture || found.theta_r.size() == 0) return reason;
  return fmt::format("{} at theta_r = {:.4g}", reason, fmt::join(found.theta_r, " "));
}

}  // namespace maxwrench
