#include "drawing/depth_order.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lib/math/random.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

constexpr double kTolerance = 1e-3;

/// A square of this size at a depth, with its lower left corner at (x, y).
Face square(double x, double y, double size, double depth, Rgb colour) {
  return {{{x, y, depth}, {x + size, y, depth}, {x + size, y + size, depth}, {x, y + size, depth}},
          colour};
}

std::vector<Rgb> colours_of(const std::vector<Face>& faces) {
  std::vector<Rgb> colours;
  for (const Face& face : faces) colours.push_back(face.colour);
  return colours;
}

/// The distance of a point from the nearest edge of a convex face, below zero outside.
double inside(const Face& face, const Eigen::Vector2d& p) {
  double least = 1e9, turn = 0;
  const std::size_t n = face.corners.size();
  const auto at = [&](std::size_t i) { return Eigen::Vector2d(face.corners[i % n].head<2>()); };
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Eigen::Vector2d a = at(i) - at(0), b = at(i + 1) - at(0);
    turn += a.x() * b.y() - a.y() * b.x();
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d edge = at(i + 1) - at(i), from = p - at(i);
    const double side = (edge.x() * from.y() - edge.y() * from.x()) / edge.norm();
    least = std::min(least, turn > 0 ? side : -side);
  }
  return least;
}

/// By the plane through three corners.
double depth_at(const Face& face, const Eigen::Vector2d& p) {
  const Eigen::Vector3d normal =
      (face.corners[1] - face.corners[0]).cross(face.corners[2] - face.corners[0]);
  return face.corners[0].z() - normal.head<2>().dot(p - face.corners[0].head<2>()) / normal.z();
}

/// At random places, what is drawn last must be the nearest of all faces that were given.
void expect_nearest_on_top(const std::vector<Face>& given, const std::vector<Face>& ordered,
                           Random& random) {
  int compared = 0;
  for (int i = 0; i < 4000; ++i) {
    const Eigen::Vector2d p(random.uniform(-1, 1), random.uniform(-1, 1));
    double nearest = -1e9, next = -1e9;
    Rgb colour = 0;
    bool at_edge = false;
    for (const Face& face : given) {
      const double within = inside(face, p);
      at_edge = at_edge || std::abs(within) < 5 * kTolerance;
      if (within < 0) continue;
      const double depth = depth_at(face, p);
      next = std::max(next, std::min(depth, nearest));
      if (depth > nearest) colour = face.colour;
      nearest = std::max(nearest, depth);
    }
    if (at_edge || nearest - next < 5 * kTolerance) continue;
    const auto top = std::find_if(ordered.rbegin(), ordered.rend(),
                                  [&](const Face& face) { return inside(face, p) > 0; });
    if (top == ordered.rend()) {
      EXPECT_EQ(nearest, -1e9);
      continue;
    }
    ++compared;
    EXPECT_EQ(top->colour, colour) << p.transpose();
  }
  EXPECT_GT(compared, 200);
}

TEST(DepthOrder, TheNearerOfTwoComesLast) {
  const Face near = square(0, 0, 1, 2, 0xAA), far = square(0.5, 0.5, 1, 1, 0xBB);
  const std::vector<Rgb> expected = {0xBB, 0xAA};
  EXPECT_EQ(colours_of(depth_order({near, far}, kTolerance)), expected);
  EXPECT_EQ(colours_of(depth_order({far, near}, kTolerance)), expected);
}

/// A strip leads from depth 10 at x = 0 to depth 0 at x = 10; a square at x = 9 .. 10 has depth 2.
/// The strip's middle is nearer, but where both are, the strip is at most at depth 1.
TEST(DepthOrder, WhereTheyOverlapCountsAndNotTheirMiddle) {
  const Face strip{{{0, 0, 10}, {10, 0, 0}, {10, 1, 0}, {0, 1, 10}}, 0xAA};
  const Face tile = square(9, 0, 1, 2, 0xBB);
  const std::vector<Rgb> expected = {0xAA, 0xBB};
  EXPECT_EQ(colours_of(depth_order({strip, tile}, kTolerance)), expected);
  EXPECT_EQ(colours_of(depth_order({tile, strip}, kTolerance)), expected);
}

/// Two squares cross along x = 0: one has depth x, the other -x. Each is in front on one side.
TEST(DepthOrder, FacesThatPierceEachOtherAreCut) {
  const Face rises{{{-1, -1, -1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, -1}}, 0xAA};
  const Face falls{{{-1, -1, 1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, 1}}, 0xBB};
  const std::vector<Face> ordered = depth_order({rises, falls}, kTolerance);
  ASSERT_EQ(ordered.size(), 3U);
  const auto top_at = [&](double x) {
    return std::find_if(ordered.rbegin(), ordered.rend(),
                        [x](const Face& face) {
                          return inside(face, {x, 0.1}) > 0;
                        })
        ->colour;
  };
  EXPECT_EQ(top_at(0.5), 0xAAU);
  EXPECT_EQ(top_at(-0.5), 0xBBU);
}

/// A cut is no edge of the body: it has no line, and the edges that it divides keep theirs.
TEST(DepthOrder, ACutHasNoLine) {
  Face rises{{{-1, -1, -1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, -1}}, 0xAA};
  rises.lines = {true, true, true, true};
  const Face flat = square(-2, -2, 4, 0, 0xBB);
  const std::vector<Face> ordered = depth_order({flat, rises}, kTolerance);
  ASSERT_EQ(ordered.size(), 3U);
  for (const Face& face : ordered) {
    if (face.colour != 0xAA) continue;
    ASSERT_EQ(face.lines.size(), 4U);
    EXPECT_EQ(std::count(face.lines.begin(), face.lines.end(), true), 3);
    for (std::size_t i = 0; i < 4; ++i) {
      const bool on_cut = face.corners[i].x() == 0 && face.corners[(i + 1) % 4].x() == 0;
      EXPECT_EQ(face.lines[i], !on_cut);
    }
  }
}

/// Three bars that lie on each other in a ring have no order; one must be divided.
TEST(DepthOrder, ARingIsOpened) {
  const auto bar = [](double angle, Rgb colour) {
    const Eigen::Rotation2Dd turn(angle);
    Face face{{}, colour};
    for (const Eigen::Vector3d& x :
         {Eigen::Vector3d(-0.9, 0.25, 1), Eigen::Vector3d(0.9, 0.25, -1),
          Eigen::Vector3d(0.9, 0.4, -1), Eigen::Vector3d(-0.9, 0.4, 1)}) {
      const Eigen::Vector2d p = turn * x.head<2>();
      face.corners.emplace_back(p.x(), p.y(), x.z());
    }
    return face;
  };
  const double third = 2 * EIGEN_PI / 3;
  const std::vector<Face> bars = {bar(0, 1), bar(third, 2), bar(2 * third, 3)};
  Random random(1);
  const std::vector<Face> ordered = depth_order(bars, kTolerance);
  EXPECT_GT(ordered.size(), 3U);
  expect_nearest_on_top(bars, ordered, random);
}

/// Any triangles, most of which pierce others, compared with the depth at each place.
TEST(DepthOrder, TheNearestIsOnTopEverywhere) {
  Random random(7);
  for (int round = 0; round < samples(10); ++round) {
    std::vector<Face> faces;
    for (Rgb i = 1; i <= 40; ++i) {
      Face face{{}, i};
      const Eigen::Vector3d middle(random.uniform(-1, 1), random.uniform(-1, 1),
                                   random.uniform(-1, 1));
      for (int k = 0; k < 3; ++k) {
        face.corners.push_back(middle + 0.5 * Eigen::Vector3d(random.uniform(-1, 1),
                                                              random.uniform(-1, 1),
                                                              random.uniform(-1, 1)));
      }
      faces.push_back(face);
    }
    expect_nearest_on_top(faces, depth_order(faces, kTolerance), random);
  }
}

TEST(DepthOrder, InOnePlaneTheLaterIsInFront) {
  const Face first = square(0, 0, 1, 1, 1), second = square(0.5, 0, 1, 1, 2);
  EXPECT_EQ(colours_of(depth_order({first, second}, kTolerance)), (std::vector<Rgb>{1, 2}));
  EXPECT_EQ(colours_of(depth_order({second, first}, kTolerance)), (std::vector<Rgb>{2, 1}));
}

TEST(DepthOrder, LeavesOutWhatIsSeenFromItsEdge) {
  const Face edge{{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}, 1}, none{{}, 2};
  EXPECT_TRUE(depth_order({edge, none}, kTolerance).empty());
  EXPECT_TRUE(depth_order({}, kTolerance).empty());
}

}  // namespace
}  // namespace maxwrench
