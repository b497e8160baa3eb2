#include "problems/make/collision_shapes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "problems/collision/collision.h"
#include "problems/collision/shapes.h"
#include "problems/make/bad_value.h"
#include "problems/make/robot.h"
#include "problems/make/touching_bodies.h"

namespace maxwrench {
namespace {

void check_hull(const std::string& key, const Shape& shape) {
  constexpr std::size_t kFewest = 4;
  if (shape.points.size() < kFewest) {
    throw BadValue(key + "points", fmt::format("{} points", shape.points.size()),
                   fmt::format("{} or more (a point may be repeated)", kFewest));
  }
  for (const Eigen::Vector3d& x : shape.points) require_numbers(key + "points", x, 3);
  require_non_negative(key + "radius", shape.radius);
}

void check_shape(const Shape& shape) {
  const std::string key = fmt::format("link[{}].collision.geometry.", shape.body);
  const char* length = "a length > 0";
  require_pose(fmt::format("link[{}].collision.origin", shape.body), shape.placement);
  switch (shape.kind) {
    case Shape::Kind::kCapsule:
      require_positive(key + (shape.half_length == 0 ? "sphere" : "capsule") + ".radius",
                       shape.radius, length);
      require_non_negative(key + "capsule.length", 2 * shape.half_length);
      break;
    case Shape::Kind::kBox:
      require_numbers(key + "box.size", 2 * shape.half_sizes, 3);
      require_positive(key + "box.size", 2 * shape.half_sizes.minCoeff(), length);
      break;
    case Shape::Kind::kCylinder:
      require_positive(key + "cylinder.radius", shape.radius, length);
      require_positive(key + "cylinder.length", 2 * shape.half_length, length);
      break;
    case Shape::Kind::kHull:
      check_hull(key + "hull.", shape);
      break;
  }
  require_finite(key + "radius", shape.radius);
}

}  // namespace

void set_collision(Robot& robot, const Collision& collision) {
  std::vector<Shape> shapes = collision.shapes;
  std::set<std::string> names;
  for (const Link& link : robot.links) names.insert(link.name);
  robot.convex_bodies.clear();
  for (Shape& shape : shapes) {
    require_link("collision.link", robot, shape.link);
    if (shape.body.empty()) shape.body = robot.links[static_cast<std::size_t>(shape.link)].name;
    names.insert(shape.body);
    check_shape(shape);
    robot.convex_bodies.push_back(to_convex_body(shape));
  }
  for (const auto& [a, b] : collision.ignore) {
    for (const std::string& body : {a, b}) {
      if (names.contains(body)) continue;
      throw BadValue("collision.ignore", shown(body),
                     fmt::format("a link: {}", fmt::join(names, ", ")));
    }
  }
  require_non_negative("collision.margin", collision.margin);
  auto ignore = collision.ignore;
  if (collision.find_ignored) {
    for (auto& pair : touching_bodies(robot, shapes, ignore, collision.margin)) {
      ignore.push_back(std::move(pair));
    }
  }
  robot.collision = make_collision_checker(std::move(shapes), ignore, collision.margin);
}

}  // namespace maxwrench
