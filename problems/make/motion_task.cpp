#include "problems/make/motion_task.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "problems/make/bad_value.h"
#include "problems/make/theta_r.h"

namespace maxwrench {
namespace {

void require_whole(std::string_view key, int value, int most) {
  if (value >= 1 && value <= most) return;
  throw BadValue(key, fmt::format("{}", value), fmt::format("a whole number from 1 to {}", most));
}

/// Rejects a path that is not finite or does not start at the task's pose.
void require_path(const Path& path, const Pose<double>& pose) {
  constexpr double kRounding = 1e-9;
  for (const double s : {0.0, 0.5, 1.0}) require_pose("path", path.pose(s * path.duration()));
  const Pose<double> start = path.pose(0);
  if ((start.p - pose.p).norm() < kRounding && (start.R - pose.R).norm() < kRounding) return;
  throw BadValue(
      "pose.xyz", shown(pose.p),
      fmt::format("the place and rotation at which the path starts, here {}", shown(start.p)));
}

/// Rejects a transfer without a payload, with a base that moves, or without a knot in between.
void require_transfer(const TaskSpec& task, Problem& problem) {
  MotionTask& motion = *problem.motion;
  motion.path = Path::constant(problem.pose, motion.T);
  if (!problem.robot.base_axes.empty()) {
    throw BadValue("robot", fmt::format("a base with {} free axes", problem.robot.base_axes.size()),
                   "a robot whose base is fixed, for a transfer");
  }
  if (!task.payload) throw BadValue("payload", "nothing", "the payload of the transfer");
  if (motion.scheme != Scheme::kSpline) {
    throw BadValue("motion.scheme", to_string(motion.scheme), "spline for a transfer");
  }
  if (motion.k < 3) {
    throw BadValue("motion.k", fmt::format("{}", motion.k), "3 or more for a transfer");
  }
}

/// Rejects a lag that is no time constant.
void require_lag(const MotionTask& motion) {
  if (motion.thruster_lag >= 0 && motion.thruster_lag <= kLongestLag) return;
  throw BadValue("motion.thruster_lag", shown(motion.thruster_lag), lag_range());
}

}  // namespace

void require_dynamics(const Robot& robot) {
  if (robot.no_dynamics.empty()) return;
  const DataFault& fault = robot.no_dynamics.front();
  throw BadValue(fault.key, fault.got, fault.expected + "; only static tasks do without");
}

void require_duration(double T) {
  constexpr double kShortest = 1e-3, kLongest = 1e6;
  if (T >= kShortest && T <= kLongest) return;
  throw BadValue("motion.T", shown(T),
                 fmt::format("a number from {:g} to {:g}, > 0", kShortest, kLongest));
}

void require_scheme(const std::string& name, bool impulse) {
  const std::vector<std::string> names = scheme_names(impulse);
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  throw BadValue("motion.scheme", shown(name), fmt::format("one of {}", fmt::join(names, ", ")));
}

std::string lag_range() { return fmt::format("a time constant from 0 to {:g} s", kLongestLag); }

std::string peak_range(int k) { return fmt::format("a knot from 1 to k = {}, or 'best'", k); }

void set_motion(const TaskSpec& task, Problem& problem) {
  if (!task.motion) return;
  require_dynamics(task.robot);
  MotionTask& motion = problem.motion.emplace(*task.motion);
  motion.c_turns = task.wrench_in_end_effector;
  if (!motion.impulse && !motion.transfer) motion.T = motion.path.duration();
  require_duration(motion.T);
  require_scheme(to_string(motion.scheme), motion.impulse);
  require_whole("motion.k", motion.k, kMostKnots);
  if (motion.scheme == Scheme::kSpline && motion.k < 2) {
    throw BadValue("motion.k", fmt::format("{}", motion.k), "2 or more for the scheme spline");
  }
  require_whole("motion.instants_per_interval", motion.instants_per_interval, kMostInstants);
  require_lag(motion);
  if (motion.transfer) return require_transfer(task, problem);
  if (motion.impulse) {
    motion.path = Path::constant(problem.pose, motion.T);
    if (motion.t_h >= 0 && motion.t_h <= motion.k) return;
    throw BadValue("motion.t_h", fmt::format("{}", motion.t_h), peak_range(motion.k));
  }
  require_path(motion.path, problem.pose);
}

void set_start(const TaskSpec& task, Problem& problem) {
  if (!problem.motion) return;
  if (task.contact) {
    throw BadValue("contact", "a table", "none: only static tasks support a second contact");
  }
  if (!problem.motion->impulse) return;
  if (task.theta_r_default.size() > 0) {
    throw BadValue("theta_r.default", shown(task.theta_r_default),
                   "none: the default of an impulse is start.theta_r");
  }
  require_theta_r_within("start.theta_r", problem.motion->theta_0, problem);
  problem.theta_r_default = problem.motion->theta_0;
}

}  // namespace maxwrench
