#include "view/still/world.h"

#include <algorithm>
#include <cmath>

#include "drawing/axes.h"
#include "lib/math/polygon.h"
#include "view/still/numbers.h"

namespace maxwrench {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using nlohmann::ordered_json;

// The colours and proportions of the page; see view/page/src/. Lengths are shares of the size.
constexpr Rgb kBaseColour = 0x3f6c9c, kHub = 0x2d3740;
constexpr Rgb kArmColours[] = {0xe9ecef, 0xcfd6dd};
constexpr Rgb kTouched = 0xb08968;
constexpr std::size_t kMeshTriangles = 1500;  ///< of all meshes of a picture

double norm_at(const ordered_json& frame, const char* key, std::size_t first) {
  if (!frame.contains(key) || !has_numbers(frame[key])) return 0;
  return vector_at(frame[key], first).norm();
}

/// The largest distance of a point of the polytope from its origin.
double extent_of(const ordered_json& frame) {
  if (!frame.contains("sets") || !frame["sets"].is_object()) return 0;
  const ordered_json& polytope = frame["sets"]["polytope"];
  double most = 0;
  if (!polytope.is_object()) return most;
  for (const Vector3d& x : points_of(polytope["vertices"])) most = std::max(most, x.norm());
  return most;
}

std::size_t triangles_of(const ordered_json& body) {
  return body["triangles"].get_ref<const std::string&>().size() / 16;  // 12 bytes in base64
}

Rgb rgb_of(const ordered_json& colour) {
  Rgb result = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    result = result << 8U | static_cast<Rgb>(std::lround(255 * colour[i].get<double>()));
  }
  return result;
}

/// From where the whole is seen best: flat robots rather from above.
Vector3d best_side(const Eigen::AlignedBox3d& box) {
  const Vector3d size = box.sizes();
  const bool flat = size.z() < 0.2 * std::max(size.x(), size.y());
  return {0.75, -1, flat ? 1.9 : 0.62};
}

}  // namespace

StillWorld::StillWorld(const ordered_json& scene, const std::vector<const ordered_json*>& frames)
    : scene_(scene) {
  std::size_t triangles = 0;
  const ordered_json& links = scene["robot"]["links"];
  for (const ordered_json& link : links) {
    for (const ordered_json& body : link["bodies"]) {
      if (body["kind"] == "mesh") triangles += triangles_of(body);
    }
  }
  const double kept =
      std::min(1.0, static_cast<double>(kMeshTriangles) /
                        static_cast<double>(std::max<std::size_t>(triangles * frames.size(), 1)));
  for (std::size_t i = 0; i < links.size(); ++i) {
    for (const ordered_json& body : links[i]["bodies"]) {
      const std::size_t own =
          body["kind"] == "mesh"
              ? static_cast<std::size_t>(kept * static_cast<double>(triangles_of(body)))
              : 0;
      bodies_.push_back({i, solid_of(body, std::max<std::size_t>(own, 12)),
                         body.contains("colour") ? rgb_of(body["colour"])
                         : i == 0                ? kBaseColour
                                                 : kArmColours[i % 2],
                         body.value("opacity", 1.0)});
    }
  }
  Eigen::AlignedBox3d all;
  for (const ordered_json* frame : frames) {
    all.extend(box_of(*frame)).extend(pose_at((*frame)["end_effector"]).translation().eval());
    most_force_ = std::max({most_force_, norm_at(*frame, "h", 0), norm_at(*frame, "h_2", 0)});
    most_torque_ = std::max({most_torque_, norm_at(*frame, "h", 3), norm_at(*frame, "h_2", 3)});
    if (extent_of(*frame) > 0) shown_set_ = (*frame)["sets"]["of"];
  }
  floor_ = all.min().z();
  size_ = std::max(0.8 * box_of(*frames.front()).sizes().norm(), 1e-3);
  step_ = round_step(size_ / 4);
  double most_extent = 0;
  for (const ordered_json* frame : frames) most_extent = std::max(most_extent, extent_of(*frame));
  set_metres_ = most_extent > 0 ? 0.62 * size_ / most_extent : 1;
  force_metres_ = shown_set_ == "force" ? set_metres_
                  : most_force_ > 0     ? 0.5 * size_ / most_force_
                                        : 1;
  double most_thrust = 0;
  for (std::size_t i = 0; i < scene["robot"]["thrusters"].size(); ++i) {
    const ordered_json& actuator = scene["robot"]["actuators"][i];
    most_thrust = std::max({most_thrust, std::abs(number_or(actuator["min"], 0)),
                            std::abs(number_or(actuator["max"], 0))});
  }
  thrust_metres_ = most_thrust > 0 ? 0.32 * size_ / most_thrust : 0;
  camera_ = camera_from(best_side(all));
}

Eigen::AlignedBox3d StillWorld::box_of(const ordered_json& frame) const {
  Eigen::AlignedBox3d box;
  for (const Body& body : bodies_) {
    const Affine3d to = pose_at(frame["links"], body.link);
    for (const Vector3d& x : body.solid.points) box.extend(to * x);
  }
  for (std::size_t i = 0; i < scene_["robot"]["links"].size(); ++i) {
    box.extend(pose_at(frame["links"], i).translation().eval());
  }
  return box;
}

Still StillWorld::draw(const ordered_json& frame) const {
  Still still;
  Painter painter(camera_);
  draw_links(frame, painter, still);
  draw_contact(painter);
  draw_efforts(frame, painter, still);
  draw_wrenches(frame, painter, still);
  draw_sets(frame, painter, still);
  draw_floor(box_of(frame), painter, still);
  still.faces = painter.faces();
  return still;
}

void StillWorld::draw_links(const ordered_json& frame, Painter& painter, Still& still) const {
  Vector3d light = camera_.axes * towards_light();
  light.head<2>() *= 0.4;  // a shadow is rather below what casts it
  const double floor = floor_ - (scene_["robot"]["water"].get<bool>() ? 0.35 : 0.004) * size_;
  for (const Body& body : bodies_) {
    const Affine3d to = pose_at(frame["links"], body.link);
    painter.add(body.solid, to, body.colour, body.opacity);
    std::vector<Eigen::Vector2d> shadow;
    for (const Vector3d& x : body.solid.points) {
      const Vector3d at = to * x;
      shadow.emplace_back(camera_(at - (at.z() - floor) / light.z() * light).head<2>());
    }
    still.shadows.push_back(convex_hull(shadow));
  }
  const ordered_json& joints = scene_["robot"]["joints"];
  const Solid hub = cylinder(0.028 * size_, 0.05 * size_);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (joints[i]["unit"] != "rad") continue;
    const Affine3d link = pose_at(frame["links"], i + 1);
    painter.add(hub, link * placed(Vector3d::Zero(), vector_at(joints[i]["axis"])), kHub);
  }
}

void StillWorld::draw_contact(Painter& painter) const {
  const ordered_json& contact = scene_["task"]["contact"];
  if (contact.is_null()) return;
  const double thick = 0.03 * size_;
  const std::string surface = contact["surface"];
  const auto low = [&](std::size_t i) { return contact["min"][i].get<double>(); };
  const auto high = [&](std::size_t i) { return contact["max"][i].get<double>(); };
  Affine3d to = pose_at(contact["frame"]);
  Solid body;
  if (surface == "plane") {
    body = box({high(0) - low(0) + 4 * thick, high(1) - low(1) + 4 * thick, thick});
    to.translate(Vector3d((low(0) + high(0)) / 2, (low(1) + high(1)) / 2, thick / 2));
  } else if (surface == "line") {
    body = moved(cylinder(thick, high(0) - low(0) + 4 * thick),
                 placed({(low(0) + high(0)) / 2, 0, thick}, Vector3d::UnitX()));
  } else if (surface == "circle") {
    body = moved(cylinder(contact["radius"].get<double>(), size_),
                 placed(Vector3d::Zero(), Vector3d::UnitY()));
  } else {
    body = moved(sphere(thick), placed({0, 0, thick}, Vector3d::UnitZ()));
  }
  painter.add(body, to, kTouched, surface == "plane" ? 0.55 : 1);
}

void StillWorld::draw_floor(const Eigen::AlignedBox3d& robot, const Painter& painter,
                            Still& still) const {
  const double height = floor_ - (scene_["robot"]["water"].get<bool>() ? 0.35 : 0.004) * size_;
  const Eigen::Vector2d centre = robot.center().head<2>();
  const double radius = 0.6 * std::max(size_, robot.sizes().head<2>().norm());
  for (const int axis : {0, 1}) {
    const auto first = static_cast<long>(std::ceil((centre[axis] - radius) / step_));
    for (long k = first; static_cast<double>(k) * step_ < centre[axis] + radius; ++k) {
      const double at = static_cast<double>(k) * step_, from = at - centre[axis];
      const double half = std::sqrt(std::max(0.0, radius * radius - from * from));
      for (const double end : {-half, half}) {
        Vector3d x(0, 0, height);
        x[axis] = at;
        x[1 - axis] = centre[1 - axis] + end;
        still.floor.push_back(painter.camera()(x));
      }
    }
  }
}

}  // namespace maxwrench
