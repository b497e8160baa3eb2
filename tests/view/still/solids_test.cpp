#include "view/still/solids.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "drawing/depth_order.h"
#include "view/base64.h"
#include "view/still/painter.h"

namespace maxwrench {
namespace {

using Json = nlohmann::ordered_json;

/// By the divergence theorem, over triangles of the faces: positive if they face outwards.
double volume(const Solid& solid) {
  double six = 0;
  const auto at = [&](const std::vector<int>& face, std::size_t i) -> const Eigen::Vector3d& {
    return solid.points[static_cast<std::size_t>(face[i])];
  };
  for (const std::vector<int>& face : solid.faces) {
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
      six += at(face, 0).dot(at(face, i).cross(at(face, i + 1)));
    }
  }
  return six / 6;
}

/// Each edge belongs to two faces, which pass it in opposite directions.
void expect_closed(const Solid& solid) {
  std::map<std::pair<int, int>, int> passes;
  for (const std::vector<int>& face : solid.faces) {
    EXPECT_GE(face.size(), 3U);
    for (std::size_t i = 0; i < face.size(); ++i) ++passes[{face[i], face[(i + 1) % face.size()]}];
  }
  for (const auto& [edge, count] : passes) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(passes.count({edge.second, edge.first}), 1U);
  }
}

constexpr double kPi = std::numbers::pi;

/// Round bodies are inscribed with 20 sides: a regular 20-gon has 0.9836 of the circle's area, and
/// the rings of a sphere lose a little more.
TEST(StillSolids, AreClosedAndHaveTheirVolume) {
  const double radius = 0.3, length = 2;
  const struct {
    Solid solid;
    double exact;
  } cases[] = {
      {box({1, 2, 3}), 6},
      {cylinder(radius, length), kPi * radius * radius * length},
      {capsule({1, 0, 0}, {1, 2, 0}, radius),
       kPi * radius * radius * length + 4 * kPi / 3 * radius * radius * radius},
      {sphere(radius), 4 * kPi / 3 * radius * radius * radius},
      {cone(radius, length), kPi * radius * radius * length / 3},
      {solid_of({{"kind", "hull"},
                 {"points", {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.1, 0.1, 0.1}},
                 {"radius", 0}},
                0),
       1.0 / 6},
      {solid_of({{"kind", "sphere"},
                 {"size", {2, 2, 2}},
                 {"pose", {1, 0, 0, 5, 0, 1, 0, 5, 0, 0, 1, 5}}},
                0),
       4 * kPi / 3},
  };
  for (const auto& [solid, exact] : cases) {
    expect_closed(solid);
    EXPECT_LE(volume(solid), exact * (1 + 1e-9));
    EXPECT_GE(volume(solid), 0.92 * exact);
  }
}

/// All points within 0.5 of a unit square: the slab of the square, half cylinders at its edges and
/// quarters of a sphere at its corners.
TEST(StillSolids, AHullGrowsByItsRadius) {
  const Solid solid = solid_of(
      {{"kind", "hull"}, {"points", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}}, {"radius", 0.5}}, 0);
  expect_closed(solid);
  const double exact = 1 + 4 * kPi * 0.25 / 2 + 4 * kPi / 3 * 0.125;
  EXPECT_LE(volume(solid), exact);
  EXPECT_GE(volume(solid), 0.92 * exact);
}

/// A hull of many corners grows by a small radius without a sphere at each of them: by at most the
/// radius, and by all of it along the axes.
TEST(StillSolids, ASmallRadiusTakesFewFaces) {
  Json points = Json::array();
  const Solid round = sphere(1);
  for (const Eigen::Vector3d& x : round.points) {
    for (const double value : x) points.push_back(value);
  }
  const Solid solid = solid_of({{"kind", "hull"}, {"points", points}, {"radius", 0.01}}, 0);
  expect_closed(solid);
  EXPECT_GT(volume(solid), volume(round) * 1.01);
  EXPECT_LT(volume(solid), volume(round) * 1.01 * 1.01 * 1.01);
  EXPECT_LT(solid.faces.size(), 8 * round.faces.size());
}

/// A ring without its ends; a tube of six sides has 0.827 of the area of its circle.
TEST(StillSolids, ARingHasTheVolumeOfItsTube) {
  const double turn = kPi, exact = 0.827 * kPi * 0.01 * turn;  // radius 1, tube 0.1
  EXPECT_NEAR(volume(ring(1, 0.1, turn)), exact, 0.02 * exact);
}

TEST(StillSolids, AMirrorKeepsTheOutside) {
  EXPECT_NEAR(volume(moved(box({1, 1, 1}), Eigen::Affine3d(Eigen::Scaling(-1.0, 2.0, 1.0)))), 2,
              1e-12);
}

/// A tetrahedron as `mesh_json` writes it: 16-bit shares of the box around it.
TEST(StillSolids, AMeshIsRead) {
  const std::string full = "\xff\xff", none("\0\0", 2);
  const std::string vertices =
      none + none + none + full + none + none + none + full + none + none + none + full;
  std::string triangles;
  for (const char i : {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}) triangles += {i, '\0', '\0', '\0'};
  const Json mesh = {{"kind", "mesh"},
                     {"pose", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}},
                     {"low", {1, 2, 3}},
                     {"extent", {6, 1, 1}},
                     {"vertices", base64(vertices)},
                     {"triangles", base64(triangles)}};
  const Solid solid = solid_of(mesh, 100);
  ASSERT_EQ(solid.faces.size(), 4U);
  EXPECT_NEAR(volume(solid), 1, 1e-12);
  EXPECT_FALSE(solid.closed);
}

/// Two boxes along y, seen from -y: the faces of the nearer one come last, whichever is added
/// first.
TEST(StillPainter, TheNearerBoxComesLast) {
  for (const bool near_first : {true, false}) {
    Painter painter(camera_from({0.1, -1, 0.1}));
    for (const bool near : {near_first, !near_first}) {
      Eigen::Affine3d to(Eigen::Translation3d(0.2, near ? 0 : 3, 0.2));
      painter.add(box({1, 1, 1}), to, near ? 0x0000FF : 0xFF0000);
    }
    // Of each box the front, the top and the right side are seen.
    ASSERT_EQ(painter.faces().size(), 6U);
    const std::vector<Face> ordered = depth_order(painter.faces(), 1e-3);
    ASSERT_EQ(ordered.size(), 6U);
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_EQ((ordered[i].colour & 0xFFU) > (ordered[i].colour >> 16U), i >= 3) << i;
    }
  }
}

/// The light is at the upper left: of the faces of a box that are seen, the top is the brightest
/// and the one to the right the darkest.
TEST(StillPainter, TheLightIsAtTheUpperLeft) {
  Painter painter(camera_from({1, -1, 1}));
  painter.add(box({1, 1, 1}), Eigen::Affine3d::Identity(), 0x808080);
  Rgb top = 0, left = 0, right = 0;
  for (const Face& face : painter.faces()) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& x : face.corners) middle += x / 4;
    (middle.y() > 0.1 ? top : middle.x() < 0 ? left : right) = face.colour;
  }
  EXPECT_GT(top, left);
  EXPECT_GT(left, right);
  EXPECT_GT(right, 0U);
}

/// Lines are drawn at the outline and at sharp edges: all edges of a box, but of a sphere only
/// those between what is seen and what is not.
TEST(StillPainter, OutlineAndSharpEdgesAreLines) {
  const auto lines = [](const Solid& solid) {
    Painter painter(camera_from({0.3, -1, 0.4}));
    painter.add(solid, Eigen::Affine3d::Identity(), 0x808080);
    std::pair<long, std::size_t> result{0, 0};
    for (const Face& face : painter.faces()) {
      result.first += std::count(face.lines.begin(), face.lines.end(), true);
      result.second += face.corners.size();
    }
    return result;
  };
  EXPECT_EQ(lines(box({1, 1, 1})), std::pair(12L, std::size_t{12}));
  const auto [of_sphere, edges] = lines(sphere(1));
  EXPECT_GT(of_sphere, 10);
  EXPECT_LT(of_sphere, static_cast<long>(edges / 4));
}

/// The line faces the viewer: seen from anywhere it is as wide as it should be.
TEST(StillPainter, ALineHasItsWidth) {
  Painter painter(camera_from({1, -1, 1}));
  painter.add_line({0, 0, 0}, {0, 0, 1}, 0.1, 0);
  const std::vector<Eigen::Vector3d>& corners = painter.faces().front().corners;
  EXPECT_NEAR((corners[3] - corners[0]).head<2>().norm(), 0.1, 1e-12);
  EXPECT_NEAR((corners[1] - corners[0]).norm(), 1, 1e-12);
}

}  // namespace
}  // namespace maxwrench
