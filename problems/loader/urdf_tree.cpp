#include "problems/loader/urdf_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "problems/loader/bad_input.h"
#include "problems/loader/urdf_document.h"

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

/// In increasing order.
Eigen::Vector3d principal_moments(const Eigen::Matrix3d& inertia) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

[[noreturn]] void refuse_moments(const std::filesystem::path& file, const std::string& link,
                                 const Eigen::Vector3d& moments, std::string_view expected) {
  refuse(
      file, fmt::format("link[{}].inertial.inertia", link),
      fmt::format("principal moments {:.6g}, {:.6g}, {:.6g}", moments[0], moments[1], moments[2]),
      expected);
}

/// A mass point, a thin rod and a frame without mass are fine as long as they are a part.
void check_inertial(const Reading& reading, const urdf::Link& link) {
  const urdf::Inertial& given = *link.inertial;
  if (!(given.mass >= 0)) {
    refuse(reading.file, fmt::format("link[{}].inertial.mass", link.name),
           fmt::format("{}", given.mass), "a mass >= 0");
  }
  const Eigen::Vector3d moments = principal_moments(inertia_of(given));
  const double slack = 1e-9 * std::abs(moments[2]);
  if (moments[0] < -slack || moments[0] + moments[1] < moments[2] - slack) {
    refuse_moments(reading.file, link.name, moments,
                   "moments >= 0, none above the sum of the other two");
  }
  if (given.mass == 0 && moments[2] > 0) {
    refuse_moments(reading.file, link.name, moments, "no moments where the mass is zero");
  }
}

/// Adds a body to the link that carries it.
void add_inertial(Link& link, const urdf::Inertial& given, const Pose<double>& body) {
  if (given.mass == 0) return;
  const Pose<double> frame = body * pose(given.origin);
  add_body(link, given.mass, frame.p, frame.R * inertia_of(given) * frame.R.transpose());
}

void require_positive(const Reading& reading, const std::string& key, double value) {
  if (!(value > 0)) refuse(reading.file, key, fmt::format("{}", value), "a length > 0");
}

void add_shape(Reading& reading, const urdf::Link& link, const urdf::Collision& collision) {
  const std::string key = fmt::format("link[{}].collision.geometry", link.name);
  assert(collision.geometry != nullptr);  // refused in urdf_structure.cpp, as meshes
  const Body& body = reading.tree.bodies.at(link.name);
  Shape shape{
      .body = link.name, .link = body.link, .placement = body.placement * pose(collision.origin)};
  switch (collision.geometry->type) {
    case urdf::Geometry::SPHERE:
      shape.radius = static_cast<const urdf::Sphere&>(*collision.geometry).radius;
      require_positive(reading, key + ".sphere.radius", shape.radius);
      break;
    case urdf::Geometry::BOX:
      shape.kind = Shape::Kind::kBox;
      shape.half_sizes = vector(static_cast<const urdf::Box&>(*collision.geometry).dim) / 2;
      require_positive(reading, key + ".box.size", 2 * shape.half_sizes.minCoeff());
      break;
    case urdf::Geometry::CYLINDER: {
      const auto& cylinder = static_cast<const urdf::Cylinder&>(*collision.geometry);
      shape.kind = Shape::Kind::kCylinder;
      shape.radius = cylinder.radius;
      shape.half_length = cylinder.length / 2;
      require_positive(reading, key + ".cylinder.radius", cylinder.radius);
      require_positive(reading, key + ".cylinder.length", cylinder.length);
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
    check_inertial(reading, link);
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
  const std::string key = fmt::format("joint[{}].limit", from.name);
  if (from.limits == nullptr) refuse(reading.file, key, "nothing", "effort and velocity");
  const urdf::JointLimits& limits = *from.limits;
  joint.q_min = limits.lower;
  joint.q_max = limits.upper;
  if (from.type == urdf::Joint::CONTINUOUS) {
    joint.q_min = -std::numbers::pi;
    joint.q_max = std::numbers::pi;
  }
  joint.effort_max = limits.effort;
  joint.velocity_max = limits.velocity;
  if (joint.q_min > joint.q_max) {
    refuse(reading.file, key + ".lower", fmt::format("{}", joint.q_min),
           fmt::format("at most upper = {}", joint.q_max));
  }
  if (joint.effort_max < 0) {
    refuse(reading.file, key + ".effort", fmt::format("{}", limits.effort), "a number >= 0");
  }
  if (!(joint.velocity_max > 0)) {
    refuse(reading.file, key + ".velocity", fmt::format("{}", limits.velocity), "a number > 0");
  }
}

/// Adds a moving joint and returns the index of the link that it moves.
int add_joint(Reading& reading, const urdf::Joint& from, const Body& parent) {
  Joint joint;
  joint.name = from.name;
  joint.type = joint_type(reading, from);
  joint.parent = parent.link;
  joint.placement = parent.placement * pose(from.parent_to_joint_origin_transform);
  const Eigen::Vector3d axis = vector(from.axis);
  if (axis.stableNorm() < 1e-9) {
    refuse(reading.file, fmt::format("joint[{}].axis.xyz", from.name), "0 0 0",
           "a direction of nonzero length");
  }
  joint.axis = axis.stableNormalized();
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

void require_inertia(const std::filesystem::path& file, const Link& link) {
  if (!(link.mass > 0)) {
    refuse(file, fmt::format("link[{}].inertial.mass", link.name), fmt::format("{}", link.mass),
           "a mass > 0 of this link and what is fixed to it, because it moves");
  }
  const Eigen::Vector3d moments = principal_moments(link.inertia);
  if (moments[0] > 1e-9 * moments[2]) return;
  refuse_moments(file, link.name, moments,
                 "moments > 0 of this link and what is fixed to it, because it moves");
}

}  // namespace maxwrench
