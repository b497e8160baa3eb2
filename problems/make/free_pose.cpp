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

namespace maxwrench {
namespace {

/// [m; rad] Limits beyond this would be lost in rounding.
constexpr double kFarthest = 1e6;
constexpr double kHalfTurn = std::numbers::pi;
/// Part of a unit twist beyond the end effector's motions that is no rounding.
constexpr double kApart = 1e-6;

bool names(const std::vector<std::string>& list, const char* axis) {
  return std::find(list.begin(), list.end(), axis) != list.end();
}

/// The axes of `free`, each a known one and once.
std::vector<std::string> read_axes(const Block& pose) {
  if (!pose.has("free")) return {};
  std::vector<std::string> free = pose.texts("free");
  for (std::size_t i = 0; i < free.size(); ++i) {
    const bool known = std::find(kTwistAxes.begin(), kTwistAxes.end(), free[i]) != kTwistAxes.end();
    const auto here = free.begin() + static_cast<std::ptrdiff_t>(i);
    if (known && std::find(free.begin(), here, free[i]) == here) continue;
    pose.refuse_value("free", fmt::format("some of {}, each once", fmt::join(kTwistAxes, ", ")));
  }
  return free;
}

/// [min, max] of an axis [m; rad].
Eigen::Vector2d read_range(const Block& pose, const char* axis, bool turns) {
  const Block range = pose.table("range");
  if (!range.has(axis)) {
    if (turns) return {-kHalfTurn, kHalfTurn};
    pose.refuse_value("free", fmt::format("a range of {} too, as pose.range.{} = [min, max]: a "
                                          "translation needs one",
                                          axis, axis));
  }
  const Eigen::VectorXd limits = range.numbers(axis, 2);
  if (!(limits[0] < limits[1])) range.refuse_value(axis, "[min, max] with min < max");
  if (!(limits.cwiseAbs().maxCoeff() <= kFarthest)) {
    range.refuse_value(axis, fmt::format("limits of at most {:g} m or rad", kFarthest));
  }
  if (turns && limits[1] - limits[0] > 2 * kHalfTurn * (1 + 1e-12)) {
    range.refuse_value(axis, "an angle's range of at most 2 pi rad");
  }
  return {limits[0], limits[1]};
}

bool read_along_tool(const Block& pose) {
  const std::string axes = pose.text("axes", "pose");
  if (axes != "pose" && axes != "tool") pose.refuse_value("axes", "'pose' or 'tool'");
  return axes == "tool";
}

void append(Eigen::VectorXd& all, double value) {
  all.conservativeResize(all.size() + 1);
  all[all.size() - 1] = value;
}

/// The twists that the end effector can make at theta_r, an orthonormal basis; nothing where no
/// posture reaches the pose.
Matrix6Xd motions_at(const Problem& problem, PostureEvaluator& model,
                     const Eigen::VectorXd& theta_r) {
  if (problem.dependent.empty()) return motions_at_pose(held_at(problem, theta_r));
  const Posture& posture = model.evaluate(theta_r);
  return posture.branches.found > 0 ? Matrix6Xd(tidy_range(posture.J)) : Matrix6Xd(6, 0);
}

bool contains(const Matrix6Xd& T, const Matrix6Xd& twists) {
  return (twists - T * (T.transpose() * twists)).norm() < kApart * std::max(1.0, twists.norm());
}

[[noreturn]] void refuse_axis(const Block& pose, const char* axis, const char* why) {
  const Block range = pose.table("range");
  const bool ranged = range.has(axis);
  (ranged ? range : pose)
      .refuse_value(ranged ? axis : "free", fmt::format("{} ({} is none)", why, axis));
}

}  // namespace

void read_free_pose(const Block& task, Problem& problem) {
  if (problem.motion) return;
  const Block pose = task.table("pose");
  const std::vector<std::string> free = read_axes(pose);
  const Block range = pose.table("range");
  range.allow_only({kTwistAxes.begin(), kTwistAxes.end()});
  for (int i = 0; i < 6; ++i) {
    const char* axis = kTwistAxes[static_cast<std::size_t>(i)];
    if (!names(free, axis) && !range.has(axis)) continue;
    const Eigen::Vector2d limits = read_range(pose, axis, i >= 3);
    problem.free.axes.push_back(i);
    append(problem.theta_r_min, limits[0]);
    append(problem.theta_r_max, limits[1]);
    append(problem.theta_r_default, std::clamp(0.0, limits[0], limits[1]));
  }
  problem.free.along_tool = read_along_tool(pose);
  const std::vector<int>& axes = problem.free.axes;
  if (axes.empty() && pose.has("axes")) {
    pose.refuse_value("axes", "no such key, but beside pose.free or pose.range");
  }
  const std::string frame = task.table("wrench").text("frame", "world");
  problem.free.wrench_turns = frame != "world" && !axes.empty() && axes.back() >= 3;
}

void require_free_motions(const Block& task, const Problem& problem) {
  if (problem.free.count() == 0) return;
  constexpr int kPlaces = 20;
  const Block pose = task.table("pose");
  PostureEvaluator model(problem, false);
  Random random(4);
  Eigen::VectorXd theta_r = problem.theta_r_default;
  Matrix6Xd T_0;
  for (int place = 0; place < kPlaces; ++place) {
    const Matrix6Xd T = motions_at(problem, model, theta_r);
    const Eigen::Matrix3d turn = pose_at(problem, theta_r).R * problem.pose.R.transpose();
    for (int i = 0; i < problem.free.count() && T.cols() > 0; ++i) {
      if (contains(T, free_twist(problem, theta_r, i))) continue;
      refuse_axis(pose, kTwistAxes[static_cast<std::size_t>(problem.free.axes[i])],
                  "axes along which the end effector can move");
    }
    const Matrix6Xd here = problem.free.wrench_turns ? rotated(turn.transpose(), T) : T;
    if (place == 0) T_0 = here;
    if (here.cols() > 0 && !contains(T_0, here)) {
      pose.refuse_value("free",
                        "axes along which the end effector can move in the same ways "
                        "everywhere, so that the same wrenches do work");
    }
    for (Eigen::Index k = 0; k < theta_r.size(); ++k) {
      theta_r[k] = random.uniform(problem.theta_r_min[k], problem.theta_r_max[k]);
    }
  }
}

}  // namespace maxwrench
