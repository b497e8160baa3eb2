#include "problems/loader/urdf_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "problems/loader/bad_input.h"
#include "problems/loader/urdf_document.h"
#include "problems/make/robot.h"

namespace maxwrench {
namespace {

Eigen::Vector3d vector(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

Pose<double> pose(const urdf::Pose& origin) {
  const urdf::Rotation& q = origin.rotation;
  return {Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized().toRotationMatrix(),
          vector(origin.position)};
}

/// One file being flattened.
struct Reading {
  const std::filesystem::path& file;
  const UrdfDocument& document;
  UrdfTree tree;
};

Eigen::Matrix3d inertia_of(const urdf::Inertial& given) {
  Eigen::Matrix3d inertia;
  inertia << given.ixx, given.ixy, given.ixz, given.ixy, given.iyy, given.iyz, given.ixz, given.iyz,
      given.izz;
  return inertia;
}

/// Adds a body to the link that carries it.
void add_inertial(Link& link, const urdf::Inertial& given, const Pose<double>& body) {
  if (given.mass == 0) return;
  const Pose<double> frame = body * pose(given.origin);
  add_body(link, given.mass, frame.p, frame.R * inertia_of(given) * frame.R.transpose());
}

void add_shape(Reading& reading, const urdf::Link& link, const urdf::Collision& collision) {
  assert(collision.geometry != nullptr);  // refused in urdf_structure.cpp, as meshes
  const Body& body = reading.tree.bodies.at(link.name);
  Shape shape{
      .body = link.name, .link = body.link, .placement = body.placement * pose(collision.origin)};
  switch (collision.geometry->type) {
    case urdf::Geometry::SPHERE:
      shape.radius = static_cast<const urdf::Sphere&>(*collision.geometry).radius;
      break;
    case urdf::Geometry::BOX:
      shape.kind = Shape::Kind::kBox;
      shape.half_sizes = vector(static_cast<const urdf::Box&>(*collision.geometry).dim) / 2;
      break;
    case urdf::Geometry::CYLINDER: {
      const auto& cylinder = static_cast<const urdf::Cylinder&>(*collision.geometry);
      shape.kind = Shape::Kind::kCylinder;
      shape.radius = cylinder.radius;
      shape.half_length = cylinder.length / 2;
      break;
    }
    default:
      assert(false);
  }
  reading.tree.shapes.push_back(std::move(shape));
}

void add_body(Reading& reading, const urdf::Link& link, const Body& body) {
  reading.tree.bodies.emplace(link.name, body);
  Link& carrier = reading.tree.links[static_cast<std::size_t>(body.link)];
  if (link.inertial != nullptr) {
    require_body(link.name, link.inertial->mass, inertia_of(*link.inertial));
    add_inertial(carrier, *link.inertial, body.placement);
  }
  for (const auto& collision : link.collision_array) add_shape(reading, link, *collision);
}

JointType joint_type(const Reading& reading, const urdf::Joint& joint) {
  const std::string key = fmt::format("joint[{}].type", joint.name);
  const char* known = "revolute, continuous, prismatic or fixed";
  switch (joint.type) {
    case urdf::Joint::REVOLUTE:
    case urdf::Joint::CONTINUOUS:
      return JointType::kRevolute;
    case urdf::Joint::PRISMATIC:
      return JointType::kPrismatic;
    case urdf::Joint::FLOATING:
    case urdf::Joint::PLANAR:
      refuse(reading.file, key, joint.type == urdf::Joint::PLANAR ? "planar" : "floating",
             fmt::format("{} (the base moves by base.axes in the robot's TOML)", known));
    default:
      refuse(reading.file, key, "an unknown type", known);
  }
}

void set_limits(const Reading& reading, const urdf::Joint& from, Joint& joint) {
  if (from.limits == nullptr) {
    refuse(reading.file, fmt::format("joint[{}].limit", from.name), "nothing",
           "effort and velocity");
  }
  const urdf::JointLimits& limits = *from.limits;
  joint.q_min = limits.lower;
  joint.q_max = limits.upper;
  if (from.type == urdf::Joint::CONTINUOUS) {
    joint.q_min = -std::numbers::pi;
    joint.q_max = std::numbers::pi;
  }
  joint.effort_max = limits.effort;
  joint.velocity_max = limits.velocity;
}

/// Adds a moving joint and returns the index of the link that it moves.
int add_joint(Reading& reading, const urdf::Joint& from, const Body& parent) {
  Joint joint;
  joint.name = from.name;
  joint.type = joint_type(reading, from);
  joint.parent = parent.link;
  joint.placement = parent.placement * pose(from.parent_to_joint_origin_transform);
  joint.axis = vector(from.axis);
  set_limits(reading, from, joint);
  if (from.mimic != nullptr) {
    refuse(reading.file, fmt::format("joint[{}].mimic", from.name),
           fmt::format("'{}'", from.mimic->joint_name), "a joint that moves on its own");
  }
  reading.tree.joints.push_back(joint);
  reading.tree.links.push_back(Link{.name = from.child_link_name});
  return static_cast<int>(reading.tree.joints.size());
}

void visit(Reading& reading, const urdf::Link& link, const Body& body) {
  add_body(reading, link, body);
  auto children = link.child_joints;
  const auto& order = reading.document.joint_order;
  std::sort(children.begin(), children.end(), [&order](const auto& a, const auto& b) {
    return order.at(a->name) < order.at(b->name);
  });
  for (const auto& joint : children) {
    Body child;
    if (joint->type == urdf::Joint::FIXED) {
      child = {body.link, body.placement * pose(joint->parent_to_joint_origin_transform)};
    } else {
      child = {add_joint(reading, *joint, body), {}};
    }
    visit(reading, *reading.document.model->getLink(joint->child_link_name), child);
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
  const UrdfDocument document = read_urdf_document(file);
  Reading reading{file, document, {}};
  const urdf::Link& root = *document.model->getRoot();
  reading.tree.root = root.name;
  reading.tree.links.push_back(Link{.name = root.name});
  visit(reading, root, Body{});
  return std::move(reading.tree);
}

}  // namespace maxwrench
