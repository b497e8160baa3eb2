#include "problems/loader/urdf_tree.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "problems/loader/bad_input.h"
#include "problems/loader/urdf_structure.h"

namespace maxwrench {
namespace {

/// Where `origin` puts it; the rotation by way of a quaternion of half angles.
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

/// One file being flattened.
struct Reading {
  const UrdfStructure& structure;
  UrdfTree tree;
};

/// In increasing order.
Eigen::Vector3d principal_moments(const Eigen::Matrix3d& inertia) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

std::string show_moments(const Eigen::Vector3d& moments) {
  return fmt::format("principal moments {:.6g}, {:.6g}, {:.6g}", moments[0], moments[1],
                     moments[2]);
}

Eigen::Matrix3d inertia_of(const UrdfElement& given) {
  const auto value = [&](const char* name) { return given.number(name); };
  const double xy = value("ixy"), xz = value("ixz"), yz = value("iyz");
  Eigen::Matrix3d inertia;
  inertia << value("ixx"), xy, xz, xy, value("iyy"), yz, xz, yz, value("izz");
  return inertia;
}

/// Adds a body to the link that carries it. A mass point, a thin rod and a frame without mass are
/// fine as long as they are a part.
void add_inertial(Link& carrier, const UrdfElement& inertial, const Pose<double>& body) {
  const Pose<double> frame = body * origin_of(inertial);
  const double mass = inertial.child("mass").number("value");
  if (!(mass >= 0)) inertial.refuse("mass", fmt::format("{}", mass), "a mass >= 0");
  const Eigen::Matrix3d inertia = inertia_of(inertial.child("inertia"));
  const Eigen::Vector3d moments = principal_moments(inertia);
  const double slack = 1e-9 * std::abs(moments[2]);
  if (moments[0] < -slack || moments[0] + moments[1] < moments[2] - slack) {
    inertial.refuse("inertia", show_moments(moments),
                    "moments >= 0, none above the sum of the other two");
  }
  if (mass == 0 && moments[2] > 0) {
    inertial.refuse("inertia", show_moments(moments), "no moments where the mass is zero");
  }
  if (mass > 0) add_body(carrier, mass, frame.p, frame.R * inertia * frame.R.transpose());
}

/// A length, or the least of several.
double require_positive(const UrdfElement& shape, const char* attribute, double value) {
  if (!(value > 0)) shape.refuse(attribute, fmt::format("{}", value), "a length > 0");
  return value;
}

Shape shape_of(const UrdfElement& collision) {
  const char* expected =
      "one box, cylinder or sphere, or no <collision> here and capsules in the robot's TOML";
  const UrdfElement geometry = collision.child("geometry");
  const std::vector<UrdfElement> shapes = geometry.children();
  if (shapes.empty()) geometry.refuse("", "nothing", expected);
  const UrdfElement& given = shapes[0];
  const std::string tag = given.tag();
  const bool round = tag == "cylinder" || tag == "sphere";
  if (!round && tag != "box") geometry.refuse("", fmt::format("<{}>", tag), expected);
  if (shapes.size() > 1) {
    geometry.refuse("", fmt::format("<{}> and <{}>", tag, shapes[1].tag()), expected);
  }
  Shape shape;
  if (round) shape.radius = require_positive(given, "radius", given.number("radius"));
  if (tag == "box") {
    shape.kind = Shape::Kind::kBox;
    const Eigen::Vector3d size = given.vector("size");
    require_positive(given, "size", size.minCoeff());
    shape.half_sizes = size / 2;
  } else if (tag == "cylinder") {
    shape.kind = Shape::Kind::kCylinder;
    shape.half_length = require_positive(given, "length", given.number("length")) / 2;
  }
  return shape;
}

void add_link(Reading& reading, const UrdfElement& link, const Body& body) {
  const std::string name = name_of(link);
  reading.tree.bodies.emplace(name, body);
  if (const auto inertial = link.child_if_any("inertial")) {
    add_inertial(reading.tree.links[static_cast<std::size_t>(body.link)], *inertial,
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
  if (!limit) from.refuse("limit", "nothing", "effort and velocity");
  joint.effort_max = limit->number("effort");
  joint.velocity_max = limit->number("velocity");
  joint.q_min = continuous ? -std::numbers::pi : limit->number("lower", 0);
  joint.q_max = continuous ? std::numbers::pi : limit->number("upper", 0);
  if (joint.q_min > joint.q_max) {
    limit->refuse("lower", fmt::format("{}", joint.q_min),
                  fmt::format("at most upper = {}", joint.q_max));
  }
  if (joint.effort_max < 0) {
    limit->refuse("effort", fmt::format("{}", joint.effort_max), "a number >= 0");
  }
  if (!(joint.velocity_max > 0)) {
    limit->refuse("velocity", fmt::format("{}", joint.velocity_max), "a number > 0");
  }
}

/// A joint that moves.
Joint joint_of(const UrdfElement& from, const std::string& type, const Body& parent) {
  Joint joint;
  joint.name = name_of(from);
  joint.parent = parent.link;
  joint.type = type == "prismatic" ? JointType::kPrismatic : JointType::kRevolute;
  if (type != "revolute" && type != "continuous" && type != "prismatic") {
    const bool of_base = type == "floating" || type == "planar";
    from.refuse("type", of_base ? type : fmt::format("'{}'", type),
                fmt::format("revolute, continuous, prismatic or fixed{}",
                            of_base ? " (the base moves by base.axes in the robot's TOML)" : ""));
  }
  joint.placement = parent.placement * origin_of(from);
  const std::optional<UrdfElement> given = from.child_if_any("axis");
  const Eigen::Vector3d axis = given ? given->vector("xyz") : Eigen::Vector3d::UnitX();
  if (axis.stableNorm() < 1e-9) {
    given->refuse("xyz", "0 0 0", "a direction of nonzero length");
  }
  joint.axis = axis.stableNormalized();
  set_limits(from, type == "continuous", joint);
  if (const auto mimic = from.child_if_any("mimic")) {
    from.refuse("mimic", fmt::format("'{}'", mimic->attribute("joint").value_or("")),
                "a joint that moves on its own");
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
    if (!type) joint.refuse("type", "nothing", "revolute, continuous, prismatic or fixed");
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

void require_inertia(const std::filesystem::path& file, const Link& link) {
  if (!(link.mass > 0)) {
    refuse(file, fmt::format("link[{}].inertial.mass", link.name), fmt::format("{}", link.mass),
           "a mass > 0 of this link and what is fixed to it, because it moves");
  }
  const Eigen::Vector3d moments = principal_moments(link.inertia);
  if (moments[0] > 1e-9 * moments[2]) return;
  refuse(file, fmt::format("link[{}].inertial.inertia", link.name), show_moments(moments),
         "moments > 0 of this link and what is fixed to it, because it moves");
}

}  // namespace maxwrench
