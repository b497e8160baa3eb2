#include "drawing/camera.h"

#include <gtest/gtest.h>

#include <cmath>

namespace maxwrench {
namespace {

void expect_seen(const Camera& camera, const Eigen::Vector3d& x, const Eigen::Vector3d& expected) {
  EXPECT_LT((camera(x) - expected).norm(), 1e-15) << x.transpose();
}

/// From -y: x is to the right, z up, and y leads away.
TEST(Camera, FromTheFront) {
  const Camera camera = camera_from({0, -3, 0});
  expect_seen(camera, {1, 2, 5}, {1, 5, -2});
}

/// From above, y is up.
TEST(Camera, FromAbove) {
  const Camera camera = camera_from({0, 0, 7});
  expect_seen(camera, {1, 2, 5}, {1, 2, 5});
}

/// The isometric view from (1, -1, 1): the axes x and y are at 30 degrees below and above the
/// horizontal, all three have the length sqrt(2/3), and the viewer is at the same distance of each.
///   right = z × (1, -1, 1) / |.| = (1, 1, 0) / sqrt 2
///   up = (1, -1, 1) / sqrt 3 × right = (-1, 1, 2) / sqrt 6
TEST(Camera, Isometric) {
  const Camera camera = camera_from({1, -1, 1});
  const double r = 1 / std::sqrt(2), u = 1 / std::sqrt(6), t = 1 / std::sqrt(3);
  expect_seen(camera, {1, 0, 0}, {r, -u, t});
  expect_seen(camera, {0, 1, 0}, {r, u, -t});
  expect_seen(camera, {0, 0, 1}, {0, 2 * u, t});
}

/// The page's view (0.75, -1, 0.62): right = (1, 0.75, 0) / 1.25 = (0.8, 0.6, 0).
TEST(Camera, ThreeQuarters) {
  const Camera camera = camera_from({0.75, -1, 0.62});
  EXPECT_NEAR(camera(Eigen::Vector3d(1, 0, 0)).x(), 0.8, 1e-15);
  EXPECT_NEAR(camera(Eigen::Vector3d(0, 1, 0)).x(), 0.6, 1e-15);
  // up.z = |(0.75, 1)| / |(0.75, 1, 0.62)| = 1.25 / sqrt(1.9469)
  EXPECT_NEAR(camera(Eigen::Vector3d(0, 0, 1)).y(), 1.25 / std::sqrt(1.9469), 1e-15);
  EXPECT_LT((camera.axes.transpose() * camera.axes - Eigen::Matrix3d::Identity()).norm(), 1e-15);
}

}  // namespace
}  // namespace maxwrench
