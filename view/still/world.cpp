#include "view/still/world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drawing/axes.h"
#include "lib/math/polygon.h"
#include "view/still/numbers.h"

namespace maxwrench {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using nlohmann::ordered_json;

// The colours and proportions of the page; see view/page/src/. Lengths are shares of the size.
constexpr Rgb kBaseColour = 0x3f6c9c, kHub = 0x2d3740, kDuct = 0x20262c;
constexpr Rgb kArmColours[] = {0xe9ecef, 0xcfd6dd};
constexpr Rgb kIdle = 0x16a394, kBusy = 0xf2a93b, kLimit = 0xe11d30;
constexpr Rgb kDirection = 0x7b8794, kWrench = 0xe8590c, kSecond = 0x8f3fd1;
constexpr Rgb kSetFace = 0x2f7fd6, kSetEdge = 0x3d8fe8, kTouched = 0xb08968;
constexpr const char *kNoteInk = "#37424c", *kNoteSoft = "#5b6770", *kNoteLimit = "#c2182b",
                     *kNoteWrench = "#c2410c", *kNoteSecond = "#7a2fb8";
constexpr double kFullArc = 1.7 * std::numbers::pi, kWrenchArc = 1.6 * std::numbers::pi,
                 kDirectionArc = 1.9 * std::numbers::pi;
constexpr int kEffortDigits = 3;
constexpr std::size_t kMostNotes = 14;
constexpr std::size_t kMeshTriangles = 1500;  ///< of all meshes of a picture

double number_or(const ordered_json& value, double other) {
  return value.is_number() ? value.get<double>() : other;
}

double limit_of(const ordered_json& actuator, double u) {
  return number_or(actuator[u < 0 ? "min" : "max"], 0);
}

double share_of(double limit, double u) {
  return limit == 0 ? 0 : std::min(std::abs(u / limit), 1.0);
}

/// Whether an effort is its limit to the digits that its label shows.
bool at_limit(double limit, double u) {
  if (limit == 0 || u == 0) return false;
  const double power = std::floor(std::log10(std::abs(u)));
  return std::abs(u - limit) < 0.5 * std::pow(10, power + 1 - kEffortDigits);
}

std::string words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string with_unit(double value, const std::string& unit, int digits = kEffortDigits) {
  return with_digits(value, digits) + " " + unit;
}

/// What moves z to a direction, and the origin to a place.
Affine3d placed(const Vector3d& at, const Vector3d& along) {
  Affine3d to = Affine3d::Identity();
  to.translation() = at;
  to.linear() = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), along).toRotationMatrix();
  return to;
}

/// From `at` along `vector`, with its length.
void draw_arrow(Painter& painter, double radius, const Vector3d& at, const Vector3d& vector,
                Rgb colour) {
  const double length = vector.norm();
  if (length < 1e-6) return;
  const double head = std::min(5 * radius, 0.6 * length), thin = std::min(radius, 0.25 * length);
  const Affine3d to = placed(at, vector);
  const double shaft = std::max(length - head, 1e-6);
  painter.add(cylinder(thin, shaft), to * Eigen::Translation3d(0, 0, shaft / 2), colour);
  painter.add(cone(0.44 * head, head), to * Eigen::Translation3d(0, 0, shaft), colour);
}

/// Part of a circle about `axis` at `at` by `angle` [rad], in either direction, with a head.
void draw_arc(Painter& painter, double radius, double tube, const Vector3d& at,
              const Vector3d& axis, double angle, Rgb colour) {
  if (std::abs(angle) < 1e-3 || axis.norm() == 0) return;
  const Affine3d to = placed(at, std::copysign(1.0, angle) * axis);
  const double turn = std::abs(angle);
  painter.add(ring(radius, tube, turn), to, colour);
  const Vector3d end(radius * std::cos(turn), radius * std::sin(turn), 0),
      along(-std::sin(turn), std::cos(turn), 0);
  painter.add(cone(2.3 * tube, 5 * tube), to * placed(end, along), colour);
}

bool has_numbers(const ordered_json& list) { return list.is_array() && !list.empty(); }

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

double StillWorld::joint_radius(std::size_t joint) const {
  const auto parent =
      static_cast<std::size_t>(scene_["robot"]["joints"][joint]["parent"].get<int>());
  double thickest = 0;
  for (const std::size_t link : {parent, joint + 1}) {
    if (link == 0) continue;
    for (const ordered_json& body : scene_["robot"]["links"][link]["bodies"]) {
      thickest = std::max(thickest, body.value("radius", 0.0));
    }
  }
  return std::clamp(1.5 * thickest, 0.06 * size_, 0.14 * size_);
}

void StillWorld::draw_efforts(const ordered_json& frame, Painter& painter, Still& still) const {
  const ordered_json& robot = scene_["robot"];
  const bool water = robot["water"], solved = has_numbers(frame["u"]);
  const std::size_t thrusters = robot["thrusters"].size();
  const Affine3d base = pose_at(frame["links"]);
  std::vector<Note> notes;
  painter.shine_through(true);
  for (std::size_t i = 0; i < robot["actuators"].size(); ++i) {
    const ordered_json& actuator = robot["actuators"][i];
    const double u = solved ? number_or(frame["u"][i], 0) : 0;
    const double most = limit_of(actuator, u), share = share_of(most, u);
    const bool limit = at_limit(most, u);
    const Rgb colour = limit ? kLimit : mixed(kIdle, kBusy, share);
    Vector3d at;
    if (i < thrusters) {
      at = base * vector_at(robot["thrusters"][i]["position"]);
      const Vector3d along = base.linear() * vector_at(robot["thrusters"][i]["direction"]);
      const double radius = 0.045 * size_;
      painter.add(water ? cylinder(radius, radius, false) : sphere(0.022 * size_),
                  placed(at, along), kDuct);
      draw_arrow(painter, 0.011 * size_, at, thrust_metres_ * u * along, colour);
    } else {
      const std::size_t j = i - thrusters;
      const Affine3d link = pose_at(frame["links"], j + 1);
      at = link.translation();
      const Vector3d axis = link.linear() * vector_at(robot["joints"][j]["axis"]);
      if (actuator["unit"] == "N m") {
        draw_arc(painter, joint_radius(j), 0.0085 * size_, at, axis,
                 std::copysign(share * kFullArc, u), colour);
      } else {
        draw_arrow(painter, 0.011 * size_, at, std::copysign(0.25 * size_ * share, u) * axis,
                   colour);
      }
    }
    notes.push_back({words(actuator["name"]),
                     solved ? with_unit(u, actuator["unit"].get<std::string>()) : "", camera_(at),
                     limit ? kNoteLimit : kNoteInk, limit, (i < thrusters ? 1 : 0) + share});
  }
  painter.shine_through(false);
  std::stable_sort(notes.begin(), notes.end(),
                   [](const Note& a, const Note& b) { return a.weight > b.weight; });
  if (notes.size() > kMostNotes) notes.resize(kMostNotes);
  still.notes.insert(still.notes.end(), notes.begin(), notes.end());
}

void StillWorld::draw_wrenches(const ordered_json& frame, Painter& painter, Still& still) const {
  const auto draw = [&](const Vector3d& at, const Vector3d& force, const Vector3d& torque,
                        double metres, double arc, double thickness, Rgb colour) {
    draw_arrow(painter, thickness * size_, at, metres * force, colour);
    draw_arc(painter, 0.17 * size_, thickness * size_, at, torque, arc * torque.norm(), colour);
  };
  const auto note = [&](const std::string& name, const std::string& value, const Vector3d& at,
                        const char* colour, bool bold) {
    still.notes.push_back({name, value, camera_(at), colour, bold, 3});
  };
  const auto draw_one = [&](const char* name, const Vector3d& at, const ordered_json& h, Rgb colour,
                            const char* ink, double thickness) {
    const Vector3d force = vector_at(h), torque = vector_at(h, 3);
    const double f = force.norm(), t = torque.norm();
    draw(at, force, torque, force_metres_, most_torque_ > 0 ? kWrenchArc / most_torque_ : 0,
         thickness, colour);
    std::string value = f > 1e-6 ? with_unit(f, "N", 4) : "";
    if (t > 1e-6) value += (value.empty() ? "" : ", ") + with_unit(t, "N m", 4);
    Vector3d tip = at + force_metres_ * force;
    if (t > 1e-6) tip += 0.1 * size_ / t * torque;
    note(name, value, tip, ink, true);
  };
  const Vector3d at = pose_at(frame["end_effector"]).translation();
  const Vector3d force = vector_at(frame["c"]), torque = vector_at(frame["c"], 3);
  draw(at, force, torque, 0.3 * size_, kDirectionArc, 0.006, kDirection);
  note("c", "", at + 0.32 * size_ * force + 0.19 * size_ * torque, kNoteSoft, false);
  painter.shine_through(true);
  if (has_numbers(frame["h"])) draw_one("h", at, frame["h"], kWrench, kNoteWrench, 0.013);
  if (frame.contains("h_2") && has_numbers(frame["h_2"])) {
    const Vector3d touch = pose_at(frame["contact"]).translation();
    draw_one("h_2", touch, frame["h_2"], kSecond, kNoteSecond, 0.011);
  }
  painter.shine_through(false);
}

void StillWorld::draw_sets(const ordered_json& frame, Painter& painter, Still& still) const {
  if (!frame.contains("sets") || !frame["sets"].is_object()) return;
  const ordered_json& polytope = frame["sets"]["polytope"];
  if (!polytope.is_object()) return;
  Solid set;
  set.closed = set.edges = false;
  const Vector3d at = pose_at(frame["end_effector"]).translation();
  for (const Vector3d& x : points_of(polytope["vertices"])) {
    set.points.push_back(at + set_metres_ * x);
  }
  const ordered_json &triangles = polytope["triangles"], &edges = polytope["edges"];
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
    set.faces.push_back({triangles[i], triangles[i + 1], triangles[i + 2]});
  }
  painter.add(set, Affine3d::Identity(), kSetFace, 0.08);
  const auto point = [&](const ordered_json& i) { return set.points[i.get<std::size_t>()]; };
  for (std::size_t i = 0; i + 1 < edges.size(); i += 2) {
    painter.add_line(point(edges[i]), point(edges[i + 1]), 0.004 * size_, kSetEdge, 0.6);
  }
  if (frame["sets"]["of"] != "torque" || !has_numbers(frame["h"])) return;
  const Vector3d reached = at + set_metres_ * vector_at(frame["h"], 3);
  painter.add_line(at, reached, 0.004 * size_, kWrench, 0.8);
  painter.add(sphere(0.017 * size_), placed(reached, Vector3d::UnitZ()), kWrench);
  still.notes.push_back({"\u03b2", "", camera_(reached), kNoteWrench, true, 3});
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
