#include <algorithm>
#include <cmath>
#include <numbers>

#include "drawing/axes.h"
#include "view/still/numbers.h"
#include "view/still/world.h"

// What the robot of a still does: its efforts, the wrenches of its contacts and their sets.

namespace maxwrench {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using nlohmann::ordered_json;

// The colours and proportions of the page; see view/page/src/. Lengths are shares of the size.
constexpr Rgb kDuct = 0x20262c, kIdle = 0x16a394, kBusy = 0xf2a93b, kLimit = 0xe11d30;
constexpr Rgb kDirection = 0x7b8794, kWrench = 0xe8590c, kSecond = 0x8f3fd1;
constexpr Rgb kSetFace = 0x2f7fd6, kSetEdge = 0x3d8fe8;
constexpr const char *kNoteInk = "#37424c", *kNoteSoft = "#5b6770", *kNoteLimit = "#c2182b",
                     *kNoteWrench = "#c2410c", *kNoteSecond = "#7a2fb8";
constexpr double kFullArc = 1.7 * std::numbers::pi, kWrenchArc = 1.6 * std::numbers::pi,
                 kDirectionArc = 1.9 * std::numbers::pi;
constexpr int kEffortDigits = 3;
constexpr std::size_t kMostNotes = 14;

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

}  // namespace

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

}  // namespace maxwrench
