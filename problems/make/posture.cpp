#include "problems/make/posture.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "lib/math/decompositions.h"
#include "lib/math/random.h"
#include "lib/robot/chain.h"
#include "lib/robot/gears.h"
#include "maxwrench/posture.h"
#include "problems/make/bad_value.h"
#include "problems/make/contact.h"
#include "problems/make/theta_r.h"

namespace maxwrench {
namespace {

constexpr int kRandomPostures = 200;
/// The posture at rest is taken if it moves at least this well.
constexpr double kMovesWell = 0.02;
constexpr std::size_t kMostTries = 10;

/// How well the end effector moves in a posture: the smallest singular value of J, in units of the
/// robot's reach. Negative if bodies collide.
class Mobility {
 public:
  Mobility(const Robot& robot, int end_effector)
      : robot_(robot),
        tip_(robot.end_effectors[static_cast<std::size_t>(end_effector)]),
        rank_(motions_of(robot, end_effector)),
        kinematics_(robot),
        J_(6, robot.velocities()) {
    double reach = 0;
    for (const int joint : chain_to(robot, end_effector)) {
      reach += robot.joints[static_cast<std::size_t>(joint)].placement.p.norm();
    }
    reach_ = std::max(reach + tip_.placement.p.norm(), 1e-6);
  }

  double of(const Eigen::VectorXd& q) {
    kinematics_.set_joints(q);
    if (robot_.collision && robot_.collision->collides(kinematics_.links())) return -1;
    kinematics_.jacobian(tip_, Eigen::Matrix3d::Identity(), J_);
    fold_gears(robot_, J_);
    J_.topRows<3>() /= reach_;
    return rank_ == 0 ? 0 : singular_values(J_)[rank_ - 1];
  }

  /// Whether the end effector is above the base's origin and within 45 degrees of its x axis.
  bool is_in_front(const Eigen::VectorXd& q) {
    kinematics_.set_joints(q);
    const Eigen::Vector3d p = kinematics_.end_effector(tip_).p;
    return p.z() > 0 && p.x() > std::abs(p.y());
  }

 private:
  const Robot& robot_;
  const EndEffector& tip_;
  int rank_;
  Kinematics<double> kinematics_;
  Matrix6Xd J_;
  double reach_ = 1;
};

std::map<std::string, double> by_name(const Robot& robot, const Eigen::VectorXd& q) {
  std::map<std::string, double> posture;
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const Joint& joint = robot.joints[i];
    if (!joint.gear) posture[joint.name] = q[static_cast<Eigen::Index>(i)];
  }
  return posture;
}

/// Random postures, those from which the end effector moves best first.
std::vector<Eigen::VectorXd> best_first(const Robot& robot, Mobility& mobility) {
  std::vector<std::pair<double, Eigen::VectorXd>> rated;
  Random random(5);
  for (int k = 0; k < kRandomPostures; ++k) {
    Eigen::VectorXd q = resting_joints(robot);
    for (std::size_t i = 0; i < robot.joints.size(); ++i) {
      const Joint& joint = robot.joints[i];
      const double quarter = (joint.q_max - joint.q_min) / 4;
      q[static_cast<Eigen::Index>(i)] =
          random.uniform(joint.q_min + quarter, joint.q_max - quarter);
    }
    apply_gears(robot, q);
    const double value = mobility.of(q);
    if (value > 0) rated.emplace_back(value, std::move(q));
  }
  std::stable_sort(rated.begin(), rated.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Eigen::VectorXd> postures;
  for (auto& entry : rated) postures.push_back(std::move(entry.second));
  if (postures.size() > kMostTries) postures.resize(kMostTries);
  return postures;
}

bool has_default(const Problem& problem) {
  return PostureEvaluator(problem).evaluate(problem.theta_r_default).status == Status::kValid;
}

}  // namespace

std::map<std::string, double> named_posture(const Robot& robot, std::string_view key,
                                            const std::string& name) {
  const auto state = robot.states.find(name);
  if (state == robot.states.end()) {
    std::vector<std::string> names;
    for (const auto& entry : robot.states) names.push_back(entry.first);
    throw BadValue(key, shown(name),
                   names.empty()
                       ? "none: the robot has no named posture"
                       : fmt::format("a named posture of the robot: {}", fmt::join(names, ", ")));
  }
  std::map<std::string, double> posture = state->second;
  std::erase_if(posture, [&robot](const auto& entry) {
    const int joint = find_joint(robot, entry.first);
    return joint < 0 || robot.joints[static_cast<std::size_t>(joint)].gear;
  });
  return posture;
}

namespace {

/// The task at the first of these postures that suits it; at rest if none does.
Problem make_at_first(TaskSpec& task, const std::vector<Eigen::VectorXd>& postures) {
  const Robot& robot = task.robot;
  for (const Eigen::VectorXd& q : postures) {
    task.posture = by_name(robot, q);
    try {
      Problem problem = make_problem(task);
      if (has_default(problem)) return problem;
    } catch (const std::invalid_argument&) {
      continue;  // the next posture may do
    }
  }
  task.posture = by_name(robot, resting_joints(robot));
  return make_problem(task);
}

}  // namespace

Eigen::VectorXd joints_at_posture(const TaskSpec& task) {
  return joints_by_name("pose.joints.", *task.posture, task.robot);
}

Eigen::VectorXd joints_by_name(const std::string& start, const std::map<std::string, double>& named,
                               const Robot& robot) {
  Eigen::VectorXd q = resting_joints(robot);
  for (const auto& [name, position] : named) {
    const int found = find_joint(robot, name);
    const std::string key = start + name;
    if (found < 0 || robot.joints[static_cast<std::size_t>(found)].gear) {
      std::vector<std::string> names;
      for (const Joint& joint : robot.joints) {
        if (!joint.gear) names.push_back(joint.name);
      }
      throw BadValue(key, "an unknown key",
                     names.empty() ? "none: no joint of the robot moves"
                                   : fmt::format("a joint that moves: {}", fmt::join(names, ", ")));
    }
    require_finite(key, position);
    q[found] = position;
  }
  apply_gears(robot, q);
  return q;
}

Problem make_at_some_posture(TaskSpec task) {
  Mobility mobility(task.robot, find_end_effector("end_effector", task.end_effector, task.robot));
  std::vector<Eigen::VectorXd> postures = best_first(task.robot, mobility);
  const Eigen::VectorXd rest = resting_joints(task.robot);
  if (mobility.of(rest) > kMovesWell) postures.insert(postures.begin(), rest);
  return make_at_first(task, postures);
}

Problem make_at_good_posture(TaskSpec task) {
  Mobility mobility(task.robot, find_end_effector("end_effector", task.end_effector, task.robot));
  std::vector<Eigen::VectorXd> postures = best_first(task.robot, mobility);
  std::stable_partition(postures.begin(), postures.end(),
                        [&](const Eigen::VectorXd& q) { return mobility.is_in_front(q); });
  return make_at_first(task, postures);
}

}  // namespace maxwrench
