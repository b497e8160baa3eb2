#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "drawing/legend.h"
#include "drawing/postures.h"

namespace maxwrench {

/// The outline of one of the robot's solids.
struct Silhouette {
  std::vector<Eigen::Vector2d> outline;
  bool on_base = false;
  double depth = 0;  // [m] from the viewer's side; the largest is farthest
};

/// The second contact of a robot.
struct ContactMark {
  Eigen::Vector2d place;
  Eigen::Vector2d into;                 // the environment: the contact frame's z axis
  std::vector<Eigen::Vector2d> places;  // a line along or around all places within the limits
};

/// The robot in one panel, on the plane of the picture in metres. Links without solids are lines
/// between their joints. A base without solids is the convex hull of the parts mounted on it.
struct Scene {
  std::vector<Silhouette> bodies;  // the farthest first
  std::vector<Eigen::Vector2d> hull;
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> links;
  std::vector<Eigen::Vector2d> joints;
  std::optional<Eigen::Vector2d> mount;  // of a base without free axes
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>
      thrusters;  // position, direction or force
  Eigen::Vector2d end_effector, tool_x, tool_y, c;
  double c_towards = 0;      // the part of c that is a force towards the viewer
  Eigen::Vector2d c_torque;  // the part of c that turns about an axis in the plane
  double c_turn = 0;         // and about the line of sight; positive is counterclockwise
  std::optional<ContactMark> touch;
};

/// The layout that all panels share.
struct Layout {
  std::vector<Scene> scenes;
  Eigen::AlignedBox2d box;                   // of all panels [m]
  double metres = 0;                         // per newton
  double scale = 0;                          // px/m
  Eigen::Vector2d size;                      // of a panel's plot [px]
  std::size_t columns = 1;                   // columns of panels
  double cell = 0;                           // width of a column [px]
  std::size_t sets = 0;                      // the largest number of sets in a panel
  bool forces = false;                       // at least one panel shows a set
  double symbol = 0;                         // length of c in panels without a set [m]
  std::map<std::string, CurveStyle> styles;  // styles of the sets
};

// Around the plots [px].
inline constexpr double kPostureLeft = 52, kPostureRight = 10, kPostureGap = 16;

Layout make_layout(std::span<const DrawnPosture> panels, View view);

/// The length of the arrow along c [N], which ends beyond all sets.
double reach_along_c(const DrawnPosture& panel, const Eigen::Vector2d& c);

}  // namespace maxwrench
