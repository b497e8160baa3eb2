#include "problems/loader/urdf_tree.h"

#include <fmt/format.h>

#include <numbers>

#include "problems/loader/bad_input.h"
#include "problems/loader/urdf_structure.h"
#include "problems/make/robot.h"

namespace maxwrench {
namespace {

/// The pose in `origin`. The rotation is computed from a quaternion of half angles.
Pose<double> origin_of(const UrdfElement& element) {
  const std::optional<UrdfElement> origin = element.child_if_any("origin");
  if (!origin) return {};
  const Eigen::Vector3d half = origin->vector("rpy", Eigen::Vector3d::Zero()) / 2;
  const Eigen::Array3d c = half.array().cos(), s = half.array().sin();
  const Eigen::Quaterniond q(
      c[0] * c[1] * c[2] + s[0] * s[1] * s[2], s[0] * c[1] * c[2] - c[0] * s[1] * s[2],
      c[0] * s[1] * c[2] + s[0] * c[1] * s[2], c[0] * c[1] * s[2] - s[0] * s[1] * c[2]);
  return {q.normalized().toRotationMatrix(), origin->vector("xyz", Eigen::Vector3d::Zero())};
}

/// The state while one file is flattened.
struct Reading {
  const UrdfStructure& structure;
  UrdfTree tree;
};

Eigen::Matrix3d inertia_of(const UrdfElement& given) {
  const auto value = [&](const char* name) { return given.number(name); };
  const double xy = value("ixy"), xz = value("ixz"), yz = value("iyz");
  Eigen::Matrix3d inertia;
  inertia << value("ixx"), xy, xz, xy, value("iyy"), yz, xz, yz, value("izz");
  return inertia;
}

/// Adds a body to the link that carries it.
void add_inertial(Link& carrier, const std::string& name, const UrdfElement& inertial,
                  const Pose<double>& body) {
  const Pose<double> frame = body * origin_of(inertial);
  const double mass = inertial.child("mass").number("value");
  const Eigen::Matrix3d inertia = inertia_of(inertial.child("inertia"));
  require_body(name, mass, inertia);
  if (mass > 0) add_body(carrier, mass, frame.p, frame.R * inertia * frame.R.transpose());
}

Shape shape_of(const UrdfElement& collision) {
  const char* expected =
      "one box, cylinder or sphere, or no <collision> here and capsules in the robot's TOML";
  const UrdfElement geometry = collision.child("geometry");
  const std::vector<UrdfElement> shapes = geometry.children();
  if (shapes.empty()) geometry.throw_bad_input("", "nothing", expected);
  const UrdfElement& given = shapes[0];
  const std::string tag = given.tag();
  const bool round = tag == "cylinder" || tag == "sphere";
  if (!round && tag != "box") geometry.throw_bad_input("", fmt::format("<{}>", tag), expected);
  if (shapes.size() > 1) {
    geometry.throw_bad_input("", fmt::format("<{}> and <{}>", tag, shapes[1].tag()), expected);
  }
  Shape shape;
  if (round) shape.radius = given.number("radius");
  if (tag == "box") {
    shape.kind = Shape::Kind::kBox;
    shape.half_sizes = given.vector("size") / 2;
  } else if (tag == "cylinder") {
    shape.kind = Shape::Kind::kCylinder;
    shape.half_length = given.number("length") / 2;
  }
  return shape;
}

void add_link(Reading& reading, const UrdfElement& link, const Body& body) {
  const std::string name = name_of(link);
  reading.tree.bodies.emplace(name, body);
  if (const auto inertial = link.child_if_any("inertial")) {
    add_inertial(reading.tree.links[static_cast<std::size_t>(body.link)], name, *inertial,
                 body.placement);
  }
  for (const UrdfElement& collision : link.children("collision")) {
    Shape shape = shape_of(collision);
    shape.body = name;
    shape.link = body.link;
    shape.placement = body.placement * origin_of(collision);
    reading.tree.shapes.push_back(std::move(shape));
  }
}

void set_limits(const UrdfElement& from, bool continuous, Joint& joint) {
  const std::optional<UrdfElement> limit = from.child_if_any("limit");
  if (!limit) from.throw_bad_input("limit", "nothing", "effort and velocity");
  joint.effort_max = limit->number("effort");
  joint.velocity_max = limit->number("velocity");
  joint.q_min = continuous ? -std::numbers::pi : limit->number("lower", 0);
  joint.q_max = continuous ? std::numbers::pi : limit->number("upper", 0);
}

/// A joint that is not fixed.
Joint joint_of(const UrdfElement& from, const std::string& type, const Body& parent) {
  Joint joint;
  joint.name = name_of(from);
  joint.parent = parent.link;
  joint.type = type == "prismatic" ? JointType::kPrismatic : JointType::kRevolute;
  if (type != "revolute" && type != "continuous" && type != "prismatic") {
    const bool of_base = type == "floating" || type == "planar";
    from.throw_bad_input(
        "type", of_base ? type : fmt::format("'{}'", type),
        fmt::format("revolute, continuous, prismatic or fixed{}",
                    of_base ? " (the base moves by base.axes in the robot's TOML)" : ""));
  }
  joint.placement = parent.placement * origin_of(from);
  const std::optional<UrdfElement> axis = from.child_if_any("axis");
  joint.axis = axis ? axis->vector("xyz") : Eigen::Vector3d::UnitX();
  set_limits(from, type == "continuous", joint);
  if (const auto mimic = from.child_if_any("mimic")) {
    from.throw_bad_input("mimic", fmt::format("'{}'", mimic->attribute("joint").value_or("")),
                         "an independent joint");
  }
  return joint;
}

void visit(Reading& reading, const std::string& name, const Body& body) {
  add_link(reading, reading.structure.links.at(name), body);
  const auto joints = reading.structure.joints_from.find(name);
  if (joints == reading.structure.joints_from.end()) return;
  for (const UrdfElement& joint : joints->second) {
    const std::string child = end_of(joint, "child");
    const std::optional<std::string> type = joint.attribute("type");
    if (!type) joint.throw_bad_input("type", "nothing", "revolute, continuous, prismatic or fixed");
    Body moved;
    if (*type == "fixed") {
      moved = {body.link, body.placement * origin_of(joint)};
    } else {
      reading.tree.joints.push_back(joint_of(joint, *type, body));
      reading.tree.links.push_back(Link{.name = child});
      moved.link = static_cast<int>(reading.tree.joints.size());
    }
    visit(reading, child, moved);
  }
}

}  // namespace

Pose<double> pose_from_xyz_rpy(const Eigen::Vector3d& xyz, const Eigen::Vector3d& rpy) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  const Eigen::Matrix3d R =
      (AngleAxisd(rpy.z(), Vector3d::UnitZ()) * AngleAxisd(rpy.y(), Vector3d::UnitY()) *
       AngleAxisd(rpy.x(), Vector3d::UnitX()))
          .toRotationMatrix();
  return {R, xyz};
}

UrdfTree read_urdf(const std::filesystem::path& file) {
  tinyxml2::XMLDocument document;
  const UrdfStructure structure = read_structure(file, document);
  Reading reading{structure, {}};
  reading.tree.root = structure.root;
  reading.tree.links.push_back(Link{.name = structure.root});
  visit(reading, structure.root, Body{});
  return std::move(reading.tree);
}

}  // namespace maxwrench
