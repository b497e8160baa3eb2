#include <fmt/format.h>

#include <array>
#include <optional>

#include "solvers/solve/format.h"
#include "view/scene/parts.h"

namespace maxwrench {
namespace {

using nlohmann::ordered_json;

constexpr double kBarRadius = 0.012;   ///< of a bare link, as a share of the robot's reach
constexpr double kShellRadius = 0.03;  ///< of a bare base, likewise

std::vector<ordered_json> bodies_of(const ConvexBody& body) {
  Eigen::MatrixXd points(3, static_cast<Eigen::Index>(body.points.size()));
  for (std::size_t i = 0; i < body.points.size(); ++i) {
    points.col(static_cast<Eigen::Index>(i)) = body.points[i];
  }
  ordered_json hull;
  hull["kind"] = "hull";
  hull["points"] = drawn_columns(points);
  hull["radius"] = drawn(body.radius);
  return std::vector<ordered_json>(1, hull);
}

/// The bodies of a visual: a mesh has one for each colour.
std::vector<ordered_json> bodies_of(const Visual& visual) {
  static constexpr std::array kKinds = {"box", "cylinder", "sphere", "mesh"};
  std::vector<ordered_json> bodies;
  if (visual.kind == Visual::Kind::kMesh) {
    bodies = mesh_json(visual);
  } else {
    bodies.emplace_back()["size"] = drawn_columns(visual.size);
  }
  for (ordered_json& body : bodies) {
    body["kind"] = kKinds[static_cast<std::size_t>(visual.kind)];
    body["pose"] = matrix_json(visual.placement);
    if (!visual.colour) continue;
    const auto& [red, green, blue, opacity] = *visual.colour;
    if (!body.contains("colour")) body["colour"] = {red, green, blue};
    body["opacity"] = opacity;
  }
  return bodies;
}

/// The sum of the distances from joint to joint and to the end effectors.
double reach_of(const Robot& robot) {
  double reach = 0;
  for (const Joint& joint : robot.joints) reach += joint.placement.p.norm();
  for (const EndEffector& e : robot.end_effectors) reach += e.placement.p.norm();
  return reach;
}

/// The places on a link where its joints and end effectors are.
std::vector<Eigen::Vector3d> places_on(const Robot& robot, int link) {
  std::vector<Eigen::Vector3d> places;
  for (const Joint& joint : robot.joints) {
    if (joint.parent == link) places.push_back(joint.placement.p);
  }
  for (const EndEffector& e : robot.end_effectors) {
    if (e.link == link) places.push_back(e.placement.p);
  }
  return places;
}

std::vector<ConvexBody> bare_bodies(const Robot& robot, int link) {
  const double reach = reach_of(robot);
  std::vector<Eigen::Vector3d> places = places_on(robot, link);
  if (link == 0 && !robot.thrusters.empty()) {
    for (const Thruster& thruster : robot.thrusters) places.push_back(thruster.position);
    return {{link, places, kShellRadius * reach}};
  }
  std::vector<ConvexBody> bars;
  for (const Eigen::Vector3d& place : places) {
    if (place.norm() == 0) continue;
    bars.push_back({link, {Eigen::Vector3d::Zero(), place}, kBarRadius * reach});
  }
  return bars;
}

}  // namespace

double drawn(double value) { return std::stod(fmt::format("{:.6g}", value)); }

ordered_json drawn_columns(const Eigen::MatrixXd& columns) {
  ordered_json list = ordered_json::array();
  for (const double value : columns.reshaped()) list.push_back(drawn(value));
  return list;
}

ordered_json bodies_json(const Robot& robot, const std::vector<Visual>& visuals) {
  std::vector<ordered_json> bodies(robot.links.size(), ordered_json::array());
  const auto add = [&bodies](const auto& body) {
    for (const ordered_json& json : bodies_of(body)) {
      bodies[static_cast<std::size_t>(body.link)].push_back(json);
    }
  };
  for (const Visual& visual : visuals) add(visual);
  const std::vector<ordered_json> visible = bodies;
  for (const ConvexBody& body : robot.convex_bodies) {
    if (visible[static_cast<std::size_t>(body.link)].empty()) add(body);
  }
  for (std::size_t link = 0; link < bodies.size(); ++link) {
    if (!bodies[link].empty()) continue;
    for (const ConvexBody& body : bare_bodies(robot, static_cast<int>(link))) add(body);
  }
  return bodies;
}

}  // namespace maxwrench
