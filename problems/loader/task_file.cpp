#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "lib/math/decompositions.h"
#include "lib/math/rotated.h"
#include "lib/posture/movable.h"
#include "lib/robot/chain.h"
#include "maxwrench/load.h"
#include "problems/loader/bad_input.h"
#include "problems/loader/block.h"
#include "problems/make/contact.h"
#include "problems/make/free_pose.h"
#include "problems/loader/motion.h"
#include "problems/make/theta_r.h"
#include "problems/loader/urdf_tree.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProblemsVariable = "MAXWRENCH_PROBLEMS";

/// Whether the key `robot` stands before the first table.
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

bool is_folder(const fs::path& path) {
  std::error_code none;
  return fs::is_directory(path, none);
}

/// The file of a shipped name or a path.
fs::path find_task(const std::string& name) {
  const fs::path folder = problems_folder();
  const fs::path shipped = folder / (name + ".toml");
  if (!folder.empty() && is_file(shipped) && is_task(shipped)) return shipped;
  if (is_file(name)) return name;
  refuse(name, "problem", "no such file",
         fmt::format("the path of a task or one of {}", fmt::join(shipped_problems(), ", ")));
}

int find_end_effector(const Block& task, const Robot& robot) {
  const std::string wanted = task.text("end_effector");
  std::vector<std::string> names;
  for (const EndEffector& candidate : robot.end_effectors) {
    if (candidate.name == wanted) return static_cast<int>(names.size());
    names.push_back(candidate.name);
  }
  task.refuse_value("end_effector",
                    fmt::format("an end effector of the robot: {}", fmt::join(names, ", ")));
}

void read_wrench(const Block& wrench, Problem& problem) {
  std::vector<std::string_view> keys = {"c", "any", "reference", "desired"};
  const bool heaves = problem.motion && problem.motion->impulse;
  if (!heaves) keys.emplace_back("frame");
  wrench.allow_only(keys);
  const std::string frame = wrench.text("frame", "world");
  if (frame != "world" && frame != "tool" && frame != "end_effector") {
    wrench.refuse_value("frame", "'world' or 'tool' (or 'end_effector', the same)");
  }
  if (frame != "world") problem.wrench_axes = problem.pose.R;
  if (problem.motion) problem.motion->c_turns = frame != "world";
  const Eigen::VectorXd c = wrench.numbers("c", 6);
  if (c.stableNorm() < 1e-9) wrench.refuse_value("c", "a direction of nonzero length");
  problem.c = rotated(problem.wrench_axes, c.stableNormalized());
  problem.reference = wrench.number("reference", problem.reference);
  if (!(problem.reference > 0)) wrench.refuse_value("reference", "a number > 0");
  if (!wrench.has("desired")) return;
  problem.desired = wrench.numbers("desired", 6);
  if (!(problem.desired.array() > 0).all()) wrench.refuse_value("desired", "numbers > 0");
}

void read_any(const Block& wrench, Problem& problem) {
  const std::vector<std::string> any = wrench.texts("any");
  problem.W_any.setZero(6, static_cast<Eigen::Index>(any.size()));
  for (std::size_t column = 0; column < any.size(); ++column) {
    const auto axis = std::find(kWrenchAxes.begin(), kWrenchAxes.end(), any[column]);
    const bool twice = std::find(any.begin(), any.begin() + static_cast<std::ptrdiff_t>(column),
                                 any[column]) != any.begin() + static_cast<std::ptrdiff_t>(column);
    if (axis == kWrenchAxes.end() || twice) {
      wrench.refuse_value("any",
                          fmt::format("some of {}, each once", fmt::join(kWrenchAxes, ", ")));
    }
    problem.W_any(axis - kWrenchAxes.begin(), static_cast<Eigen::Index>(column)) = 1;
  }
  problem.W_any = rotated(problem.wrench_axes, problem.W_any);
  const Vector6d outside = problem.c - problem.W_any * (problem.W_any.transpose() * problem.c);
  if (outside.norm() > 1e-12) {
    wrench.refuse_value("c", fmt::format("a direction within any = {}", fmt::join(any, ", ")));
  }
}

/// What a task of this type may hold.
void allow_keys(const Block& task) {
  const std::string type = task.text("type");
  std::vector<std::string_view> keys = {"type", "robot",  "end_effector", "label",
                                        "pose", "wrench", "theta_r",      "contact"};
  if (type == "trajectory") {
    keys.insert(keys.end(), {"path", "motion"});
  } else if (type == "impulse") {
    keys.insert(keys.end(), {"motion", "start"});
  } else if (type != "static") {
    task.refuse_value("type", "'static', 'trajectory' or 'impulse'");
  }
  task.allow_only(keys);
}

/// A path through the poses of a table brings its own.
void read_pose(const Block& task, Problem& problem) {
  if (follows_poses(task)) return;
  const Block pose = task.table("pose");
  pose.allow_only({"xyz", "rpy", "free", "range", "axes"});
  for (const char* key : {"free", "range", "axes"}) {
    if (task.text("type") != "static" && pose.has(key)) {
      pose.refuse_value(key, "no such key, but for static tasks: in time the pose is given");
    }
  }
  problem.pose = pose_from_xyz_rpy(pose.vector("xyz"), pose.vector("rpy"));
}

/// W_any, of wrenches that do work: with T the twists with which the end effector can leave its
/// pose, all of T, or those across c beside c where c has a part that the structure takes. What the
/// task names itself must not hold a wrench h with T'h = 0: nothing bounds it.
void choose_wrenches(const Block& wrench, Problem& problem) {
  const Matrix6Xd T = motions_at_pose(problem);
  const Eigen::VectorXd c_T = T.transpose() * problem.c;
  if (c_T.norm() < kRankTolerance) {
    wrench.refuse_value("c", "a direction that does work: the end effector can move along it");
  }
  if (!wrench.has("any")) {
    problem.W_any = T;
    if (c_T.norm() > 1 - kRankTolerance) return;
    problem.W_any << problem.c, T * split(c_T).complement;
    return;
  }
  read_any(wrench, problem);
  const Split works = split(problem.W_any.transpose() * T, kRankTolerance);
  if (works.complement.cols() == 0) return;
  const Vector6d idle = tidy_range(problem.W_any * works.complement).col(0);
  wrench.refuse_value(
      "any", fmt::format("axes of which every wrench does work ([{:.3g}] does none, as the end "
                         "effector cannot move along it)",
                         fmt::join(idle, ", ")));
}

/// FNV-1a of the sizes and the bytes of files, in 16 hexadecimal digits.
std::string digest_of(const std::vector<fs::path>& files) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  const auto add = [&hash](std::string_view text) {
    for (const char byte : text) {
      hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
    }
  };
  for (const fs::path& file : files) {
    std::ifstream stream = open_file(file, "a file that was read before");
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    add(fmt::format("{}:", text.size()));
    add(text);
  }
  return fmt::format("{:016x}", hash);
}

}  // namespace

Problem load_problem(const std::string& name) {
  const fs::path file = find_task(name);
  const Block task = Block::read(file);
  allow_keys(task);
  Problem problem;
  problem.name = name;
  problem.label = task.text("label");
  problem.source = task.text("source");
  const fs::path robot = file.parent_path() / task.text("robot");
  if (!is_file(robot)) {
    task.refuse_value("robot", fmt::format("the path of a robot ({} is none)", robot.string()));
  }
  problem.robot = load_robot(robot);
  problem.end_effector = find_end_effector(task, problem.robot);
  read_pose(task, problem);
  read_motion(task, problem);
  read_wrench(task.table("wrench"), problem);
  read_theta_r(task.table("theta_r"), problem);
  read_free_pose(task, problem);
  read_start(task, problem);
  require_branch(task, problem);
  require_free_motions(task, problem);
  choose_wrenches(task.table("wrench"), problem);
  if (task.has("contact")) {
    read_contact(task.table("contact"), problem);
    reconsider_default(task, problem);
  }
  const fs::path urdf = robot.parent_path() / Block::read(robot).text("urdf");
  std::vector<fs::path> files = {file, robot, urdf};
  if (problem.motion && !problem.motion->path_file.empty()) {
    files.emplace_back(problem.motion->path_file);
  }
  problem.digest = digest_of(files);
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
       {program.parent_path() / MAXWRENCH_PROBLEMS_BESIDE, fs::path(MAXWRENCH_PROBLEMS_SOURCE),
        fs::path(MAXWRENCH_PROBLEMS_INSTALLED)}) {
    if (is_folder(folder)) return fs::canonical(folder);
  }
  return {};
}

std::vector<std::string> tasks_in(const fs::path& folder) {
  std::vector<std::string> names;
  if (!is_folder(folder)) return names;
  const auto options = fs::directory_options::skip_permission_denied;
  for (const auto& entry : fs::recursive_directory_iterator(folder, options)) {
    std::error_code none;  // such as a link that leads to itself
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
