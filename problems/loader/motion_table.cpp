#include "problems/loader/motion_table.h"

#include <filesystem>

#include "problems/loader/path_table.h"
#include "problems/make/motion_task.h"

namespace maxwrench {
namespace {

Timing read_timing(const Block& path) {
  const std::string name = path.text("timing", "cubic");
  if (name == "cubic") return Timing::kCubic;
  if (name == "quintic") return Timing::kQuintic;
  if (name == "linear") return Timing::kLinear;
  path.throw_bad_value("timing", "cubic, quintic or linear");
}

Path read_line(const Block& path, const Pose<double>& start, double T) {
  path.allow_only({"kind", "timing", "displacement"});
  const Eigen::Vector3d displacement = path.vector("displacement");
  if (displacement.isZero(0)) path.throw_bad_value("displacement", "one of nonzero length");
  return Path::screw(start, Eigen::Vector3d::UnitZ(), start.p, 0, displacement, read_timing(path),
                     T);
}

Path read_turn(const Block& path, const Pose<double>& start, const Eigen::Vector3d& centre,
               double T) {
  const double angle = path.number("angle");
  if (angle == 0) path.throw_bad_value("angle", "a number other than 0");
  return Path::screw(start, path.direction("axis"), centre, angle, Eigen::Vector3d::Zero(),
                     read_timing(path), T);
}

/// A path of duration T that starts at a pose.
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
  path.throw_bad_value("kind", "rotation, line, arc or poses");
}

void read_table(const Block& task, TaskSpec& spec) {
  const Block path = task.table("path"), motion = task.table("motion");
  path.allow_only({"kind", "file"});
  if (task.has("pose"))
    task.throw_bad_value("pose", "none: a path through poses starts at the first");
  if (motion.has("T")) motion.throw_bad_value("T", "none: it is the last t of the poses");
  const std::filesystem::path file = task.file().parent_path() / path.text("file");
  spec.motion->path = read_path_table(file);
  spec.motion->path_file = file.string();
  spec.pose = spec.motion->path.pose(0);
}

void read_scheme(const Block& block, MotionTask& motion) {
  const std::string name = block.text("scheme", "spline");
  require_scheme(name, motion.impulse);
  motion.scheme = parse_scheme(name);
  motion.k = block.whole("k", 1, kMostKnots);
  if (block.has("instants_per_interval") && motion.scheme != Scheme::kSpline) {
    block.throw_bad_value("instants_per_interval", "no such key unless the scheme is spline");
  }
  motion.instants_per_interval =
      block.whole("instants_per_interval", 1, kMostInstants, motion.impulse ? 16 : 4);
}

void read_effort_limits(const Block& block, MotionTask& motion) {
  motion.rates = block.truth("rates", true);
  motion.thruster_lag = block.number("thruster_lag", 0);
}

/// The knot of the peak, or 0 for the best one.
int read_peak(const Block& block, int k) {
  const std::string expected = peak_range(k);
  if (block.is_text("t_h") && block.text("t_h") != "best") block.throw_bad_value("t_h", expected);
  if (!block.has("t_h") || block.is_text("t_h")) return 0;
  const double t_h = block.number("t_h");
  if (!(t_h >= 1 && t_h <= kMostKnots) || t_h != static_cast<int>(t_h))
    block.throw_bad_value("t_h", expected);
  return static_cast<int>(t_h);
}

Start read_start_kind(const Block& start) {
  const std::string name = start.text("kind", "static");
  for (const Start kind : {Start::kStatic, Start::kRest, Start::kZero, Start::kFree})
    if (name == to_string(kind)) return kind;
  start.throw_bad_value("kind", "one of static, rest, zero, free");
}

/// A payload from one posture to another.
void read_transfer(const Block& task, const Block& block, TaskSpec& spec) {
  MotionTask& motion = *spec.motion;
  block.allow_only({"T", "k", "instants_per_interval", "rates", "thruster_lag"});
  read_scheme(block, motion);
  read_effort_limits(block, motion);
  motion.T = block.number("T");
  require_duration(motion.T);
  for (const char* key : {"from", "to", "payload"}) {
    if (!task.has(key)) task.throw_bad_value(key, "nothing", "a table");
  }
  spec.from = task.table("from").numbers_by_name();
  spec.to = task.table("to").numbers_by_name();
}

}  // namespace

bool follows_poses(const Block& task) {
  if (task.text("type") != "trajectory") return false;
  const Block path = task.table("path");
  return path.is_text("kind") && path.text("kind") == "poses";
}

void read_motion(const Block& task, TaskSpec& spec) {
  const std::string type = task.text("type");
  if (type == "static") return;
  MotionTask& motion = spec.motion.emplace();
  motion.impulse = type == "impulse";
  motion.transfer = type == "transfer";
  const Block block = task.table("motion");
  if (motion.transfer) return read_transfer(task, block, spec);
  std::vector<std::string_view> keys = {"T",     "k",           "scheme", "instants_per_interval",
                                        "rates", "thruster_lag"};
  if (motion.impulse) keys.emplace_back("t_h");
  block.allow_only(keys);
  read_scheme(block, motion);
  read_effort_limits(block, motion);
  if (follows_poses(task)) return read_table(task, spec);
  motion.T = block.number("T");
  require_duration(motion.T);
  if (!motion.impulse) {
    motion.path = read_path(task.table("path"), spec.pose, motion.T);
    return;
  }
  motion.t_h = read_peak(block, motion.k);
  const Block start = task.table("start");
  start.allow_only({"theta_r", "kind"});
  motion.start = read_start_kind(start);
  motion.theta_0 = start.any_numbers("theta_r");
}

}  // namespace maxwrench
