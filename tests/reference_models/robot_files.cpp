#include "tests/reference_models/robot_files.h"

#include <tinyxml2.h>
#include <toml++/toml.h>

#include <map>
#include <sstream>
#include <stdexcept>

namespace maxwrench::reference {
namespace {

Eigen::Vector3d three(const tinyxml2::XMLElement* element, const char* attribute,
                      Eigen::Vector3d value) {
  const char* text = element ? element->Attribute(attribute) : nullptr;
  if (!text) return value;
  std::istringstream in(text);
  in >> value[0] >> value[1] >> value[2];
  return value;
}

double number(const tinyxml2::XMLElement* element, const char* attribute) {
  double value = 0;
  if (element) element->QueryDoubleAttribute(attribute, &value);
  return value;
}

Eigen::VectorXd numbers(const toml::node_view<const toml::node>& node, int size) {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(size);
  for (int i = 0; node && i < size; ++i) values[i] = node[i].value<double>().value();
  return values;
}

Body read_link(const tinyxml2::XMLElement* link) {
  Body body;
  body.name = link->Attribute("name");
  const tinyxml2::XMLElement* inertial = link->FirstChildElement("inertial");
  if (!inertial) return body;
  const tinyxml2::XMLElement* origin = inertial->FirstChildElement("origin");
  if (!three(origin, "rpy", Eigen::Vector3d::Zero()).isZero()) {
    throw std::runtime_error(body.name + ": turned inertia");
  }
  body.com = three(origin, "xyz", Eigen::Vector3d::Zero());
  body.mass = number(inertial->FirstChildElement("mass"), "value");
  const tinyxml2::XMLElement* I = inertial->FirstChildElement("inertia");
  const double xy = number(I, "ixy"), xz = number(I, "ixz"), yz = number(I, "iyz");
  body.inertia << number(I, "ixx"), xy, xz, xy, number(I, "iyy"), yz, xz, yz, number(I, "izz");
  return body;
}

/// The joints in the order of the file, whose parents come before their children.
std::vector<Body> read_urdf(const std::filesystem::path& file, std::vector<std::string>& joints) {
  tinyxml2::XMLDocument document;
  if (document.LoadFile(file.c_str()) != tinyxml2::XML_SUCCESS)
    throw std::runtime_error("cannot read " + file.string());
  const tinyxml2::XMLElement* robot = document.RootElement();
  std::map<std::string, Body> links;
  const auto* link = robot->FirstChildElement("link");
  const std::string root = link->Attribute("name");
  for (; link; link = link->NextSiblingElement("link")) {
    links[link->Attribute("name")] = read_link(link);
  }
  std::vector<Body> bodies = {links.at(root)};
  std::map<std::string, int> place = {{root, 0}};
  for (const auto* joint = robot->FirstChildElement("joint"); joint;
       joint = joint->NextSiblingElement("joint")) {
    Body body = links.at(joint->FirstChildElement("child")->Attribute("link"));
    const std::string type = joint->Attribute("type");
    body.joint = joint->Attribute("name");
    body.parent = place.at(joint->FirstChildElement("parent")->Attribute("link"));
    body.xyz = three(joint->FirstChildElement("origin"), "xyz", body.xyz);
    body.rpy = three(joint->FirstChildElement("origin"), "rpy", body.rpy);
    body.axis = three(joint->FirstChildElement("axis"), "xyz", body.axis).normalized();
    body.effort = number(joint->FirstChildElement("limit"), "effort");
    body.slides = type == "prismatic";
    if (type != "fixed") {
      body.coordinate = static_cast<int>(joints.size());
      joints.push_back(body.joint);
    }
    place[body.name] = static_cast<int>(bodies.size());
    bodies.push_back(body);
  }
  if (bodies.size() != links.size()) throw std::runtime_error(file.string() + ": not a tree");
  return bodies;
}

void read_water(const toml::table& table, Body& body) {
  const auto buoyancy = table["buoyancy"][body.name];
  body.volume = buoyancy["volume"].value_or(0.0);
  body.cob = numbers(buoyancy["cob"], 3);
  const auto water = table["hydrodynamics"][body.name];
  body.center = numbers(water["center"], 3);
  body.added_mass = numbers(water["added_mass"], 6);
  body.damping_linear = numbers(water["damping_linear"], 6);
  body.damping_quadratic = numbers(water["damping_quadratic"], 6);
}

/// A thruster pushes along its direction at its place, a joint turns itself.
void read_actuators(const toml::table& table, Files& files) {
  const toml::array* list = table["thrusters"]["list"].as_array();
  const int thrusters = list ? static_cast<int>(list->size()) : 0;
  const int joints = static_cast<int>(files.joints.size());
  files.B.setZero(6 + joints, thrusters + joints);
  files.u_min.resize(thrusters + joints);
  files.u_max.resize(thrusters + joints);
  for (int i = 0; i < thrusters; ++i) {
    const toml::node_view<const toml::node> thruster(list->get(i));
    const Eigen::Vector3d place = numbers(thruster["position"], 3);
    const Eigen::Vector3d direction = numbers(thruster["direction"], 3);
    files.B.col(i).head<3>() = direction / direction.norm();
    files.B.col(i).segment<3>(3) = place.cross(direction) / direction.norm();
    const auto limit = [&](const char* key) {
      const auto common = table["thrusters"][key].value<double>();
      return thruster[key].value<double>().value_or(common.value_or(NAN));
    };
    files.u_min[i] = limit("force_min");
    files.u_max[i] = limit("force_max");
  }
  for (const Body& body : files.bodies) {
    if (body.coordinate < 0) continue;
    files.B(6 + body.coordinate, thrusters + body.coordinate) = 1;
    files.u_max[thrusters + body.coordinate] = body.effort;
    files.u_min[thrusters + body.coordinate] = -body.effort;
  }
}

}  // namespace

Files read_robot(const std::filesystem::path& file) {
  const toml::table table = toml::parse_file(file.string());
  Files files;
  files.bodies =
      read_urdf(file.parent_path() / table["urdf"].value<std::string>().value(), files.joints);
  for (Body& body : files.bodies) read_water(table, body);
  const char* names[] = {"x", "y", "z", "roll", "pitch", "yaw"};
  for (const toml::node& axis : *table["base"]["axes"].as_array()) {
    for (int i = 0; i < 6; ++i) {
      if (axis.value<std::string>() == names[i]) files.axes.push_back(i);
    }
  }
  files.gravity = table["environment"]["gravity"].value<double>().value();
  files.density = table["environment"]["water_density"].value_or(0.0);
  files.trim_mass = table["trim"]["buoyancy_mass"].value_or(0.0);
  files.trim_place = numbers(table["trim"]["position"], 3);
  for (const auto& [name, node] : *table["end_effectors"].as_table()) {
    const toml::node_view<const toml::node> tool(node);
    if (!tool["link"]) continue;
    for (std::size_t i = 0; i < files.bodies.size(); ++i) {
      if (tool["link"].value<std::string>() != files.bodies[i].name) continue;
      files.tools.push_back({std::string(name.str()), static_cast<int>(i), numbers(tool["xyz"], 3),
                             numbers(tool["rpy"], 3)});
    }
  }
  read_actuators(table, files);
  return files;
}

}  // namespace maxwrench::reference
