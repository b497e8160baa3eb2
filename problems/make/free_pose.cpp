#include "problems/make/free_pose.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numbers>

#include "lib/math/random.h"
#include "lib/math/rotated.h"
#include "lib/posture/free_pose.h"
#include "lib/posture/movable.h"
#include "maxwrench/posture.h"
#include "problems/make/bad_value.h"

namespace maxwrench {
namespace {

/// [m; rad] Larger limits would lose precision by rounding.
constexpr double kFarthest = 1e6;
constexpr double kHalfTurn = std::numbers::pi;
/// A part of a unit twist outside the end effector's motions above this is not rounding.
constexpr double kApart = 1e-6;

bool names(const std::vector<std::string>& list, const char* axis) {
  return std::find(list.begin(), list.end(), axis) != list.end();
}

/// Rejects axes that do not exist or occur twice.
void require_axes(const TaskSpec& task) {
  const auto known = [](const std::string& axis) {
    return std::find(kTwistAxes.begin(), kTwistAxes.end(), axis) != kTwistAxes.end();
  };
  for (std::size_t i = 0; i < task.free.size(); ++i) {
    const auto here = task.free.begin() + static_cast<std::ptrdiff_t>(i);
    if (known(*here) && std::find(task.free.begin(), here, *here) == here) continue;
    throw BadValue("pose.free", shown(task.free),
                   fmt::format("some of {}, each once", fmt::join(kTwistAxes, ", ")));
  }
  for (const auto& [axis, limits] : task.range) {
    if (known(axis)) continue;
    throw BadValue("pose.range." + axis, "an unknown key",
                   fmt::format("one of {}", fmt::join(kTwistAxes, ", ")));
  }
}

std::string shown_range(const std::array<double, 2>& range) {
  return fmt::format("[{}, {}]", range[0], range[1]);
}

/// [min, max] of an axis [m; rad].
std::array<double, 2> range_of(const TaskSpec& task, const char* axis, bool turns) {
  const auto found = task.range.find(axis);
  if (found == task.range.end()) {
    if (turns) return {-kHalfTurn, kHalfTurn};
    throw BadValue(
        "pose.free", shown(task.free),
        fmt::format("a range of {}, too, as pose.range.{} = [min, max]: a translation needs one",
                    axis, axis));
  }
  const std::string key = fmt::format("pose.range.{}", axis);
  const std::array<double, 2>& limits = found->second;
  const auto throw_bad_range = [&](const std::string& expected) {
    throw BadValue(key, shown_range(limits), expected);
  };
  require_numbers(key, Eigen::Map<const Eigen::VectorXd>(limits.data(), 2), 2);
  if (!(limits[0] < limits[1])) throw_bad_range("[min, max] with min < max");
  if (!(std::max(std::abs(limits[0]), std::abs(limits[1])) <= kFarthest)) {
    throw_bad_range(fmt::format("limits of at most {:g} m or rad", kFarthest));
  }
  if (turns && limits[1] - limits[0] > 2 * kHalfTurn * (1 + 1e-12)) {
    throw_bad_range("an angle's range of at most 2 pi rad");
  }
  return limits;
}

void append(Eigen::VectorXd& all, double value) {
  all.conservativeResize(all.size() + 1);
  all[all.size() - 1] = value;
}

/// An orthonormal basis of the end effector's twists at theta_r; empty if no posture reaches the
/// pose.
Matrix6Xd motions_at(const Problem& problem, PostureEvaluator& model,
                     const Eigen::VectorXd& theta_r) {
  if (problem.dependent.empty()) return motions_at_pose(held_at(problem, theta_r));
  const Posture& posture = model.evaluate(theta_r);
  return posture.ik_solutions.found > 0 ? Matrix6Xd(tidy_range(posture.J)) : Matrix6Xd(6, 0);
}

bool contains(const Matrix6Xd& T, const Matrix6Xd& twists) {
  return (twists - T * (T.transpose() * twists)).norm() < kApart * std::max(1.0, twists.norm());
}

[[noreturn]] void throw_bad_axis(const TaskSpec& task, const char* axis, const char* why) {
  const std::string expected = fmt::format("{} ({} is not one)", why, axis);
  const auto range = task.range.find(axis);
  if (range == task.range.end()) throw BadValue("pose.free", shown(task.free), expected);
  throw BadValue(fmt::format("pose.range.{}", axis), shown_range(range->second), expected);
}

}  // namespace

void set_free_pose(const TaskSpec& task, Problem& problem) {
  if (problem.motion) {
    if (task.free.empty() && task.range.empty()) return;
    throw BadValue(task.free.empty() ? "pose.range" : "pose.free",
                   task.free.empty() ? "a table" : shown(task.free),
                   "no such key except in static tasks: in time the pose is given");
  }
  require_axes(task);
  for (int i = 0; i < 6; ++i) {
    const char* axis = kTwistAxes[static_cast<std::size_t>(i)];
    if (!names(task.free, axis) && !task.range.contains(axis)) continue;
    const std::array<double, 2> limits = range_of(task, axis, i >= 3);
    problem.free.axes.push_back(i);
    append(problem.theta_r_min, limits[0]);
    append(problem.theta_r_max, limits[1]);
    append(problem.theta_r_default, std::clamp(0.0, limits[0], limits[1]));
  }
  problem.free.along_end_effector = task.along_end_effector;
  const std::vector<int>& axes = problem.free.axes;
  problem.free.wrench_turns = task.wrench_in_end_effector && !axes.empty() && axes.back() >= 3;
}

void require_free_motions(const TaskSpec& task, const Problem& problem) {
  if (problem.free.count() == 0) return;
  constexpr int kPlaces = 20;
  PostureEvaluator model(problem, false);
  Random random(4);
  Eigen::VectorXd theta_r = problem.theta_r_default;
  Matrix6Xd T_0;
  for (int place = 0; place < kPlaces; ++place) {
    const Matrix6Xd T = motions_at(problem, model, theta_r);
    const Eigen::Matrix3d turn = pose_at(problem, theta_r).R * problem.pose.R.transpose();
    for (int i = 0; i < problem.free.count() && T.cols() > 0; ++i) {
      if (contains(T, free_twist(problem, theta_r, i))) continue;
      throw_bad_axis(task, kTwistAxes[static_cast<std::size_t>(problem.free.axes[i])],
                     "axes along which the end effector can move");
    }
    const Matrix6Xd here = problem.free.wrench_turns ? rotated(turn.transpose(), T) : T;
    if (place == 0) T_0 = here;
    if (here.cols() > 0 && !contains(T_0, here)) {
      throw BadValue("pose.free", task.free.empty() ? "nothing" : shown(task.free),
                     "axes along which the end effector can move in the same ways everywhere, so "
                     "that the same wrenches do work");
    }
    for (Eigen::Index k = 0; k < theta_r.size(); ++k) {
      theta_r[k] = random.uniform(problem.theta_r_min[k], problem.theta_r_max[k]);
    }
  }
}

}  // namespace maxwrench
