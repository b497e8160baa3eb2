#include "problems/make/theta_r.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lib/math/random.h"
#include "lib/posture/ik/dependent_joints.h"
#include "lib/posture/ik/ik_start_system.h"
#include "lib/robot/chain.h"
#include "lib/robot/gears.h"
#include "maxwrench/posture.h"
#include "problems/make/bad_value.h"
#include "problems/make/posture.h"
#include "problems/make/redundant_joints.h"
#include "problems/make/transfer_ends.h"

namespace maxwrench {
namespace {

[[noreturn]] void throw_bad_names(const TaskSpec& task, const std::string& expected) {
  throw BadValue("theta_r.joints", task.joints ? shown(*task.joints) : "nothing", expected);
}

/// The joints that the task names, which must be `count` of the chain's, with all that lead.
std::vector<int> named_joints(const TaskSpec& task, const std::vector<int>& chain,
                              const std::vector<int>& leaders, int count) {
  const Robot& robot = task.robot;
  const std::string expected =
      fmt::format("{} of the joints {}, each once (the other {}{} are dependent)", count,
                  names_of(robot, chain), static_cast<int>(chain.size()) - count,
                  robot.base_axes.empty() ? "" : " and the base");
  std::vector<int> joints;
  for (const std::string& name : *task.joints) {
    const auto found = std::find_if(chain.begin(), chain.end(), [&](int i) {
      return robot.joints[static_cast<std::size_t>(i)].name == name;
    });
    const bool known = found != chain.end();
    if (!known || std::find(joints.begin(), joints.end(), *found) != joints.end()) {
      throw_bad_names(task, expected);
    }
    joints.push_back(*found);
  }
  if (static_cast<int>(joints.size()) != count) throw_bad_names(task, expected);
  for (const int leader : leaders) {
    if (std::find(joints.begin(), joints.end(), leader) != joints.end()) continue;
    throw_bad_names(task, fmt::format("'{}' among them, which leads another joint of the chain",
                                      names_of(robot, {leader})));
  }
  return joints;
}

/// Checks the names of a task in which all joints of the chain are redundant. The task may list
/// them.
void require_chain(const TaskSpec& task, const std::vector<int>& chain) {
  std::vector<std::string> names;
  for (const int i : chain) names.push_back(task.robot.joints[static_cast<std::size_t>(i)].name);
  if (task.joints.value_or(names) != names) {
    throw_bad_names(task,
                    fmt::format("all joints from the base to the end effector, in this order: "
                                "{}",
                                fmt::join(names, ", ")));
  }
  for (const auto& [key, guess] :
       {std::pair("guess", &task.guess), std::pair("guess_base", &task.guess_base)}) {
    if (guess->empty()) continue;
    throw BadValue(fmt::format("theta_r.{}", key), "a table",
                   "no such key: only the base pose is dependent");
  }
}

void set_default(const TaskSpec& task, Problem& problem) {
  const int size = static_cast<int>(problem.redundant.size());
  problem.theta_r_min.resize(size);
  problem.theta_r_max.resize(size);
  for (int i = 0; i < size; ++i) {
    const int joint = problem.redundant[static_cast<std::size_t>(i)];
    problem.theta_r_min[i] = problem.robot.joints[static_cast<std::size_t>(joint)].q_min;
    problem.theta_r_max[i] = problem.robot.joints[static_cast<std::size_t>(joint)].q_max;
  }
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(size);
  const Eigen::VectorXd start =
      task.posture ? Eigen::VectorXd(joints_at_posture(task)(problem.redundant)) : zero;
  problem.theta_r_default = start.cwiseMax(problem.theta_r_min).cwiseMin(problem.theta_r_max);
  if (task.theta_r_default.size() == 0) return;
  require_theta_r_within("theta_r.default", task.theta_r_default, problem);
  problem.theta_r_default = task.theta_r_default;
}

/// The joints of the task's posture, if it has one. Joints beside the chain rest, whatever it says
/// of them.
Eigen::VectorXd chain_at_posture(const TaskSpec& task, const Problem& problem) {
  Eigen::VectorXd q = resting_joints(problem.robot);
  if (!task.posture) return q;
  const Eigen::VectorXd given = joints_at_posture(task);
  for (const int joint : chain_to(problem.robot, problem.end_effector)) q[joint] = given[joint];
  return q;
}

/// Sets the guess; where the task gives none, it is zero, moved into the limits.
void set_guess(const TaskSpec& task, Problem& problem) {
  const Robot& robot = problem.robot;
  problem.guess_q = chain_at_posture(task, problem);
  for (const auto& [name, value] : task.guess) {
    const std::string key = "theta_r.guess." + name;
    require_finite(key, value);
    const auto found = std::find_if(
        problem.dependent.begin(), problem.dependent.end(), [&, &wanted = name](int i) {
          return robot.joints[static_cast<std::size_t>(i)].name == wanted;
        });
    if (found == problem.dependent.end()) {
      throw BadValue(key, "an unknown key",
                     fmt::format("one of {}", names_of(robot, problem.dependent)));
    }
    const Joint& joint = robot.joints[static_cast<std::size_t>(*found)];
    if (value < joint.q_min || value > joint.q_max) {
      throw BadValue(key, shown(value),
                     fmt::format("a number within {} .. {}", joint.q_min, joint.q_max));
    }
    problem.guess_q[*found] = value;
  }
  std::vector<std::string> axes;
  for (const int axis : robot.base_axes) {
    axes.emplace_back(kTwistAxes[static_cast<std::size_t>(axis)]);
  }
  for (const auto& [name, value] : task.guess_base) {
    const std::string key = "theta_r.guess_base." + name;
    require_finite(key, value);
    const auto found = std::find(axes.begin(), axes.end(), name);
    if (found == axes.end()) {
      throw BadValue(key, "an unknown key", fmt::format("one of {}", fmt::join(axes, ", ")));
    }
    const int axis = robot.base_axes[static_cast<std::size_t>(found - axes.begin())];
    problem.guess_base[std::min(axis, 3)] = value;
  }
}

bool is_guessed(const TaskSpec& task) {
  return task.posture || !task.guess.empty() || !task.guess_base.empty();
}

/// The largest coordinate of a twist [m; rad].
std::string shown_gap(const Vector6d& gap) {
  int i = 0;
  gap.cwiseAbs().maxCoeff(&i);
  const char axis = "xyz"[i % 3];
  return i < 3 ? fmt::format("{:.2g} m away along the world's {}", std::abs(gap[i]), axis)
               : fmt::format("{:.2g} rad away about the world's {}", std::abs(gap[i]), axis);
}

/// For example "elbow, wrist and the base".
std::string dependents_of(const Problem& problem) {
  return names_of(problem.robot, problem.dependent) +
         (problem.robot.base_axes.empty() ? "" : " and the base");
}

[[noreturn]] void throw_bad_joints(const TaskSpec& task, const Problem& problem, const char* why) {
  throw_bad_names(task, fmt::format("joints that, with the pose, determine {} ({})",
                                    dependents_of(problem), why));
}

/// The program's choice of joints fails in all postures only if gears leave it none: the leader of
/// a gear must be redundant.
[[noreturn]] void throw_bad_gears(const Problem& problem) {
  const Robot& robot = problem.robot;
  const std::vector<int> leaders = leaders_to(robot, problem.end_effector);
  throw BadValue(
      "end_effector",
      shown(robot.end_effectors[static_cast<std::size_t>(problem.end_effector)].name),
      fmt::format("one that {} can move in all its directions{}", dependents_of(problem),
                  leaders.empty() ? ""
                                  : fmt::format(": the joint that leads a gear is in theta_r "
                                                "(here {}). joints.NAME.lock fixes a gear",
                                                names_of(robot, leaders))));
}

/// Whether the velocities of the base and the dependent joints move the end effector independently
/// of each other in almost all postures.
bool follow_independently(const Problem& problem) {
  std::vector<int> velocities(problem.robot.base_axes.size());
  std::iota(velocities.begin(), velocities.end(), 0);
  const int axes = static_cast<int>(velocities.size());
  for (const int joint : problem.dependent) velocities.push_back(axes + joint);
  return motions_of(problem.robot, problem.end_effector, velocities) ==
         static_cast<int>(velocities.size());
}

[[noreturn]] void throw_bad_pose(const TaskSpec& task, const Problem& problem) {
  const DependentJoints ik_solution(problem);
  if (ik_solution.has_start() && ik_solution.start_is_singular()) {
    throw_bad_joints(task, problem, "they do not at the default: singular");
  }
  throw BadValue(
      "pose.xyz", shown(problem.pose.p),
      fmt::format("a pose that {} reach{} (from {} at the default, Newton's method ends {})",
                  dependents_of(problem), problem.motion ? " on the IK solution of the guess" : "",
                  task.guess.empty() ? "zero" : "theta_r.guess",
                  shown_gap(ik_solution.start_gap())));
}

[[noreturn]] void throw_bad_default(const TaskSpec& task, const Problem& problem, bool impulse) {
  const std::string dependents = dependents_of(problem);
  if (impulse) {
    throw BadValue(
        "start.theta_r", shown(problem.theta_r_default),
        fmt::format("theta_r at which {} reach the pose (they do elsewhere)", dependents));
  }
  throw BadValue("theta_r.default", shown(task.theta_r_default),
                 fmt::format("theta_r at which {} reach the pose (they do elsewhere: omit this key "
                             "to have a default found)",
                             dependents));
}

/// Whether a posture reaches the pose. It may collide.
bool is_reached(const Posture& posture) { return posture.ik_solutions.found > 0; }

/// Finds a default that the task leaves open: the first sample with a valid posture, or else one at
/// which the pose is reached. Samples first vary the joints alone; then also the coordinates of the
/// pose and of a second contact.
void find_default(PostureEvaluator& model, Problem& problem) {
  constexpr int kPlaces = 4000;
  Random random(3);
  const auto joints = static_cast<Eigen::Index>(problem.redundant.size());
  Eigen::VectorXd place = problem.theta_r_default;
  bool reached = is_reached(model.evaluate(place));
  for (int i = 0; i < kPlaces; ++i) {
    const Eigen::Index moving = i < kPlaces / 2 ? joints : place.size();
    for (Eigen::Index k = 0; k < moving; ++k) {
      place[k] = random.uniform(problem.theta_r_min[k], problem.theta_r_max[k]);
    }
    const Posture& posture = model.evaluate(place);
    const bool valid = posture.status == Status::kValid;
    if (!valid && (reached || !is_reached(posture))) continue;
    problem.theta_r_default = place;
    reached = true;
    if (valid) return;
  }
}

void guess_from(const Posture& posture, Problem& problem) {
  for (const int i : problem.dependent) problem.guess_q[i] = posture.q[i];
  const Pose<double> base = problem.robot.mount.inverse() * posture.base;
  problem.guess_base << base.p, std::atan2(base.R(1, 0), base.R(0, 0));
}

}  // namespace

std::string names_of(const Robot& robot, const std::vector<int>& joints) {
  std::vector<std::string> names;
  for (const int i : joints) names.push_back(robot.joints[static_cast<std::size_t>(i)].name);
  return fmt::format("{}", fmt::join(names, ", "));
}

void require_theta_r_within(std::string_view key, const Eigen::VectorXd& values,
                            const Problem& problem) {
  const int size = problem.redundancy();
  require_numbers(key, values, size);
  for (int i = 0; i < size; ++i) {
    if (values[i] >= problem.theta_r_min[i] && values[i] <= problem.theta_r_max[i]) continue;
    throw BadValue(key, shown(values),
                   fmt::format("{} within {} .. {}", problem.theta_r_name(i),
                               problem.theta_r_min[i], problem.theta_r_max[i]));
  }
}

void set_joints(const TaskSpec& task, Problem& problem) {
  const Robot& robot = problem.robot;
  if (problem.motion || task.contact) {
    require_no_gears("end_effector", robot, problem.end_effector);
  }
  const std::vector<int> chain = motors_to(robot, problem.end_effector);
  if (problem.motion && problem.motion->transfer) return set_transfer_ends(task, chain, problem);
  const int axes = static_cast<int>(robot.base_axes.size());
  const int dependent = motions_of(robot, problem.end_effector) - axes;
  problem.redundant = chain;
  if (dependent == 0) {
    require_chain(task, chain);
    set_default(task, problem);
    return;
  }
  const int count = static_cast<int>(chain.size()) - dependent;
  const std::vector<int> leaders = leaders_to(robot, problem.end_effector);
  require_redundant_leaders(robot, leaders, count);
  problem.redundant =
      task.joints ? named_joints(task, chain, leaders, count)
                  : choose_redundant(problem.robot, problem.end_effector, chain, leaders, count);
  for (const int joint : chain) {
    const auto& redundant = problem.redundant;
    if (std::find(redundant.begin(), redundant.end(), joint) == redundant.end()) {
      problem.dependent.push_back(joint);
    }
  }
  set_default(task, problem);
  set_guess(task, problem);
}

void require_ik_solution(const TaskSpec& task, Problem& problem) {
  if (problem.dependent.empty()) return;
  if (!follow_independently(problem)) {
    if (!task.joints) throw_bad_gears(problem);
    throw_bad_joints(task, problem, "they do in no posture: singular");
  }
  prepare_ik_solutions(problem);
  if (!problem.start_system->reaches()) throw_bad_pose(task, problem);
  PostureEvaluator model(problem);
  const Posture& at_default = model.evaluate(problem.theta_r_default);
  const bool impulse = problem.motion && problem.motion->impulse;
  const bool open = task.theta_r_default.size() == 0 && !impulse;
  if (open ? at_default.status != Status::kValid : !is_reached(at_default)) {
    if (!open) throw_bad_default(task, problem, impulse);
    find_default(model, problem);
  }
  if (is_guessed(task)) {
    if (DependentJoints(problem).has_start()) return;
    if (problem.motion) throw_bad_pose(task, problem);
  }
  guess_from(model.evaluate(problem.theta_r_default), problem);
}

void reconsider_default(const TaskSpec& task, Problem& problem) {
  if (problem.dependent.empty() || task.theta_r_default.size() > 0) return;
  PostureEvaluator model(problem);
  if (model.evaluate(problem.theta_r_default).status == Status::kValid) return;
  find_default(model, problem);
  if (is_guessed(task)) return;
  guess_from(model.evaluate(problem.theta_r_default), problem);
}

}  // namespace maxwrench
