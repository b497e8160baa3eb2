#include <cmath>

#include "lib/robot/chain.h"
#include "solvers/solve/format.h"
#include "view/scene/parts.h"

namespace maxwrench {
namespace {

using nlohmann::ordered_json;

ordered_json finite(double value) { return known(std::isfinite(value), value); }

ordered_json joint_json(const Joint& joint) {
  const bool slides = joint.type == JointType::kPrismatic;
  return {{"name", joint.name},         {"unit", slides ? "m" : "rad"},
          {"parent", joint.parent},     {"origin", array(joint.placement.p)},
          {"axis", array(joint.axis)},  {"min", finite(joint.q_min)},
          {"max", finite(joint.q_max)}, {"rate", finite(joint.velocity_max)}};
}

ordered_json actuator_json(const Robot& robot, Eigen::Index i) {
  return {{"name", actuator_name(robot, i)},
          {"unit", actuator_unit(robot, i)},
          {"min", finite(robot.actuation.u_min[i])},
          {"max", finite(robot.actuation.u_max[i])},
          {"rate", finite(robot.u_rate_max[i])}};
}

}  // namespace

ordered_json matrix_json(const Pose<double>& pose) {
  ordered_json list = ordered_json::array();
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index column = 0; column < 3; ++column) list.push_back(pose.R(row, column));
    list.push_back(pose.p[row]);
  }
  return list;
}

ordered_json robot_json(const Robot& robot, const std::vector<Visual>& visuals) {
  ordered_json links, joints = ordered_json::array(), thrusters = ordered_json::array(),
                      actuators = ordered_json::array(), tools = ordered_json::array();
  const ordered_json bodies = bodies_json(robot, visuals);
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    links.push_back({{"name", robot.links[i].name}, {"bodies", bodies[i]}});
  }
  for (const Joint& joint : robot.joints) joints.push_back(joint_json(joint));
  for (const Thruster& thruster : robot.thrusters) {
    thrusters.push_back({{"name", thruster.name},
                         {"position", array(thruster.position)},
                         {"direction", array(thruster.direction)}});
  }
  for (Eigen::Index i = 0; i < robot.actuators(); ++i) {
    actuators.push_back(actuator_json(robot, i));
  }
  for (const EndEffector& e : robot.end_effectors) {
    tools.push_back({{"name", e.name}, {"link", e.link}, {"placement", matrix_json(e.placement)}});
  }
  return {{"name", robot.name},
          {"water", robot.water_density > 0},
          {"free_axes", robot.base_axes.size()},
          {"links", links},
          {"joints", joints},
          {"thrusters", thrusters},
          {"actuators", actuators},
          {"end_effectors", tools}};
}

}  // namespace maxwrench
