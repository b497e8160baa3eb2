#include "cli/task/problem_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "cli/cli.h"
#include "lib/robot/chain.h"
#include "problems/loader/bad_input.h"
#include "problems/loader/block.h"
#include "problems/loader/urdf_tree.h"
#include "problems/make/posture.h"
#include "solvers/solve/format.h"

namespace maxwrench {
namespace {

/// What precedes the name of a joint in the key of a posture.
constexpr std::string_view kJointKey = "pose.joints.";

[[noreturn]] void reject(std::string_view option, const std::string& got,
                         std::string_view expected) {
  throw BadValue(option, shown(got), expected);
}

/// The numbers in a text, separated by blanks or commas; none if there is something else.
std::vector<double> numbers_in(std::string text) {
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream words(text);
  std::vector<double> numbers;
  for (double number = 0; words >> number;) numbers.push_back(number);
  if (!words.eof()) numbers.clear();
  return numbers;
}

/// "x y z / roll pitch yaw"
Pose<double> parse_pose(const std::string& text) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  const std::vector<double> xyz = numbers_in(text.substr(0, slash));
  const std::vector<double> rpy = numbers_in(text.substr(std::min(slash + 1, text.size())));
  if (xyz.size() != 3 || rpy.size() != 3) {
    reject("--at", text, "'x y z / roll pitch yaw' [m; rad], the pose of the tool in the world");
  }
  return pose_from_xyz_rpy({xyz[0], xyz[1], xyz[2]}, {rpy[0], rpy[1], rpy[2]});
}

/// "x,y,yaw" as indices of kTwistAxes, in increasing order.
std::vector<int> parse_axes(const std::string& text) {
  std::vector<int> axes;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    const auto found = std::find(kTwistAxes.begin(), kTwistAxes.end(), word);
    if (found == kTwistAxes.end()) {
      reject("--base", text,
             fmt::format("the free axes of the base, of {}, separated by commas",
                         fmt::join(kTwistAxes, ", ")));
    }
    axes.push_back(static_cast<int>(found - kTwistAxes.begin()));
  }
  std::sort(axes.begin(), axes.end());
  return axes;
}

/// One of the axes, such as -z or rx, or six numbers.
Vector6d parse_direction(const std::string& text) {
  static constexpr std::array<const char*, 6> kNames = {"x", "y", "z", "rx", "ry", "rz"};
  const bool has_sign = text.starts_with('-') || text.starts_with('+');
  const auto found = std::find(kNames.begin(), kNames.end(), text.substr(has_sign ? 1 : 0));
  if (found != kNames.end()) {
    return (text.starts_with('-') ? -1 : 1) * Vector6d::Unit(found - kNames.begin());
  }
  const std::vector<double> numbers = numbers_in(text);
  if (numbers.size() != 6) {
    reject("--wrench-along", text,
           "x, y, z (a force) or rx, ry, rz (a torque), perhaps with a sign, or six numbers");
  }
  return Vector6d(numbers.data());
}

bool parse_frame(const std::string& text) {
  if (text != "world" && text != "tool") reject("--wrench-frame", text, "world or tool");
  return text == "tool";
}

/// "j1=0.3,j2=-1", or a TOML file of such lines.
std::map<std::string, double> parse_joints(const char* option, const std::string& text) {
  if (is_file(text)) return Block::read(text).numbers_by_name();
  std::map<std::string, double> positions;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    const std::size_t equals = std::min(word.find('='), word.size());
    std::string name = word.substr(0, equals);
    std::erase(name, ' ');
    const std::vector<double> number = numbers_in(word.substr(std::min(equals + 1, word.size())));
    if (name.empty() || number.size() != 1 || !positions.emplace(name, number[0]).second) {
      reject(option, text,
             "JOINT=POSITION, each joint once, separated by commas, or a TOML file of such lines");
    }
  }
  return positions;
}

/// The option that gives this key of a task made of a URDF; empty if none does.
std::string option_of(const std::string& key, const ProblemOptions& options) {
  if (key == "end_effector" || key == "tool") return "--tool";
  if (key == "wrench.c") return "--wrench-along";
  if (key == "base.axes") return "--base";
  if (key == "pose.xyz" || key == "pose") return options.gives_joints() ? "--joints" : "--at";
  if (key == "positions") return options.joints ? "--joints" : "--posture";
  if (key == "posture") return "--posture";
  if (key == "group") return "--group";
  if (key == "rest") return options.rest ? "--rest" : "--posture";
  return "";
}

/// Calls `make`. If it rejects a key that an option gives, names the option.
///
/// @param evaluates_joints  whether the joints themselves are evaluated, at any posture
template <class Make>
auto naming_options(const ProblemOptions& options, bool evaluates_joints, const Make& make) {
  try {
    return make();
  } catch (const BadInput& error) {
    const BadValue& bad = error.value();
    if (bad.key().starts_with(kJointKey)) {
      reject("--joints", bad.key().substr(kJointKey.size()), bad.expected());
    }
    if (bad.key() == "theta_r.joints") {  // which the program chose
      throw BadValue(options.gives_joints() ? "--joints" : "--at", "a pose that is singular",
                     fmt::format("one from which the tool can move in all its directions{}",
                                 evaluates_joints ? "" : " (only eval --joints does without)"));
    }
    const std::string option = option_of(bad.key(), options);
    if (option.empty()) throw;
    throw BadValue(option, bad.got(), bad.expected());
  }
}

/// A word of a command line, in quotes if a shell would divide it.
std::string word(const std::string& text) {
  return text.find_first_of(" \t'\"$&;()*?<>|\\") == std::string::npos ? text : '"' + text + '"';
}

/// The command that prints the warnings of a robot, read with the same options.
std::string check_command(const ProblemOptions& options, const std::string& problem) {
  std::string command = "maxwrench check " + word(problem);
  for (const auto& [option, value] :
       {std::pair("--tool", &options.tool), std::pair("--base", &options.base),
        std::pair("--srdf", &options.srdf), std::pair("--group", &options.group),
        std::pair("--rest", &options.rest), std::pair("--limits", &options.limits)}) {
    if (*value) command += fmt::format(" {} {}", option, word(**value));
  }
  for (const std::string& package : options.packages) command += " --package " + word(package);
  return command;
}

void remark_warnings(const Robot& robot, const ProblemOptions& options,
                     const std::string& problem) {
  const std::size_t count = warnings_of(robot).size();
  if (count == 0) return;
  complain_at_end(fmt::format("{} warning{} about the robot: '{}' prints {}", count,
                              count == 1 ? "" : "s", check_command(options, problem),
                              count == 1 ? "it" : "them"));
}

}  // namespace

std::vector<std::string> warnings_of(const Robot& robot) {
  std::vector<std::string> lines = robot.warnings;
  for (const DataFault& fault : robot.no_dynamics) {
    lines.push_back(bad_value_line(fault.key, fault.got, fault.expected) +
                    " (tasks in time reject it)");
  }
  return lines;
}

bool is_urdf(const std::string& problem) {
  const std::string extension = std::filesystem::path(problem).extension().string();
  if (extension == ".urdf" || extension == ".xacro") return true;
  if (!is_file(problem)) return false;
  std::ifstream stream(problem, std::ios::binary);
  char first = 0;
  return static_cast<bool>(stream >> first) && first == '<';
}

void ProblemOptions::add_robot(CLI::App& app) {
  app.add_option("--tool", tool, "URDF: the link that is the end effector");
  app.add_option("--base", base,
                 "URDF: the free axes of the base, such as x,y,yaw; it is parked anywhere on them");
  app.add_option("--srdf", srdf, "URDF: SRDF file with collision pairs to leave out and postures");
  app.add_option("--group", group,
                 "URDF: the group of the SRDF whose joints move; the others are locked");
  app.add_option("--rest", rest,
                 "URDF: where the joints outside of the group are: a named posture, "
                 "JOINT=POSITION,... or a TOML file of them (default: at rest)");
  app.add_option("--package", packages, "URDF: folder of packages (repeatable)")
      ->allow_extra_args(false)
      ->take_all();
  app.add_option("--limits", limits, "robot in TOML: the name of the limits in use");
}

void ProblemOptions::add_joints(CLI::App& app, const char* what) {
  CLI::Option& list = *app.add_option(
      "--joints", joints,
      fmt::format("{} by joint positions: JOINT=POSITION,... or a TOML file of them; other joints "
                  "rest",
                  what));
  app.add_option("--posture", posture, fmt::format("{} by a named posture of the robot", what))
      ->excludes(&list);
}

void ProblemOptions::add(CLI::App& app) {
  add_robot(app);
  app.add_option("--wrench-along", wrench_along,
                 "URDF: the direction of the wrench that the robot exerts: x, y, z, rx, ry, rz, "
                 "with a sign if need be, or six numbers [force; torque] (default: z, a lift)");
  app.add_option("--wrench-frame", wrench_frame,
                 "URDF: axes of that direction, world or tool (default: world)");
  CLI::Option& pose =
      *app.add_option("--at", at,
                      "URDF: the tool's pose in the world, 'x y z / roll pitch yaw' [m; rad] "
                      "(default: that of the joints at rest, or of a posture that moves freely)");
  const bool evaluates = app.get_name() == "eval";
  add_joints(app, evaluates ? "evaluate the posture given" : "URDF: the tool's pose, given");
  for (const char* other : {"--joints", "--posture"}) pose.excludes(app.get_option(other));
}

bool ProblemOptions::describes_task() const {
  return tool || base || wrench_along || wrench_frame || at || gives_joints();
}

std::vector<NamedFile> ProblemOptions::inputs(const std::string& problem) const {
  return {{"problem", problem},
          {"--srdf", srdf.value_or("")},
          {"--joints", joints && is_file(*joints) ? *joints : ""},
          {"--rest", rest && is_file(*rest) ? *rest : ""}};
}

void ProblemOptions::reject_for_toml(const std::string& problem, bool evaluates_joints) const {
  const std::string expected = fmt::format("none: {} is not a URDF", problem);
  for (const auto& [option, value] :
       {std::pair("--tool", &tool), std::pair("--base", &base), std::pair("--srdf", &srdf),
        std::pair("--group", &group), std::pair("--rest", &rest),
        std::pair("--wrench-along", &wrench_along), std::pair("--wrench-frame", &wrench_frame),
        std::pair("--at", &at)}) {
    if (*value) reject(option, **value, expected);
  }
  if (!packages.empty()) reject("--package", packages.front(), expected);
  if (evaluates_joints) return;
  if (joints) reject("--joints", *joints, expected);
  if (posture) reject("--posture", *posture, expected);
}

UrdfOptions ProblemOptions::urdf_options() const {
  if (limits) reject("--limits", *limits, "none: a URDF has one set of limits");
  UrdfOptions options;
  options.locks_undriven = locks_undriven;
  options.tool = tool.value_or("");
  if (tool && tool->empty()) reject("--tool", "", "the name of a link");
  if (base) options.base_axes = parse_axes(*base);
  if (srdf && !is_file(*srdf)) reject("--srdf", *srdf, "an SRDF file");
  options.srdf = srdf.value_or("");
  if (group && group->empty()) reject("--group", "", "the name of a group");
  options.group = group.value_or("");
  if (rest && options.group.empty()) reject("--rest", *rest, "none without --group");
  if (rest && (rest->find('=') != std::string::npos || is_file(*rest))) {
    options.rest = parse_joints("--rest", *rest);
  } else {
    options.rest_posture = rest.value_or("");
  }
  options.posture = posture.value_or("");
  if (joints) options.positions = parse_joints("--joints", *joints);
  options.packages.assign(packages.begin(), packages.end());
  return options;
}

TaskSpec ProblemOptions::task(const std::string& problem, bool evaluates_joints) const {
  TaskSpec task;
  task.name = problem;
  task.c = parse_direction(wrench_along.value_or("z"));
  task.wrench_in_end_effector = parse_frame(wrench_frame.value_or("world"));
  if (at) {
    task.pose = parse_pose(*at);
  } else if (joints && !evaluates_joints) {
    task.posture = parse_joints("--joints", *joints);
  } else if (!posture || evaluates_joints) {
    task.posture.emplace();
  }
  return task;
}

Problem ProblemOptions::load(const std::string& problem, bool evaluates_joints) const {
  if (!is_urdf(problem)) {
    reject_for_toml(problem, evaluates_joints);
    Problem loaded = load_problem(problem, {limits.value_or("")});
    if (counts_warnings) remark_warnings(loaded.robot, *this, problem);
    return loaded;
  }
  Problem made = naming_options(*this, evaluates_joints && gives_joints(), [&] {
    return make_urdf_problem(problem, urdf_options(), task(problem, evaluates_joints));
  });
  if (!counts_warnings) return made;
  remark_warnings(made.robot, *this, problem);
  if (!at && !gives_joints()) {
    const Eigen::Vector3d p = made.pose.p, turn = rpy(made.pose.R);
    complain_at_end(fmt::format("no pose was given: the tool is at --at '{:.6g} / {:.6g}'",
                                fmt::join(p, " "), fmt::join(turn, " ")));
  }
  return made;
}

Robot ProblemOptions::load_robot(const std::string& file) const {
  if (is_urdf(file)) {
    return naming_options(*this, false, [&] { return load_urdf(file, urdf_options()); });
  }
  reject_for_toml(file, true);
  const LoadOptions options{limits.value_or("")};
  const std::vector<std::string> shipped = shipped_problems();
  const bool is_shipped = std::find(shipped.begin(), shipped.end(), file) != shipped.end();
  if (is_shipped || is_task(file)) return load_problem(file, options).robot;
  return maxwrench::load_robot(file, options);
}

Eigen::VectorXd ProblemOptions::positions(const Robot& robot, bool of_urdf) const {
  TaskSpec task;
  task.robot = robot;
  task.posture.emplace();
  if (joints) task.posture = parse_joints("--joints", *joints);
  if (joints && of_urdf) {  // joints that are locked there are no longer the robot's
    std::erase_if(*task.posture,
                  [&](const auto& each) { return find_joint(robot, each.first) < 0; });
  }
  if (posture) task.posture = named_posture(robot, "--posture", *posture);
  try {
    return joints_at_posture(task);
  } catch (const BadValue& bad) {
    reject("--joints", bad.key().substr(kJointKey.size()), bad.expected());
  }
}

}  // namespace maxwrench
