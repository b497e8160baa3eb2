#include "problems/loader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "problems/loader/bad_input.h"
#include "problems/loader/block.h"
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

/// The joints that move the end effector, from the base outward.
std::vector<int> chain_to(const Robot& robot, int end_effector) {
  std::vector<int> chain;
  int link = robot.end_effectors[static_cast<std::size_t>(end_effector)].link;
  while (link > 0) {  // link i is moved by joint i - 1
    chain.push_back(link - 1);
    link = robot.joints[static_cast<std::size_t>(link - 1)].parent;
  }
  std::reverse(chain.begin(), chain.end());
  return chain;
}

void read_wrench(const Block& wrench, Problem& problem) {
  wrench.allow_only({"c", "any", "reference", "desired"});
  const Eigen::VectorXd c = wrench.numbers("c", 6);
  if (c.norm() < 1e-9) wrench.refuse_value("c", "a direction of nonzero length");
  problem.c = c.normalized();
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

void read_theta_r(const Block& theta_r, Problem& problem) {
  theta_r.allow_only({"joints", "default"});
  const std::vector<int> chain = chain_to(problem.robot, problem.end_effector);
  std::vector<std::string> names;
  for (const int joint : chain) {
    names.push_back(problem.robot.joints[static_cast<std::size_t>(joint)].name);
  }
  if (theta_r.has("joints") && theta_r.texts("joints") != names) {
    theta_r.refuse_value("joints", fmt::format("all joints from the base to the end effector, in "
                                               "this order: {}",
                                               fmt::join(names, ", ")));
  }
  const int size = static_cast<int>(chain.size());
  problem.redundant = chain;
  problem.theta_r_min.resize(size);
  problem.theta_r_max.resize(size);
  for (int i = 0; i < size; ++i) {
    const Joint& joint =
        problem.robot.joints[static_cast<std::size_t>(chain[static_cast<std::size_t>(i)])];
    problem.theta_r_min[i] = joint.q_min;
    problem.theta_r_max[i] = joint.q_max;
  }
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(size);
  problem.theta_r_default = zero.cwiseMax(problem.theta_r_min).cwiseMin(problem.theta_r_max);
  if (!theta_r.has("default")) return;
  problem.theta_r_default = theta_r.numbers("default", size);
  for (int i = 0; i < size; ++i) {
    const double value = problem.theta_r_default[i];
    if (value >= problem.theta_r_min[i] && value <= problem.theta_r_max[i]) continue;
    theta_r.refuse_value("default",
                         fmt::format("{} within {} .. {}", names[static_cast<std::size_t>(i)],
                                     problem.theta_r_min[i], problem.theta_r_max[i]));
  }
}

}  // namespace

Problem load_problem(const std::string& name) {
  const fs::path file = find_task(name);
  const Block task = Block::read(file);
  task.allow_only({"type", "robot", "end_effector", "label", "pose", "wrench", "theta_r"});
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
