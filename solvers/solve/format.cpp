#include "solvers/solve/format.h"

#include <fmt/format.h>

#include <cmath>

#include "lib/math/random.h"

namespace maxwrench {

using nlohmann::ordered_json;

ordered_json array(const Eigen::VectorXd& v) {
  return std::vector<double>(v.data(), v.data() + v.size());
}

ordered_json rows(const Eigen::MatrixXd& matrix) {
  ordered_json result = ordered_json::array();
  for (const auto row : matrix.rowwise()) result.push_back(array(row.transpose()));
  return result;
}

ordered_json known(bool condition, const ordered_json& value) {
  return condition ? value : ordered_json(nullptr);
}

ordered_json to_json(const Pose<double>& pose) {
  return {{"position", array(pose.p)}, {"rpy", array(rpy(pose.R))}};
}

ordered_json theta(const Robot& robot, const Pose<double>& base, const Eigen::VectorXd& q) {
  ordered_json object = to_json(base);
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    object[robot.joints[i].name] = q[static_cast<Eigen::Index>(i)];
  }
  return object;
}

ordered_json to_json(const Residual& residual) {
  return {{"balance", residual.balance},
          {"bounds", residual.bounds},
          {"dual", residual.dual},
          {"gap", residual.gap}};
}

Eigen::Vector3d rpy(const Eigen::Matrix3d& R) {
  const double pitch = std::atan2(0 - R(2, 0), std::hypot(R(0, 0), R(1, 0)));  // 0 - 0, not -0
  return {std::atan2(R(2, 1), R(2, 2)), pitch, std::atan2(R(1, 0), R(0, 0))};
}

std::string decimals(double value) {
  std::string text = fmt::format("{:.5f}", value);
  return text == "-0.00000" ? text.substr(1) : text;
}

std::string line(const Eigen::VectorXd& v) {
  std::string text;
  for (const double value : v) text += fmt::format(" {:>9}", decimals(value));
  return text;
}

std::string line(const Residual& residual) {
  return fmt::format("balance {:.1e}, bounds {:.1e}, dual {:.1e}, gap {:.1e}", residual.balance,
                     residual.bounds, residual.dual, residual.gap);
}

nlohmann::ordered_json to_json(const std::vector<CallCount>& counts) {
  auto array = nlohmann::ordered_json::array();
  for (const CallCount& count : counts) {
    array.push_back({{"method", count.method},
                     {"status", count.status},
                     {"calls", count.calls},
                     {"evaluations", count.evaluations}});
  }
  return array;
}

std::string percent(double share) { return fmt::format("{:.3g} %", 100 * share); }

std::string line(long evaluations, double seconds) {
  return fmt::format("{} evaluation{} in {:.3g} s", evaluations, evaluations == 1 ? "" : "s",
                     seconds);
}

Sampled sample_postures(const Problem& problem, int samples) {
  Random random(1);
  PostureEvaluator model(problem);
  Tally tally;
  Sampled result;
  Eigen::VectorXd theta_r = problem.theta_r_default;
  for (int sample = 0; sample < samples; ++sample) {
    for (Eigen::Index i = 0; i < theta_r.size(); ++i) {
      theta_r[i] = random.uniform(problem.theta_r_min[i], problem.theta_r_max[i]);
    }
    const Posture& posture = model.evaluate(theta_r);
    result.valid += posture.status == Status::kValid ? 1 : 0;
    tally.add(posture.ik_solutions);
  }
  result.postures = tally.sum();
  return result;
}

std::string describe(const IkCounts& ik_solutions) {
  return fmt::format(
      "postures: {} valid, {} beyond a joint's limit, {} near singular, {} in collision; none at "
      "{} "
      "theta_r, at most {} at one{}",
      ik_solutions.valid(), ik_solutions.beyond_limit, ik_solutions.singular,
      ik_solutions.collision, ik_solutions.unreachable, ik_solutions.most,
      ik_solutions.incomplete > 0
          ? fmt::format(", some perhaps missing at {} theta_r", ik_solutions.incomplete)
          : "");
}

int instants_per_interval(const MotionTask& task) {
  return task.scheme == Scheme::kSpline ? task.instants_per_interval : 1;
}

const char* actuator_unit(const Robot& robot, Eigen::Index i) {
  const auto at = static_cast<std::size_t>(i);
  const std::size_t thrusters = robot.thrusters.size();
  return at >= thrusters && robot.joints[at - thrusters].type == JointType::kRevolute ? "N m" : "N";
}

bool finds_pose(const Answer& answer) {
  return answer.task->free.count() > 0 || answer.given_joints;
}

}  // namespace maxwrench
