#include "problems/make/theta_r.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "lib/math/random.h"
#include "lib/posture/branch_atlas.h"
#include "lib/posture/dependent_joints.h"
#include "lib/robot/chain.h"
#include "maxwrench/posture.h"

namespace maxwrench {
namespace {

/// The joints that the task names, `count` of the chain's.
std::vector<int> named_joints(const Block& theta_r, const Robot& robot,
                              const std::vector<int>& chain, int count) {
  const std::string expected = fmt::format(
      "{} of the joints {}, each once (the other {}{} follow)", count, names_of(robot, chain),
      static_cast<int>(chain.size()) - count, robot.base_axes.empty() ? "" : " and the base");
  if (count > 0 && !theta_r.has("joints")) theta_r.refuse_value("joints", expected);
  std::vector<int> joints;
  if (!theta_r.has("joints")) return joints;
  for (const std::string& name : theta_r.texts("joints")) {
    const auto found = std::find_if(chain.begin(), chain.end(), [&](int i) {
      return robot.joints[static_cast<std::size_t>(i)].name == name;
    });
    const bool known = found != chain.end();
    if (!known || std::find(joints.begin(), joints.end(), *found) != joints.end()) {
      theta_r.refuse_value("joints", expected);
    }
    joints.push_back(*found);
  }
  if (static_cast<int>(joints.size()) != count) theta_r.refuse_value("joints", expected);
  return joints;
}

/// All joints of the chain are redundant: the task may repeat them.
void require_chain(const Block& theta_r, const Robot& robot, const std::vector<int>& chain) {
  std::vector<std::string> names;
  for (const int i : chain) names.push_back(robot.joints[static_cast<std::size_t>(i)].name);
  if (theta_r.has("joints") && theta_r.texts("joints") != names) {
    theta_r.refuse_value("joints", fmt::format("all joints from the base to the end effector, in "
                                               "this order: {}",
                                               fmt::join(names, ", ")));
  }
  for (const char* key : {"guess", "guess_base"}) {
    if (theta_r.has(key)) theta_r.refuse_value(key, "no such key: the base pose follows alone");
  }
}

void read_default(const Block& theta_r, Problem& problem) {
  const int size = static_cast<int>(problem.redundant.size());
  problem.theta_r_min.resize(size);
  problem.theta_r_max.resize(size);
  for (int i = 0; i < size; ++i) {
    const int joint = problem.redundant[static_cast<std::size_t>(i)];
    problem.theta_r_min[i] = problem.robot.joints[static_cast<std::size_t>(joint)].q_min;
    problem.theta_r_max[i] = problem.robot.joints[static_cast<std::size_t>(joint)].q_max;
  }
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(size);
  problem.theta_r_default = zero.cwiseMax(problem.theta_r_min).cwiseMin(problem.theta_r_max);
  if (!theta_r.has("default")) return;
  problem.theta_r_default = limited_theta_r(theta_r, "default", problem);
}

/// Zero, moved into the limits, where the task guesses nothing.
void read_guess(const Block& theta_r, Problem& problem) {
  const Robot& robot = problem.robot;
  std::vector<std::string> names;
  problem.guess_q.resize(static_cast<Eigen::Index>(robot.joints.size()));
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    problem.guess_q[static_cast<Eigen::Index>(i)] =
        std::clamp(0.0, robot.joints[i].q_min, robot.joints[i].q_max);
  }
  const Block guess = theta_r.table("guess");
  for (const int i : problem.dependent) {
    const Joint& joint = robot.joints[static_cast<std::size_t>(i)];
    names.push_back(joint.name);
    const double value = guess.number(joint.name, problem.guess_q[i]);
    if (value < joint.q_min || value > joint.q_max) {
      guess.refuse_value(joint.name,
                         fmt::format("a number within {} .. {}", joint.q_min, joint.q_max));
    }
    problem.guess_q[i] = value;
  }
  guess.allow_only({names.begin(), names.end()});
  const Block base = theta_r.table("guess_base");
  std::vector<std::string_view> axes;
  for (const int axis : robot.base_axes) {
    axes.emplace_back(kTwistAxes[static_cast<std::size_t>(axis)]);
    problem.guess_base[std::min(axis, 3)] = base.number(axes.back(), 0);
  }
  base.allow_only(axes);
}

/// Of a twist [m; rad], the coordinate that is largest.
std::string shown_gap(const Vector6d& gap) {
  int i = 0;
  gap.cwiseAbs().maxCoeff(&i);
  const char axis = "xyz"[i % 3];
  return i < 3 ? fmt::format("{:.2g} m away along the world's {}", std::abs(gap[i]), axis)
               : fmt::format("{:.2g} rad away about the world's {}", std::abs(gap[i]), axis);
}

/// "elbow, wrist and the base"
std::string followers_of(const Problem& problem) {
  return names_of(problem.robot, problem.dependent) +
         (problem.robot.base_axes.empty() ? "" : " and the base");
}

[[noreturn]] void refuse_joints(const Block& task, const Problem& problem, const char* why) {
  task.table("theta_r").refuse_value(
      "joints",
      fmt::format("joints without which the pose fixes {} ({})", followers_of(problem), why));
}

/// Whether base and dependent joints move the end effector in as many ways as they are, in almost
/// all postures.
bool follow_independently(const Problem& problem) {
  std::vector<int> velocities(problem.robot.base_axes.size());
  std::iota(velocities.begin(), velocities.end(), 0);
  const int axes = static_cast<int>(velocities.size());
  for (const int joint : problem.dependent) velocities.push_back(axes + joint);
  return motions_of(problem.robot, problem.end_effector, velocities) ==
         static_cast<int>(velocities.size());
}

[[noreturn]] void refuse_pose(const Block& task, const Problem& problem) {
  const DependentJoints branch(problem);
  if (branch.has_start() && branch.start_is_singular()) {
    refuse_joints(task, problem, "it does not at the default: singular");
  }
  task.table("pose").refuse_value(
      "xyz", fmt::format("a pose that {} reach{} (from {} at the default Newton's method stays {})",
                         followers_of(problem), problem.motion ? " on the branch of the guess" : "",
                         task.table("theta_r").has("guess") ? "theta_r.guess" : "zero",
                         shown_gap(branch.start_gap())));
}

[[noreturn]] void refuse_default(const Block& task, const Problem& problem, bool heave) {
  const std::string followers = followers_of(problem);
  if (heave) {
    task.table("start").refuse_value(
        "theta_r",
        fmt::format("theta_r at which {} reach the pose (they do elsewhere)", followers));
  }
  task.table("theta_r").refuse_value(
      "default", fmt::format("theta_r at which {} reach the pose (they do elsewhere: without this "
                             "key a place is found)",
                             followers));
}

/// Whether the pose is reached, in a posture that may yet collide.
bool is_reached(const Posture& posture) { return posture.branches.found > 0; }

/// A default that the task leaves open: the first place with a valid posture, or else where the
/// pose is reached at all. First the joints move alone; then the coordinates of the pose and of a
/// second contact leave their own defaults too.
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

Eigen::VectorXd limited_theta_r(const Block& block, std::string_view key, const Problem& problem) {
  const int size = problem.redundancy();
  Eigen::VectorXd values = block.numbers(key, size);
  for (int i = 0; i < size; ++i) {
    if (values[i] >= problem.theta_r_min[i] && values[i] <= problem.theta_r_max[i]) continue;
    block.refuse_value(key, fmt::format("{} within {} .. {}", problem.theta_r_name(i),
                                        problem.theta_r_min[i], problem.theta_r_max[i]));
  }
  return values;
}

void read_theta_r(const Block& theta_r, Problem& problem) {
  theta_r.allow_only({"joints", "default", "guess", "guess_base"});
  const Robot& robot = problem.robot;
  const std::vector<int> chain = chain_to(robot, problem.end_effector);
  const int axes = static_cast<int>(robot.base_axes.size());
  const int dependent = motions_of(robot, problem.end_effector) - axes;
  problem.redundant = chain;
  if (dependent == 0) {
    require_chain(theta_r, robot, chain);
    read_default(theta_r, problem);
    return;
  }
  problem.redundant =
      named_joints(theta_r, robot, chain, static_cast<int>(chain.size()) - dependent);
  for (const int joint : chain) {
    const auto& redundant = problem.redundant;
    if (std::find(redundant.begin(), redundant.end(), joint) == redundant.end()) {
      problem.dependent.push_back(joint);
    }
  }
  read_default(theta_r, problem);
  read_guess(theta_r, problem);
}

void require_branch(const Block& task, Problem& problem) {
  if (problem.dependent.empty()) return;
  if (!follow_independently(problem)) {
    refuse_joints(task, problem, "it does in no posture: singular");
  }
  prepare_branches(problem);
  if (!problem.atlas->reaches()) refuse_pose(task, problem);
  const Block theta_r = task.table("theta_r");
  PostureEvaluator model(problem);
  const Posture& at_default = model.evaluate(problem.theta_r_default);
  const bool heave = problem.motion && problem.motion->impulse;
  const bool open = !theta_r.has("default") && !heave;
  if (open ? at_default.status != Status::kValid : !is_reached(at_default)) {
    if (!open) refuse_default(task, problem, heave);
    find_default(model, problem);
  }
  if (theta_r.has("guess") || theta_r.has("guess_base")) {
    if (DependentJoints(problem).has_start()) return;
    if (problem.motion) refuse_pose(task, problem);
  }
  guess_from(model.evaluate(problem.theta_r_default), problem);
}

void reconsider_default(const Block& task, Problem& problem) {
  const Block theta_r = task.table("theta_r");
  if (problem.dependent.empty() || theta_r.has("default")) return;
  PostureEvaluator model(problem);
  if (model.evaluate(problem.theta_r_default).status == Status::kValid) return;
  find_default(model, problem);
  if (theta_r.has("guess") || theta_r.has("guess_base")) return;
  guess_from(model.evaluate(problem.theta_r_default), problem);
}

}  // namespace maxwrench
