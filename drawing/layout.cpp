#include "drawing/layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "drawing/axes.h"
#include "drawing/svg.h"
#include "lib/math/polygon.h"
#include "lib/math/rotated.h"
#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

using Point = Eigen::Vector2d;
using Box = Eigen::AlignedBox2d;

// Colours of Okabe and Ito, which colour-blind readers can distinguish; vermillion is reserved for
// c. If two sets are equal, both are visible: a pale line under dark dashes.
constexpr CurveStyle kSetStyles[] = {{"#007A5A", "2 2", Mark::kTriangle, false},
                                     {"#EDB04A", "", Mark::kSquare, false},
                                     {"#0072B2", "7 4", Mark::kDiamond, false},
                                     {"#B0508A", "8 2 2 2", Mark::kFlipped, false},
                                     {"#56B4E9", "4 4", Mark::kCircle, false}};
constexpr double kWidestSet = 1e9;  // N

/// Unit vector from the viewer into the picture.
Eigen::Vector3d line_of_sight(View view) {
  return view == View::kTop ? Eigen::Vector3d(0, 0, -1) : Eigen::Vector3d(0, 1, 0);
}

Silhouette silhouette(const ConvexBody& solid, const DrawnPosture& panel, View view) {
  constexpr int kRound = 24;
  const Pose<double> link =
      panel.posture.base * panel.posture.links[static_cast<std::size_t>(solid.link)];
  Silhouette body;
  body.on_base = solid.link == 0;
  std::vector<Point> points;
  for (const Eigen::Vector3d& p : solid.points) {
    const Eigen::Vector3d in_world = link.R * p + link.p;
    body.depth += line_of_sight(view).dot(in_world) / static_cast<double>(solid.points.size());
    for (int i = 0; i < (solid.radius > 0 ? kRound : 1); ++i) {
      const double angle = 2 * std::numbers::pi * i / kRound;
      points.push_back(axes(view) * in_world +
                       solid.radius * Point(std::cos(angle), std::sin(angle)));
    }
  }
  body.outline = convex_hull(points);
  return body;
}

void add_bodies(const DrawnPosture& panel, View view, Scene& scene) {
  for (const ConvexBody& solid : panel.problem->robot.convex_bodies) {
    scene.bodies.push_back(silhouette(solid, panel, view));
  }
  std::stable_sort(scene.bodies.begin(), scene.bodies.end(),
                   [](const Silhouette& a, const Silhouette& b) { return a.depth > b.depth; });
}

/// For each link, whether it has no solid. In a picture with a hull, no link has one.
std::vector<bool> bare_links(const DrawnPosture& panel) {
  std::vector<bool> bare(panel.posture.links.size(), true);
  if (!panel.hull.empty()) return bare;
  for (const ConvexBody& solid : panel.problem->robot.convex_bodies) {
    bare[static_cast<std::size_t>(solid.link)] = false;
  }
  return bare;
}

void add_mounts_and_links(const DrawnPosture& panel, View view, Scene& scene) {
  const std::vector<bool> bare = bare_links(panel);
  const Robot& robot = panel.problem->robot;
  const Pose<double>& base = panel.posture.base;
  const auto on_paper = [&](const Eigen::Vector3d& p) -> Point {
    return axes(view) * (base.R * p + base.p);
  };
  const auto origin = [&](int link) { return on_paper(panel.posture.links[link].p); };
  for (const Eigen::Vector3d& p : panel.hull) scene.hull.push_back(on_paper(p));
  for (const Thruster& thruster : robot.thrusters) {
    if (panel.hull.empty() && bare[0]) scene.hull.push_back(on_paper(thruster.position));
  }
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const int link = static_cast<int>(i) + 1;
    const int parent = robot.joints[i].parent;
    if (!bare[static_cast<std::size_t>(parent)]) continue;
    if (parent > 0 || scene.hull.empty()) scene.links.emplace_back(origin(parent), origin(link));
    if (parent == 0 && panel.hull.empty() && !robot.thrusters.empty()) {
      scene.hull.push_back(origin(link));
    }
  }
  scene.hull = convex_hull(scene.hull);
  if (robot.base_axes.empty() && bare[0]) scene.mount = origin(0);
  for (const EndEffector& e : robot.end_effectors) {
    if (e.link == 0 || !bare[static_cast<std::size_t>(e.link)]) continue;
    scene.links.emplace_back(origin(e.link),
                             on_paper((panel.posture.links[e.link] * e.placement).p));
  }
}

ContactMark contact_of(const DrawnPosture& panel, View view) {
  constexpr int kPieces = 24;
  const Problem& problem = *panel.problem;
  const Contact& contact = *problem.contact;
  const Eigen::VectorXd low = problem.theta_r_min.tail(contact.coordinates());
  const Eigen::VectorXd range = problem.theta_r_max.tail(contact.coordinates()) - low;
  ContactMark touch{
      axes(view) * panel.posture.contact.p, axes(view) * panel.posture.contact.R.col(2), {}};
  const auto add = [&](const Eigen::VectorXd& share) {
    const Eigen::VectorXd s = low + share.cwiseProduct(range);
    touch.places.emplace_back(axes(view) * contact_pose(contact, s.data()).p);
  };
  if (contact.coordinates() == 1) {
    for (int i = 0; i <= kPieces; ++i) add(Eigen::VectorXd::Constant(1, double(i) / kPieces));
  } else if (contact.coordinates() == 2) {
    for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) add(Eigen::Vector2d(x, y));
    touch.places = convex_hull(touch.places);  // a plane seen from its edge becomes a line
    if (touch.places.size() > 2) touch.places.push_back(touch.places.front());
  }
  return touch;
}

Scene project(const DrawnPosture& panel, View view) {
  const Eigen::Matrix<double, 2, 3> P = axes(view);
  const Robot& robot = panel.problem->robot;
  const Pose<double>& base = panel.posture.base;
  const auto on_paper = [&](const Eigen::Vector3d& p) -> Point {
    return P * (base.R * p + base.p);
  };
  Scene scene;
  if (panel.hull.empty()) add_bodies(panel, view, scene);
  add_mounts_and_links(panel, view, scene);
  for (std::size_t j = 0; j < robot.thrusters.size(); ++j) {
    const Thruster& thruster = robot.thrusters[j];
    const double size = panel.u.size() > 0 ? panel.u[static_cast<Eigen::Index>(j)] : 1;
    scene.thrusters.emplace_back(on_paper(thruster.position),
                                 size * (P * (base.R * thruster.direction)));
  }
  for (std::size_t link = 1; link < panel.posture.links.size(); ++link) {
    scene.joints.push_back(on_paper(panel.posture.links[link].p));
  }
  const Pose<double> tool = pose_at(*panel.problem, panel.posture.theta_r);
  const Vector6d c = rotated(panel.posture.turn, panel.problem->c);
  scene.end_effector = P * tool.p;
  scene.tool_x = P * tool.R.col(0);
  scene.tool_y = P * tool.R.col(view == View::kTop ? 1 : 2);
  scene.c = P * c.head<3>();
  scene.c_towards = -line_of_sight(view).dot(c.head<3>());
  scene.c_torque = P * c.tail<3>();
  scene.c_turn = -line_of_sight(view).dot(c.tail<3>());
  if (panel.problem->contact) scene.touch = contact_of(panel, view);
  return scene;
}

Box bounds(const Scene& scene) {
  Box box(scene.end_effector);
  for (const Silhouette& body : scene.bodies) {
    for (const Point& p : body.outline) box.extend(p);
  }
  for (const Point& p : scene.hull) box.extend(p);
  for (const Point& p : scene.joints) box.extend(p);
  if (scene.mount) box.extend(*scene.mount);
  for (const auto& [a, b] : scene.links) box.extend(a).extend(b);
  if (scene.touch) {
    box.extend(scene.touch->place);
    for (const Point& p : scene.touch->places) box.extend(p);
  }
  return box;
}

void choose_force_scale(std::span<const DrawnPosture> panels, Layout& layout) {
  double largest = 0;
  for (const DrawnPosture& panel : panels) {
    for (const ForceSet& set : panel.sets) {
      for (const Point& h : set.outline) {
        if (!(h.norm() < kWidestSet)) {
          throw std::invalid_argument("figure: got a set of forces beyond 1e9 N, expected less");
        }
        largest = std::max(largest, h.norm());
      }
    }
  }
  layout.forces = largest > 0;
  // A round number of newtons per metre, so that the sets are about half as large as the robot.
  const double extent = std::max(layout.box.sizes().maxCoeff(), 1e-3);
  layout.metres = largest > 0 ? 1 / round_step(2.2 * largest / extent) : 0.1 * extent;
  if (largest > 0 && largest * layout.metres > 0.8 * extent) layout.metres /= 2;
}

}  // namespace

double reach_along_c(const DrawnPosture& panel, const Point& c) {
  double reach = 0;
  for (const ForceSet& set : panel.sets) {
    for (const Point& h : set.outline) reach = std::max(reach, c.dot(h));
  }
  return 1.12 * reach;
}

Layout make_layout(std::span<const DrawnPosture> panels, View view) {
  Layout layout;
  layout.box.setEmpty();
  for (const DrawnPosture& panel : panels) {
    layout.scenes.push_back(project(panel, view));
    layout.box.extend(bounds(layout.scenes.back()));
    layout.sets = std::max(layout.sets, panel.sets.size());
    for (const ForceSet& set : panel.sets) {
      const std::size_t next = layout.styles.size() % std::size(kSetStyles);
      layout.styles.try_emplace(set.name, kSetStyles[next]);
    }
  }
  choose_force_scale(panels, layout);
  layout.symbol = layout.forces ? 0 : 0.1 * layout.box.sizes().maxCoeff();
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const Scene& scene = layout.scenes[i];
    for (const ForceSet& set : panels[i].sets) {
      for (const Point& h : set.outline) layout.box.extend(scene.end_effector + layout.metres * h);
    }
    const Point around = Point::Constant(1.6 * layout.symbol);
    layout.box.extend(scene.end_effector - around).extend(scene.end_effector + around);
    const double reach = reach_along_c(panels[i], scene.c);
    layout.box.extend(scene.end_effector + 1.1 * layout.metres * reach * scene.c);
    if (panels[i].u.size() == 0) continue;
    for (const auto& [p, force] : scene.thrusters) layout.box.extend(p + layout.metres * force);
  }
  const Point margin = Point::Constant(0.05 * layout.box.sizes().maxCoeff());
  layout.box = Box(layout.box.min() - margin, layout.box.max() + margin);
  layout.columns = std::min<std::size_t>(panels.size(), 2);
  const double columns = static_cast<double>(layout.columns);
  layout.cell = (kPageWidth - kPostureLeft - kPostureRight - (columns - 1) * kPostureGap) / columns;
  const double height = layout.columns == 1 ? 340 : 210;
  // At least one centimetre, for a robot without extent.
  const Point extent = layout.box.sizes().cwiseMax(1e-2);
  layout.box = Box(layout.box.center() - extent / 2, layout.box.center() + extent / 2);
  layout.scale = std::min(layout.cell / extent.x(), height / extent.y());
  layout.size = layout.scale * layout.box.sizes();
  return layout;
}

}  // namespace maxwrench
