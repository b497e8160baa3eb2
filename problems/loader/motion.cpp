#include "problems/loader/motion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "problems/loader/path_table.h"
#include "problems/make/theta_r.h"

namespace maxwrench {
namespace {

constexpr int kMostKnots = 1000, kMostInstants = 100;
constexpr double kShortest = 1e-3, kLongest = 1e6;  // s

double read_duration(const Block& motion) {
  const double T = motion.number("T");
  if (!(T >= kShortest && T <= kLongest)) {
    motion.refuse_value("T", fmt::format("a number of {:g} to {:g}, > 0", kShortest, kLongest));
  }
  return T;
}

Timing read_timing(const Block& path) {
  const std::string name = path.text("timing", "cubic");
  if (name == "cubic") return Timing::kCubic;
  if (name == "quintic") return Timing::kQuintic;
  if (name == "linear") return Timing::kLinear;
  path.refuse_value("timing", "cubic, quintic or linear");
}

Path read_line(const Block& path, const Pose<double>& start, double T) {
  path.allow_only({"kind", "timing", "displacement"});
  const Eigen::Vector3d displacement = path.vector("displacement");
  if (displacement.isZero(0)) path.refuse_value("displacement", "one of nonzero length");
  return Path::screw(start, Eigen::Vector3d::UnitZ(), start.p, 0, displacement, read_timing(path),
                     T);
}

Path read_turn(const Block& path, const Pose<double>& start, const Eigen::Vector3d& centre,
               double T) {
  const double angle = path.number("angle");
  if (angle == 0) path.refuse_value("angle", "a number other than 0");
  return Path::screw(start, path.direction("axis"), centre, angle, Eigen::Vector3d::Zero(),
                     read_timing(path), T);
}

/// A path that starts at a pose and takes T.
Path read_path(const Block& path, const Pose<double>& start, double T) {
  const std::string kind = path.text("kind");
  if (kind == "line") return read_line(path, start, T);
  if (kind == "rotation") {
    path.allow_only({"kind", "timing", "axis", "angle"});
    return read_turn(path, start, start.p, T);
  }
  if (kind == "arc") {
    path.allow_only({"kind", "timing", "axis", "angle", "centre"});
    return read_turn(path, start, path.vector("centre"), T);
  }
  path.refuse_value("kind", "rotation, line, arc or poses");
}

void read_table(const Block& task, Problem& problem) {
  const Block path = task.table("path"), motion = task.table("motion");
  path.allow_only({"kind", "file"});
  if (task.has("pose")) task.refuse_value("pose", "none: a path through poses starts at the first");
  if (motion.has("T")) motion.refuse_value("T", "none: it is the last t of the poses");
  const std::filesystem::path file = task.file().parent_path() / path.text("file");
  problem.motion->path = read_path_table(file);
  problem.motion->path_file = file.string();
  problem.motion->T = problem.motion->path.duration();
  problem.pose = problem.motion->path.pose(0);
}

void read_scheme(const Block& block, MotionTask& motion) {
  const std::vector<std::string> names = scheme_names(motion.impulse);
  const std::string name = block.text("scheme", "spline");
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    block.refuse_value("scheme", fmt::format("one of {}", fmt::join(names, ", ")));
  }
  motion.scheme = parse_scheme(name);
  const bool spline = motion.scheme == Scheme::kSpline;
  motion.k = block.whole("k", 1, kMostKnots);
  if (spline && motion.k < 2) block.refuse_value("k", "2 or more for the scheme spline");
  if (block.has("instants_per_interval") && !spline) {
    block.refuse_value("instants_per_interval", "no such key, but for the scheme spline");
  }
  motion.instants_per_interval =
      block.whole("instants_per_interval", 1, kMostInstants, motion.impulse ? 16 : 4);
}

/// A knot, or 0 for the best one.
int read_peak(const Block& block, int k) {
  const std::string expected = fmt::format("a knot of 1 to k = {}, or 'best'", k);
  if (block.is_text("t_h") && block.text("t_h") != "best") block.refuse_value("t_h", expected);
  if (!block.has("t_h") || block.is_text("t_h")) return 0;
  const double t_h = block.number("t_h");
  if (!(t_h >= 1 && t_h <= k) || t_h != static_cast<int>(t_h)) block.refuse_value("t_h", expected);
  return static_cast<int>(t_h);
}

Start read_start_kind(const Block& start) {
  const std::string name = start.text("kind", "static");
  for (const Start kind : {Start::kStatic, Start::kRest, Start::kZero, Start::kFree})
    if (name == to_string(kind)) return kind;
  start.refuse_value("kind", "one of static, rest, zero, free");
}

}  // namespace

bool follows_poses(const Block& task) {
  if (task.text("type") != "trajectory") return false;
  const Block path = task.table("path");
  return path.is_text("kind") && path.text("kind") == "poses";
}

void read_motion(const Block& task, Problem& problem) {
  const std::string type = task.text("type");
  if (type == "static") return;
  MotionTask& motion = problem.motion.emplace();
  motion.impulse = type == "impulse";
  const Block block = task.table("motion");
  std::vector<std::string_view> keys = {"T", "k", "scheme", "instants_per_interval", "rates"};
  if (motion.impulse) keys.emplace_back("t_h");
  block.allow_only(keys);
  read_scheme(block, motion);
  motion.rates = block.truth("rates", true);
  if (follows_poses(task)) return read_table(task, problem);
  motion.T = read_duration(block);
  motion.path = motion.impulse ? Path::constant(problem.pose, motion.T)
                               : read_path(task.table("path"), problem.pose, motion.T);
  if (motion.impulse) motion.t_h = read_peak(block, motion.k);
}

void read_start(const Block& task, Problem& problem) {
  if (!problem.motion) return;
  if (task.has("contact")) {
    task.refuse_value("contact",
                      "none: a second contact is served in static tasks only, not yet in time");
  }
  if (!problem.motion->impulse) return;
  const Block start = task.table("start"), theta_r = task.table("theta_r");
  start.allow_only({"theta_r", "kind"});
  problem.motion->start = read_start_kind(start);
  if (theta_r.has("default")) {
    theta_r.refuse_value("default", "none: the default of a heave is start.theta_r");
  }
  problem.motion->theta_0 = limited_theta_r(start, "theta_r", problem);
  problem.theta_r_default = problem.motion->theta_0;
}

}  // namespace maxwrench
