#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "benchmarks/tables/write_file.h"
#include "cli/cli.h"
#include "cli/task/problem_options.h"
#include "lib/robot/chain.h"
#include "lib/robot/gears.h"
#include "maxwrench/posture.h"
#include "problems/make/bad_value.h"
#include "problems/make/posture.h"
#include "solvers/solve/format.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;

struct InitOptions {
  std::string urdf, out;
  ProblemOptions source;
};

/// A text as TOML writes it.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

std::vector<std::string> quoted(const std::vector<std::string>& texts) {
  std::vector<std::string> result;
  for (const std::string& text : texts) result.push_back(quoted(text));
  return result;
}

std::string list_of(const Eigen::VectorXd& numbers) {
  return fmt::format("[{}]", fmt::join(numbers, ", "));
}

/// The path of a file as a file in `folder` names it.
std::string seen_from(const fs::path& folder, const fs::path& file) {
  const fs::path relative = fs::relative(fs::absolute(file), fs::absolute(folder));
  return quoted(relative.empty() ? fs::absolute(file).string() : relative.string());
}

constexpr const char* kRobotHead =
    R"(# A robot for maxwrench. 'maxwrench check {0}' prints what this file and its URDF contain.
# Units are SI, angles in rad. Text behind '# ' explains. Lines with '#' and no blank are examples:
# remove the '#' of all lines of an example to use it.

name = {1}
# The links, joints, masses, limits and shapes. The path is relative to this file.
urdf = {2}
)";

constexpr const char* kBase = R"(
# The base is fixed, at the origin of the world. This places it elsewhere:
#[base]
#axes = []
#xyz = [0, 0, 0]
#rpy = [0, 0, 0]

# A base that is parked: it may stand anywhere along these axes, and its brakes hold any load.
#[base]
#axes = ["x", "y", "yaw"]
#parked = true

# A base on wheels, whose forces are limited by the motors (force, N) and by friction (mu times the
# load in N that the wheel carries). kind is mecanum, omni or plain; heading [rad] is the rolling
# direction, roller [rad] the axis of the roller on the ground from there. Positions are in base axes.
#[base]
#axes = ["x", "y", "yaw"]
#[wheels]
#kind = "mecanum"
#force = 100
#mu = 0.6
#load = 250
#[[wheels.list]]
#name = "front_left"
#position = [0.25, 0.25, 0]
#roller = -0.785
#[[wheels.list]]
#name = "front_right"
#position = [0.25, -0.25, 0]
#roller = 0.785
#[[wheels.list]]
#name = "rear_left"
#position = [-0.25, 0.25, 0]
#roller = 0.785
#[[wheels.list]]
#name = "rear_right"
#position = [-0.25, -0.25, 0]
#roller = -0.785

# A vehicle in water. Thrusters push along `direction` at `position`, in base axes. For each link in
# the water: the displaced volume [m^3] with its centre, added mass and drag.
#[base]
#axes = ["x", "y", "z", "roll", "pitch", "yaw"]
#[environment]
#gravity = 9.81
#water_density = 1000
#[thrusters]
#force_min = -40
#force_max = 50
#force_rate_max = 50
#[[thrusters.list]]
#name = "surge_left"
#position = [0, 0.2, 0]
#direction = [1, 0, 0]
#[[thrusters.list]]
#name = "surge_right"
#position = [0, -0.2, 0]
#direction = [1, 0, 0]
#[[thrusters.list]]
#name = "sway"
#position = [0, 0, 0.1]
#direction = [0, 1, 0]
#[[thrusters.list]]
#name = "heave_front_left"
#position = [0.2, 0.2, 0]
#direction = [0, 0, 1]
#[[thrusters.list]]
#name = "heave_front_right"
#position = [0.2, -0.2, 0]
#direction = [0, 0, 1]
#[[thrusters.list]]
#name = "heave_rear"
#position = [-0.2, 0, 0]
#direction = [0, 0, 1]
#[buoyancy.{0}]
#volume = 0.01
#cob = [0, 0, 0]
#[hydrodynamics.{0}]
#added_mass = [5, 10, 15, 0.1, 0.1, 0.1]
#damping_linear = [4, 6, 5, 0.1, 0.1, 0.1]
#damping_quadratic = [20, 20, 40, 1, 1, 1]
#[trim]
#buoyancy_mass = 0.1
#position = [0, 0, 0]
)";

/// What counts more than the URDF, for one joint and one link.
constexpr const char* kOverrides = R"(
# What counts more than the URDF: limits of a joint, masses of a link, limits that a name chooses.
#[joints.{0}]
#effort = {2}
#velocity = 1

#[links.{1}]
#mass = 1.5
#com = [0, 0, 0]

# `--limits peak` uses these efforts. A number for all thrusters has the name thrusters.
#[limits.peak]
#{0} = {2}

# A named posture, for `--posture`.
#[states.ready]
#{0} = {3}

# Bodies that are closer than the margin [m] collide. Meshes count as "hull", as "capsules", or not, "ignore".
#[collision]
#margin = 0.001
#meshes = "hull"
)";

std::string robot_text(const InitOptions& options, const Robot& robot, const fs::path& folder) {
  std::string text =
      fmt::format(kRobotHead, "robot.toml", quoted(robot.name), seen_from(folder, options.urdf));
  text += "# Collision pairs to leave out and named postures: srdf = \"FILE.srdf\"\n";
  if (options.source.srdf) {
    text += fmt::format("srdf = {}\n", seen_from(folder, *options.source.srdf));
  }
  text +=
      "# The group of the SRDF whose joints move, and the named posture in which the others are\n"
      "# locked: group = \"NAME\", group_rest = \"POSTURE\"\n";
  if (options.source.group) text += fmt::format("group = {}\n", quoted(*options.source.group));
  text += "# Folders, relative to this file, in which package:// is searched first.\n";
  std::vector<std::string> packages;
  for (const std::string& package : options.source.packages) {
    packages.push_back(seen_from(folder, package));
  }
  text += packages.empty() ? "#packages = [\".\"]\n"
                           : fmt::format("packages = [{}]\n", fmt::join(packages, ", "));
  text += fmt::format(kBase, quoted(robot.links.front().name));
  text += "\n# The end effectors: a frame at xyz, rpy in axes of a link.\n";
  for (const EndEffector& tip : robot.end_effectors) {
    text += fmt::format("[end_effectors.{0}]\nlink = {0}\nxyz = [0, 0, 0]\nrpy = [0, 0, 0]\n\n",
                        quoted(tip.name));
  }
  text.pop_back();
  const Joint& joint = robot.joints.front();
  return text + fmt::format(kOverrides, quoted(joint.name), quoted(robot.links[1].name),
                            joint.effort_max, (joint.q_min + joint.q_max) / 2);
}

std::string pose_text(const Problem& task) {
  return fmt::format(
      "# The end effector's frame in the world [m; rad]. This pose was chosen because it is "
      "reached.\n"
      "# In place of xyz and rpy, joints = {{ JOINT = POSITION, ... }} or state = NAME gives it.\n"
      "[pose]\nxyz = {}\nrpy = {}\n",
      list_of(task.pose.p), list_of(rpy(task.pose.R)));
}

/// An end effector that moves in fewer than six ways reaches no pose that was rounded.
std::string joints_text(const Problem& task) {
  const Posture posture = PostureEvaluator(task).evaluate(task.theta_r_default);
  std::vector<std::string> joints;
  for (const int i : motors_to(task.robot, task.end_effector)) {
    joints.push_back(fmt::format(
        "{} = {:.6g}", quoted(task.robot.joints[static_cast<std::size_t>(i)].name), posture.q[i]));
  }
  return fmt::format(
      "# The end effector is where these joints have it; all others rest [rad or m]. It moves in "
      "{} "
      "ways\n# only, so xyz and rpy of the world would have to be exact.\n"
      "[pose]\njoints = {{ {} }}\n",
      motions_of(task.robot, task.end_effector), fmt::join(joints, ", "));
}

std::string task_text(const Problem& task) {
  std::string text = fmt::format(
      "# A static task for maxwrench: hold a pose and push as strongly as possible.\n"
      "# 'maxwrench check task.toml' prints it, 'maxwrench solve task.toml' finds the best "
      "posture.\n"
      "\ntype = \"static\"\nrobot = \"robot.toml\"\nend_effector = {}\n"
      "# How far to trust the numbers, and where they come from: free texts.\n"
      "label = \"to be checked\"\nsource = \"written by maxwrench init\"\n\n",
      quoted(task.robot.end_effectors[static_cast<std::size_t>(task.end_effector)].name));
  const bool moves_freely = motions_of(task.robot, task.end_effector) == 6;
  text += moves_freely ? pose_text(task) : joints_text(task);
  if (moves_freely) {
    text += "# The axes of the pose that may turn, x y z roll pitch yaw.\n#free = [\"yaw\"]\n";
  }
  int axis = 0;
  task.c.cwiseAbs().maxCoeff(&axis);
  text += fmt::format(
      "\n# The direction [force; torque] of what the robot exerts, in world axes. +z lifts.\n"
      "[wrench]\nc = {}\n"
      "# The components that '--wrench any' leaves free.\n#any = [\"{}\"]\n"
      "# c turns with the end effector.\n#frame = \"end_effector\"\n",
      list_of(task.c), kWrenchAxes[static_cast<std::size_t>(axis)]);
  text +=
      "\n# The joints in theta_r, the others follow from it. Without this table the program\n"
      "# chooses: 'maxwrench check' says which and why.\n";
  if (task.redundant.empty() || task.dependent.empty()) return text;
  std::vector<std::string> names;
  for (int i = 0; i < task.redundancy(); ++i) names.push_back(task.theta_r_name(i));
  return text + fmt::format("#[theta_r]\n#joints = [{}]\n#default = {}\n",
                            fmt::join(quoted(names), ", "), list_of(task.theta_r_default));
}

/// The task of the first end effector, and along the first axis, that can be a task.
Problem first_task(const Robot& robot) {
  TaskSpec spec;
  spec.name = "task";
  spec.robot = robot;
  std::exception_ptr why;
  for (const EndEffector& tip : robot.end_effectors) {
    spec.end_effector = tip.name;
    for (const int axis : {2, 0, 1, 5, 3, 4}) {
      spec.c = Vector6d::Unit(axis);
      try {
        return make_at_good_posture(spec);
      } catch (const BadValue& bad) {
        if (!why) why = std::current_exception();
        if (bad.key() != "wrench.c") break;  // another axis does not help
      }
    }
  }
  std::rethrow_exception(why);
}

void init(const InitOptions& options) {
  if (!is_urdf(options.urdf)) {
    throw std::invalid_argument("urdf: got '" + options.urdf + "', expected a URDF file");
  }
  const fs::path folder =
      options.out.empty() ? fs::path(options.urdf).parent_path() : fs::path(options.out);
  const fs::path robot_file = folder / "robot.toml", task_file = folder / "task.toml";
  for (const fs::path& file : {robot_file, task_file}) {
    if (!fs::exists(fs::symlink_status(file))) continue;
    throw std::invalid_argument(
        fmt::format("--out: got '{}', which exists, expected a folder without it", file.string()));
  }
  const Robot robot = options.source.load_robot(options.urdf);
  if (robot.joints.empty() || robot.end_effectors.empty()) {
    throw std::invalid_argument(options.urdf + ": got no joint that moves, expected some");
  }
  const Problem task = first_task(robot);
  const fs::path here = folder.empty() ? fs::path(".") : folder;
  write_file(robot_file, robot_text(options, robot, here));
  write_file(task_file, task_text(task));
  fmt::print("{}\n{}\n", robot_file.string(), task_file.string());
}

}  // namespace

void add_init(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<InitOptions>();
  CLI::App& command =
      *app.add_subcommand("init", "writes robot.toml and task.toml to start from, for a URDF");
  command.add_option("urdf", options->urdf, "URDF or xacro file")->required();
  command.add_option("--out", options->out, "folder for the files (default: that of the URDF)")
      ->check(reject_empty);
  command.add_option("--tool", options->source.tool,
                     "the link that is the end effector (default: all links at the ends)");
  command.add_option("--srdf", options->source.srdf, "SRDF file that robot.toml names");
  command.add_option("--group", options->source.group,
                     "the group of the SRDF whose joints move; the others are locked");
  command
      .add_option("--package", options->source.packages,
                  "folder of packages that robot.toml names (repeatable)")
      ->allow_extra_args(false)
      ->take_all();
  command.callback([options, &exit_status] {
    init(*options);
    exit_status = kAnswered;
  });
}

}  // namespace maxwrench
