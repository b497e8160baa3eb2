#include "problems/loader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "problems/loader/bad_input.h"
#include "problems/loader/block.h"
#include "problems/loader/contact.h"
#include "problems/loader/theta_r.h"
#include "problems/loader/urdf_tree.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;

constexpr const char* kShippedProblems = MAXWRENCH_PROBLEMS_DIR;
constexpr std::array<std::string_view, 6> kWrenchAxes = {"fx", "fy", "fz", "tx", "ty", "tz"};

/// The file of a shipped name or a path.
fs::path find_task(const std::string& name) {
  const fs::path shipped = fs::path(kShippedProblems) / (name + ".toml");
  if (fs::is_regular_file(shipped) && is_task(shipped)) return shipped;
  if (fs::is_regular_file(name)) return name;
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
  wrench.allow_only({"c", "any", "reference", "desired"});
  const Eigen::VectorXd c = wrench.numbers("c", 6);
  if (c.stableNorm() < 1e-9) wrench.refuse_value("c", "a direction of nonzero length");
  problem.c = c.stableNormalized();
  std::vector<std::string> any(kWrenchAxes.begin(), kWrenchAxes.end());
  if (wrench.has("any")) any = wrench.texts("any");
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
  const Vector6d outside = problem.c - problem.W_any * (problem.W_any.transpose() * problem.c);
  if (outside.norm() > 1e-12) {
    wrench.refuse_value("c", fmt::format("a direction within any = {}", fmt::join(any, ", ")));
  }
  problem.reference = wrench.number("reference", problem.reference);
  if (!(problem.reference > 0)) wrench.refuse_value("reference", "a number > 0");
  if (!wrench.has("desired")) return;
  problem.desired = wrench.numbers("desired", 6);
  if (!(problem.desired.array() > 0).all()) wrench.refuse_value("desired", "numbers > 0");
}

}  // namespace

Problem load_problem(const std::string& name) {
  const fs::path file = find_task(name);
  const Block task = Block::read(file);
  task.allow_only(
      {"type", "robot", "end_effector", "label", "pose", "wrench", "theta_r", "contact"});
  if (task.text("type") != "static") task.refuse_value("type", "'static'");
  Problem problem;
  problem.name = name;
  problem.label = task.text("label");
  problem.source = task.text("source");
  const fs::path robot = file.parent_path() / task.text("robot");
  if (!fs::is_regular_file(robot)) {
    task.refuse_value("robot", fmt::format("the path of a robot ({} is none)", robot.string()));
  }
  problem.robot = load_robot(robot);
  problem.end_effector = find_end_effector(task, problem.robot);
  const Block pose = task.table("pose");
  pose.allow_only({"xyz", "rpy"});
  problem.pose = pose_from_xyz_rpy(pose.vector("xyz"), pose.vector("rpy"));
  read_wrench(task.table("wrench"), problem);
  read_theta_r(task.table("theta_r"), problem);
  require_branch(task, problem);
  if (task.has("contact")) read_contact(task.table("contact"), problem);
  return problem;
}

bool is_task(const fs::path& file) { return Block::read(file).has("robot"); }

std::vector<std::string> shipped_problems() {
  std::vector<std::string> names;
  if (!fs::is_directory(kShippedProblems)) return names;
  for (const auto& entry : fs::recursive_directory_iterator(kShippedProblems)) {
    if (entry.path().extension() != ".toml" || !is_task(entry.path())) continue;
    names.push_back(fs::relative(entry.path(), kShippedProblems).replace_extension().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace maxwrench
