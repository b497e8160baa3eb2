#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/cli.h"
#include "cli/output.h"
#include "cli/task/problem_options.h"
#include "cli/task/state.h"
#include "lib/robot/kinematics.h"
#include "maxwrench/version.h"
#include "problems/make/bad_value.h"
#include "problems/make/contact.h"
#include "solvers/solve/format.h"

namespace maxwrench {
namespace {

using nlohmann::ordered_json;

struct PoseOptions {
  std::string file;
  ProblemOptions source;
  bool jacobian = false, json = false;
};

/// Where a part of the robot is in the world.
struct Place {
  std::string name;
  Pose<double> pose;
  Matrix6Xd J;  ///< empty unless it is requested
};

struct Places {
  std::vector<Place> end_effectors, links;
};

Places find_places(const Robot& robot, const Eigen::VectorXd& q, bool with_jacobian) {
  Kinematics<double> kinematics(robot);
  kinematics.set_joints(q);
  Places places;
  for (const EndEffector& tip : robot.end_effectors) {
    Place place{tip.name, robot.mount * kinematics.end_effector(tip), {}};
    if (with_jacobian) {
      place.J.resize(6, robot.velocities());
      kinematics.jacobian(tip, robot.mount.R, place.J);
    }
    places.end_effectors.push_back(std::move(place));
  }
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    places.links.push_back({robot.links[i].name, robot.mount * kinematics.links()[i], {}});
  }
  return places;
}

void print_place(const char* kind, const Place& place) {
  fmt::print("{:<13} {:<24}{} {}\n", kind, place.name, line(place.pose.p), line(rpy(place.pose.R)));
}

void print_places(const Robot& robot, const Places& places) {
  fmt::print("{}  poses in the world: x y z [m], roll pitch yaw [rad]\n", robot.name);
  for (const Place& place : places.end_effectors) {
    print_place("end effector", place);
    if (place.J.cols() == 0) continue;
    fmt::print("  J by rows [x y z roll pitch yaw], columns {}\n",
               fmt::join(velocity_names(robot), " "));
    for (Eigen::Index i = 0; i < 6; ++i) fmt::print("  {}\n", line(place.J.row(i).transpose()));
  }
  for (const Place& place : places.links) print_place("link", place);
}

void print_places_object(const Robot& robot, const Eigen::VectorXd& q, const Places& places) {
  ordered_json object = {{"robot", robot.name}};
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    object["joints"][robot.joints[i].name] = q[static_cast<Eigen::Index>(i)];
  }
  object["velocities"] = velocity_names(robot);
  for (const Place& place : places.end_effectors) {
    ordered_json& entry = object["end_effectors"][place.name] = to_json(place.pose);
    if (place.J.cols() > 0) entry["J"] = rows(place.J);
  }
  for (const Place& place : places.links) object["links"][place.name] = to_json(place.pose);
  object["version"] = version();
  print_json(object);
}

/// The robot with the end effector that --tool names only.
Robot load_posed_robot(const PoseOptions& options) {
  if (is_urdf(options.file)) return options.source.load_robot(options.file);
  ProblemOptions source = options.source;
  const std::optional<std::string> tool = std::exchange(source.tool, {});
  Robot robot = source.load_robot(options.file);
  if (tool) {
    const int chosen = find_end_effector("--tool", *tool, robot);
    robot.end_effectors = {robot.end_effectors[static_cast<std::size_t>(chosen)]};
  }
  return robot;
}

void pose(const PoseOptions& options) {
  const Robot robot = load_posed_robot(options);
  const Eigen::VectorXd q = options.source.positions(robot, is_urdf(options.file));
  const Places places = find_places(robot, q, options.jacobian);
  if (options.json) {
    print_places_object(robot, q, places);
  } else {
    print_places(robot, places);
  }
}

}  // namespace

void add_pose(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<PoseOptions>();
  options->source.locks_undriven = false;  // positions need no efforts
  CLI::App& command = *app.add_subcommand(
      "pose", "prints where end effectors and links are, with the base at its mount");
  command.add_option("robot", options->file, "robot or task file, a shipped task, or a URDF")
      ->required();
  options->source.add_joints(command, "the posture, given");
  options->source.add_robot(command);
  command.get_option("--tool")->description(
      "the only end effector to print: its name, or a link of a URDF");
  command.add_flag("--jacobian", options->jacobian,
                   "print J, 6 rows, of each end effector in world axes");
  command.add_flag("--json", options->json, "print one JSON object");
  command.callback([options, &exit_status] {
    pose(*options);
    exit_status = kAnswered;
  });
}

}  // namespace maxwrench
