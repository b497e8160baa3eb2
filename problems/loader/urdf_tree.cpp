#include "problems/loader/urdf_tree.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "lib/robot/spatial.h"
#include "problems/loader/bad_input.h"
#include "problems/loader/joint_group.h"
#include "problems/loader/urdf_joint.h"
#include "problems/loader/urdf_shape.h"
#include "problems/loader/urdf_structure.h"
#include "problems/make/bad_value.h"
#include "problems/make/robot.h"

namespace maxwrench {
namespace {

/// The state while one file is flattened.
struct Reading {
  const UrdfStructure& structure;
  const UrdfChoices& choices;
  std::map<std::string, UrdfJoint> joints;
  MeshReading meshes;
  UrdfTree& tree;
  std::map<std::string, int> index_of;  ///< of joints in the tree
};

/// Some makers leave an old <inertia> behind the new one; the first counts, as for other readers.
Eigen::Matrix3d inertia_of(const UrdfElement& inertial, std::vector<std::string>& warnings) {
  const std::vector<UrdfElement> given = inertial.children("inertia");
  if (given.empty()) return Eigen::Matrix3d::Zero();
  if (given.size() > 1) {
    warnings.push_back(
        fmt::format("{}.inertia: {} elements: the first one counts", inertial.key(), given.size()));
  }
  const auto value = [&](const char* name) { return given.front().number(name, 0); };
  // All are read before the first is stored: one that is no number ends the reading.
  const double xx = value("ixx"), yy = value("iyy"), zz = value("izz");
  const double xy = value("ixy"), xz = value("ixz"), yz = value("iyz");
  Eigen::Matrix3d inertia;
  inertia << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  return inertia;
}

/// Adds a body to the link that carries it, and to the parts.
void add_inertial(Reading& reading, const UrdfElement& link, const Body& body) {
  const std::string name = name_of(link);
  const std::optional<UrdfElement> inertial = link.child_if_any("inertial");
  const LinkChoice choice = choice_of(reading.choices.links, name);
  double mass = 0;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  Pose<double> frame;
  if (inertial) {
    frame = origin_of(*inertial);
    inertia = inertia_of(*inertial, reading.tree.warnings);
    if (const auto given = inertial->child_if_any("mass")) mass = given->number("value");
  }
  mass = choice.mass.value_or(mass);
  if (choice.com) frame.p = *choice.com;
  if (choice.inertia) {
    inertia = *choice.inertia;
    frame.R.setIdentity();
  }
  reading.tree.parts.push_back(
      {.name = name, .link = body.link, .frame = body.placement, .mass = mass, .com = frame.p});
  frame = body.placement * frame;
  require_body(name, mass, inertia);
  Link& carrier = reading.tree.links[static_cast<std::size_t>(body.link)];
  if (const auto bad = why_no_body(name, mass, inertia)) reading.tree.no_dynamics.push_back(*bad);
  if (mass > 0) add_body(carrier, mass, frame.p, frame.R * inertia * frame.R.transpose());
}

void add_link(Reading& reading, const UrdfElement& link, const Body& body) {
  const std::string name = name_of(link);
  reading.tree.bodies.emplace(name, body);
  add_inertial(reading, link, body);
  const MeshUse meshes =
      choice_of(reading.choices.links, name).meshes.value_or(reading.choices.meshes);
  for (const UrdfElement& collision : link.children("collision")) {
    std::optional<Shape> shape = read_shape(collision, meshes, reading.meshes);
    if (!shape) continue;
    shape->body = name;
    shape->link = body.link;
    shape->placement = body.placement * shape->placement;
    reading.tree.shapes.push_back(std::move(*shape));
  }
  for (Visual& visual :
       read_visuals(link, reading.structure.materials, reading.meshes.shapes, reading.tree.notes)) {
    visual.link = body.link;
    visual.placement = body.placement * visual.placement;
    reading.tree.visuals.push_back(std::move(visual));
  }
}

/// The pose of a locked joint's link in axes of the joint.
Pose<double> moved_by(const UrdfJoint& joint) {
  const double q = *joint.locked;
  Pose<double> pose;
  const Eigen::Vector3d axis = joint.joint.axis.normalized();
  if (joint.joint.type == JointType::kPrismatic) {
    pose.p = q * axis;
  } else if (q != 0) {
    pose.R = Eigen::AngleAxisd(q, axis).toRotationMatrix();
  }
  return pose;
}

void visit(Reading& reading, const std::string& name, const Body& body) {
  add_link(reading, reading.structure.links.at(name), body);
  const auto joints = reading.structure.joints_from.find(name);
  if (joints == reading.structure.joints_from.end()) {
    if (body.link > 0) reading.tree.leaves.push_back(name);
    return;
  }
  for (const UrdfElement& element : joints->second) {
    const UrdfJoint& joint = reading.joints.at(name_of(element));
    const Pose<double> placement = body.placement * origin_of(element);
    const std::string child = end_of(element, "child");
    Body moved{body.link, placement};
    if (joint.undriven) reading.tree.undriven.insert(joint.joint.name);
    if (joint.locked) {
      moved.placement = placement * moved_by(joint);
    } else {
      reading.index_of.emplace(joint.joint.name, static_cast<int>(reading.tree.joints.size()));
      reading.tree.joints.push_back(joint.joint);
      reading.tree.joints.back().parent = body.link;
      reading.tree.joints.back().placement = placement;
      reading.tree.links.push_back(Link{.name = child});
      moved = {static_cast<int>(reading.tree.joints.size()), {}};
    }
    visit(reading, child, moved);
  }
}

/// A force [N or N m] that no gear of this robot carries: a hundred times all its weight, at its
/// whole length and 1 m more.
double beyond_all_loads(const UrdfTree& tree) {
  constexpr double kGravity = 10, kMuch = 100;
  double mass = 1, length = 1;
  for (const Link& link : tree.links) {
    mass += link.mass;
    length += link.com.norm();
  }
  for (const Joint& joint : tree.joints) {
    length += joint.placement.p.norm();
    if (joint.type == JointType::kPrismatic) {
      length += std::max(std::abs(joint.q_min), std::abs(joint.q_max));
    }
  }
  return kMuch * kGravity * mass * length;
}

void set_gears(Reading& reading) {
  const double beyond = beyond_all_loads(reading.tree);
  for (Joint& joint : reading.tree.joints) {
    const std::optional<Mimic>& mimic = reading.joints.at(joint.name).mimic;
    if (!mimic) continue;
    joint.gear = {reading.index_of.at(mimic->leader), mimic->ratio, mimic->offset};
    joint.effort_max = beyond;
  }
}

/// The longest edge of a shape's bounding box in its own axes [m].
double length_of(const Shape& shape) {
  switch (shape.kind) {
    case Shape::Kind::kBox:
      return 2 * shape.half_sizes.maxCoeff();
    case Shape::Kind::kCapsule:
      return 2 * (shape.half_length + shape.radius);
    case Shape::Kind::kCylinder:
      return 2 * std::max(shape.half_length, shape.radius);
    case Shape::Kind::kHull:
      break;
  }
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : shape.points) box.extend(point);
  return box.isEmpty() ? 0 : box.sizes().maxCoeff() + 2 * shape.radius;
}

/// Lengths and masses that only other units explain.
void suspect_units(UrdfTree& tree) {
  constexpr double kFar = 20, kHeavy = 5000;  // m, kg
  std::string last;
  for (const Shape& shape : tree.shapes) {  // one line for each link
    if (length_of(shape) < kFar || shape.body == last) continue;
    last = shape.body;
    tree.warnings.push_back(fmt::format("link[{}].collision: a shape of {:.3g} m: millimetres?",
                                        shape.body, length_of(shape)));
  }
  for (const Joint& joint : tree.joints) {
    if (joint.placement.p.norm() < kFar) continue;
    tree.warnings.push_back(
        fmt::format("joint[{}].origin.xyz: {:.3g} m from the joint before it: "
                    "millimetres?",
                    joint.name, joint.placement.p.norm()));
  }
  for (const Link& link : tree.links) {
    if (link.mass > kHeavy) {
      tree.warnings.push_back(
          fmt::format("link[{}].inertial.mass: {:.3g} kg: grams?", link.name, link.mass));
    }
    if (link.com.norm() > kFar) {
      tree.warnings.push_back(fmt::format("link[{}].inertial.origin.xyz: {:.3g} m: millimetres?",
                                          link.name, link.com.norm()));
    }
  }
}

/// An effort that all motors share is rarely that of each of them.
void suspect_efforts(UrdfTree& tree) {
  constexpr int kMany = 6;
  std::map<double, int> counts;
  for (const Joint& joint : tree.joints) {
    if (!joint.gear) ++counts[joint.effort_max];
  }
  if (counts.size() != 1 || counts.begin()->second < kMany || counts.begin()->first == 0) return;
  tree.warnings.push_back(fmt::format("joint.limit.effort: all {} joints have {:g}: a placeholder?",
                                      counts.begin()->second, counts.begin()->first));
}

/// Rejects what only a slip of the pen explains; in a URDF it is repaired.
void require_leader(const std::string& name, const Mimic& mimic,
                    const std::map<std::string, UrdfJoint>& joints) {
  const std::string key = fmt::format("joints.{}.mimic", name);
  if (mimic.leader == name || !joints.contains(mimic.leader)) {
    throw BadValue(key + ".joint", shown(mimic.leader), "the name of another joint of the URDF");
  }
  if (mimic.ratio == 0) throw BadValue(key + ".ratio", "0", "another number");
}

}  // namespace

Pose<double> origin_of(const UrdfElement& element) {
  const std::optional<UrdfElement> origin = element.child_if_any("origin");
  if (!origin) return {};
  // Half angles: the rotation is computed from a quaternion.
  const Eigen::Vector3d half = origin->vector("rpy", Eigen::Vector3d::Zero()) / 2;
  const Eigen::Array3d c = half.array().cos(), s = half.array().sin();
  const Eigen::Quaterniond q(
      c[0] * c[1] * c[2] + s[0] * s[1] * s[2], s[0] * c[1] * c[2] - c[0] * s[1] * s[2],
      c[0] * s[1] * c[2] + s[0] * c[1] * s[2], c[0] * c[1] * s[2] - s[0] * s[1] * c[2]);
  return {q.normalized().toRotationMatrix(), origin->vector("xyz", Eigen::Vector3d::Zero())};
}

Pose<double> pose_from_xyz_rpy(const Eigen::Vector3d& xyz, const Eigen::Vector3d& rpy) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  const Eigen::Matrix3d R =
      (AngleAxisd(rpy.z(), Vector3d::UnitZ()) * AngleAxisd(rpy.y(), Vector3d::UnitY()) *
       AngleAxisd(rpy.x(), Vector3d::UnitX()))
          .toRotationMatrix();
  return {R, xyz};
}

UrdfTree read_urdf(const std::filesystem::path& file, const UrdfChoices& given) {
  tinyxml2::XMLDocument document;
  UrdfTree tree;
  tree.files.push_back(file.string());
  const UrdfStructure structure = read_structure(file, document, tree.notes);
  UrdfChoices choices = given;
  if (choices.group) tree.group_tips = lock_outside_of_group(structure, choices, tree.notes);
  const auto require_known = [&](const auto& choices_by_name, const char* noun, const auto& known) {
    for (const auto& [name, choice] : choices_by_name) {
      if (!known(name)) {
        throw BadValue(fmt::format("{}s.{}", noun, name), "an unknown key",
                       fmt::format("the name of a {} of the URDF", noun));
      }
    }
  };
  Reading reading{structure,
                  choices,
                  read_joints(structure, choices, tree.warnings),
                  {MeshShapes(file, choices.packages), tree.warnings, tree.notes, tree.files},
                  tree,
                  {}};
  require_known(choices.joints, "joint",
                [&](const std::string& name) { return reading.joints.contains(name); });
  for (const auto& [name, choice] : choices.joints) {
    if (choice.mimic) require_leader(name, *choice.mimic, reading.joints);
  }
  require_known(choices.links, "link",
                [&](const std::string& name) { return structure.links.contains(name); });
  tree.name = structure.name.empty() ? file.stem().string() : structure.name;
  tree.root = structure.root;
  tree.links.push_back(Link{.name = structure.root});
  visit(reading, structure.root, Body{});
  set_gears(reading);
  suspect_units(tree);
  suspect_efforts(tree);
  return tree;
}

}  // namespace maxwrench
