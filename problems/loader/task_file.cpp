#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "lib/math/fnv.h"
#include "lib/robot/chain.h"
#include "maxwrench/load.h"
#include "maxwrench/task.h"
#include "problems/loader/bad_input.h"
#include "problems/loader/block.h"
#include "problems/loader/contact_table.h"
#include "problems/loader/motion_table.h"
#include "problems/loader/path_table.h"
#include "problems/loader/scenario_tables.h"
#include "problems/loader/urdf_tree.h"
#include "problems/make/posture.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProblemsVariable = "MAXWRENCH_PROBLEMS";

/// Whether the key `robot` occurs before the first table.
bool names_a_robot(std::istream& toml) {
  std::string line;
  while (std::getline(toml, line)) {
    const std::size_t at = line.find_first_not_of(" \t");
    if (at == std::string::npos) continue;
    if (line[at] == '[') return false;
    const std::size_t end = line.find_first_of(" \t=", at);
    const std::string key = line.substr(at, end == std::string::npos ? end : end - at);
    if (key == "robot" || key == "\"robot\"" || key == "'robot'") return true;
  }
  return false;
}

/// The file of a shipped task, or the file at a path.
fs::path find_task(const std::string& name) {
  const fs::path folder = problems_folder();
  const fs::path shipped = folder / (name + ".toml");
  if (!folder.empty() && is_file(shipped) && is_task(shipped)) return shipped;
  if (is_file(name)) return name;
  throw_bad_input(
      name, "problem", "no such file",
      fmt::format("the path of a task or one of {}", fmt::join(shipped_problems(), ", ")));
}

void read_wrench(const Block& wrench, TaskSpec& spec) {
  std::vector<std::string_view> keys = {"c", "set", "ball", "hold", "any", "reference", "desired"};
  const bool impulses = spec.motion && spec.motion->impulse;
  if (!impulses) keys.emplace_back("frame");
  if (spec.motion && !impulses) keys.emplace_back("file");
  wrench.allow_only(keys);
  const std::string frame = wrench.text("frame", "world");
  if (frame != "world" && frame != "end_effector") {
    wrench.throw_bad_value("frame", "'world' or 'end_effector'");
  }
  spec.wrench_in_end_effector = frame != "world";
  if (wrench.has("file")) {
    for (const char* key : {"c", "set", "ball", "hold", "any"}) {
      if (wrench.has(key)) wrench.throw_bad_value(key, "no such key beside wrench.file");
    }
    spec.motion->table = read_wrench_table(wrench.file().parent_path() / wrench.text("file"));
  } else {
    read_wrenches(wrench, spec);
  }
  if (wrench.has("any")) spec.any = wrench.texts("any");
  spec.reference = wrench.number("reference", spec.reference);
  if (wrench.has("desired")) spec.desired = wrench.numbers("desired", 6);
}

void read_theta_r(const Block& theta_r, TaskSpec& spec) {
  theta_r.allow_only({"joints", "default", "guess", "guess_base"});
  if (theta_r.has("joints")) spec.joints = theta_r.texts("joints");
  spec.theta_r_default = theta_r.any_numbers("default");
  spec.guess = theta_r.table("guess").numbers_by_name();
  spec.guess_base = theta_r.table("guess_base").numbers_by_name();
}

/// Rejects keys that a task of this type does not have.
void allow_keys(const Block& task) {
  const std::string type = task.text("type");
  std::vector<std::string_view> keys = {"type", "robot",  "end_effector", "label",
                                        "pose", "wrench", "theta_r",      "contact"};
  if (type == "trajectory") {
    keys.insert(keys.end(), {"path", "motion"});
  } else if (type == "impulse") {
    keys.insert(keys.end(), {"motion", "start"});
  } else if (type == "transfer") {
    keys = {"type", "robot", "end_effector", "label", "from", "to", "motion"};
    if (task.has("wrench")) {
      task.throw_bad_value("wrench", "no such table in a transfer: its payload is the wrench");
    }
  } else if (type != "static") {
    task.throw_bad_value("type", "'static', 'trajectory', 'impulse' or 'transfer'");
  }
  keys.insert(keys.end(), {"environment", "uncertainty", "loss"});
  if (type != "impulse") {
    keys.emplace_back("payload");
  } else if (task.has("payload")) {
    task.throw_bad_value("payload", "no such key in an impulse");
  }
  task.allow_only(keys);
}

void read_free_pose(const Block& pose, TaskSpec& spec) {
  if (pose.has("free")) spec.free = pose.texts("free");
  const Block range = pose.table("range");
  range.allow_only({kTwistAxes.begin(), kTwistAxes.end()});
  for (const char* axis : kTwistAxes) {
    if (!range.has(axis)) continue;
    const Eigen::VectorXd limits = range.numbers(axis, 2);
    spec.range.insert({axis, {limits[0], limits[1]}});
  }
  const std::string frame = pose.text("frame", "pose");
  if (frame != "pose" && frame != "end_effector") {
    pose.throw_bad_value("frame", "'pose' or 'end_effector'");
  }
  if (pose.has("frame") && spec.free.empty() && spec.range.empty()) {
    pose.throw_bad_value("frame", "no such key without pose.free or pose.range");
  }
  spec.along_end_effector = frame == "end_effector";
}

/// The joint positions in `state`, then those in `joints`.
std::map<std::string, double> read_posture(const Block& pose, const Robot& robot) {
  std::map<std::string, double> posture = pose.table("joints").numbers_by_name();
  if (!pose.has("state")) return posture;
  const std::map<std::string, double> named =
      named_posture(robot, "pose.state", pose.text("state"));
  posture.insert(named.begin(), named.end());
  return posture;
}

/// Reads the pose. A path through the poses of a table has its own.
void read_pose(const Block& task, TaskSpec& spec) {
  if (follows_poses(task) || task.text("type") == "transfer") return;
  const Block pose = task.table("pose");
  pose.allow_only({"xyz", "rpy", "joints", "state", "free", "range", "frame"});
  for (const char* key : {"free", "range", "frame"}) {
    if (task.text("type") != "static" && pose.has(key)) {
      pose.throw_bad_value(key, "no such key except in static tasks: in time the pose is given");
    }
  }
  if (pose.has("joints") || pose.has("state")) {
    for (const char* key : {"xyz", "rpy"}) {
      if (pose.has(key)) pose.throw_bad_value(key, "no such key beside pose.joints or pose.state");
    }
    spec.posture = read_posture(pose, spec.robot);
  } else {
    spec.pose = pose_from_xyz_rpy(pose.vector("xyz"), pose.vector("rpy"));
  }
  read_free_pose(pose, spec);
}

/// FNV-1a of the sizes and the bytes of files, then of a text, as 16 hexadecimal digits.
std::string digest_of(const std::vector<fs::path>& files, const std::string& words) {
  std::uint64_t hash = fnv1a("");
  for (const fs::path& file : files) {
    std::ifstream stream = open_file(file, "the file that was read a moment ago");
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    hash = fnv1a(text, fnv1a(fmt::format("{}:", text.size()), hash));
  }
  return fmt::format("{:016x}", fnv1a(words, hash));
}

/// What tells tasks of one URDF apart, with all digits.
std::string words_of(const TaskSpec& task, const UrdfOptions& options) {
  const auto list = [](const auto& numbers) { return fmt::format("{}", fmt::join(numbers, " ")); };
  std::string words = fmt::format(
      "{} on {}; c {} turns {}; pose {} {}", task.end_effector, list(options.base_axes),
      list(task.c), task.wrench_in_end_effector, list(task.pose.p), list(task.pose.R.reshaped()));
  if (task.posture) {
    words += "; posture";
    for (const auto& [joint, position] : *task.posture) {
      words += fmt::format(" {} {}", joint, position);
    }
  }
  if (!options.posture.empty()) words += "; of " + options.posture;
  for (const auto& [joint, position] : options.positions) {
    words += fmt::format("; {} at {}", joint, position);
  }
  if (!options.group.empty()) {
    words += fmt::format("; group {} rest {}", options.group, options.rest_posture);
    for (const auto& [joint, position] : options.rest) {
      words += fmt::format(" {} {}", joint, position);
    }
  }
  return words + words_of_scenarios(task);
}

/// The folder of the problems that a shared library or a Python module brings along, beside it.
/// Empty in a program.
fs::path beside_this_library() {
  Dl_info info;
  if (dladdr(reinterpret_cast<const void*>(&beside_this_library), &info) == 0) return {};
  const fs::path file = info.dli_fname;
  return file.extension() == ".so" ? file.parent_path() / "problems" : fs::path();
}

}  // namespace

Problem load_problem(const std::string& name, const LoadOptions& options) {
  const fs::path file = find_task(name);
  const Block task = Block::read(file);
  allow_keys(task);
  TaskSpec spec;
  spec.name = name;
  spec.label = task.text("label");
  spec.source = task.text("source");
  const fs::path robot = file.parent_path() / task.text("robot");
  if (!is_file(robot)) {
    task.throw_bad_value(
        "robot", fmt::format("the path of a robot file ({} is not a file)", robot.string()));
  }
  spec.robot = load_robot(robot, options);
  spec.end_effector = task.text("end_effector");
  const auto file_of = [&](const std::string& key) {
    return key.starts_with("link[") ? fs::path(spec.robot.files[1]) : file;  // its URDF
  };
  Problem problem = in_files(file_of, [&] {
    read_pose(task, spec);
    read_motion(task, spec);
    read_scenario_tables(task, spec);
    if (!spec.payload) read_wrench(task.table("wrench"), spec);
    read_theta_r(task.table("theta_r"), spec);
    if (task.has("contact")) spec.contact = read_contact(task.table("contact"));
    return make_problem(spec);
  });
  std::vector<fs::path> files = {file};
  files.insert(files.end(), spec.robot.files.begin(), spec.robot.files.end());
  if (spec.motion && !spec.motion->path_file.empty()) files.emplace_back(spec.motion->path_file);
  if (spec.motion && spec.motion->table) files.emplace_back(spec.motion->table->file);
  problem.digest = digest_of(files, options.limits);
  return problem;
}

Problem make_urdf_problem(const fs::path& urdf, const UrdfOptions& options, TaskSpec task) {
  task.robot = load_urdf(urdf, options);
  if (task.posture) {
    std::erase_if(*task.posture, [&](const auto& each) {  // those that are locked there
      return options.positions.contains(each.first) && find_joint(task.robot, each.first) < 0;
    });
  } else if (!options.posture.empty()) {
    task.posture =
        in_file(urdf, [&] { return named_posture(task.robot, "posture", options.posture); });
  }
  const auto& tips = task.robot.end_effectors;
  if (tips.empty()) throw_bad_input(urdf, "joint", "none that moves", "a robot with joints");
  if (task.end_effector.empty() && tips.size() == 1) task.end_effector = tips.front().name;
  Problem problem = in_file(urdf, [&] {
    return task.posture && task.posture->empty() ? make_at_some_posture(task) : make_problem(task);
  });
  problem.digest =
      digest_of({task.robot.files.begin(), task.robot.files.end()}, words_of(task, options));
  return problem;
}

bool is_task(const fs::path& file) {
  std::ifstream stream = open_file(file, "a TOML file");
  return names_a_robot(stream);
}

fs::path problems_folder() {
  const char* const chosen = std::getenv(kProblemsVariable);
  if (chosen && *chosen) {
    if (is_folder(chosen)) return chosen;
    throw std::invalid_argument(std::string(kProblemsVariable) + ": got '" + chosen +
                                "', expected a folder with problems");
  }
  std::error_code unknown;
  const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
  for (const fs::path& folder :
       {beside_this_library(), program.parent_path() / MAXWRENCH_PROBLEMS_BESIDE,
        fs::path(MAXWRENCH_PROBLEMS_SOURCE), fs::path(MAXWRENCH_PROBLEMS_INSTALLED)}) {
    if (is_folder(folder)) return fs::canonical(folder);
  }
  return {};
}

std::vector<std::string> tasks_in(const fs::path& folder) {
  std::vector<std::string> names;
  if (!is_folder(folder)) return names;
  const auto options = fs::directory_options::skip_permission_denied;
  for (const auto& entry : fs::recursive_directory_iterator(folder, options)) {
    std::error_code none;  // ignored, for example for a link to itself
    if (entry.path().extension() != ".toml" || !entry.is_regular_file(none)) continue;
    std::ifstream stream(entry.path(), std::ios::binary);
    if (stream && !names_a_robot(stream)) continue;
    names.push_back(entry.path().lexically_relative(folder).replace_extension().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> shipped_problems() { return tasks_in(problems_folder()); }

}  // namespace maxwrench
