#include "problems/loader/visuals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "problems/mesh/thin_out.h"
#include "tests/support/written_urdf.h"

namespace maxwrench {
namespace {

using urdf::joint, urdf::kLimit, urdf::link, urdf::UrdfTest;

std::string visual(const std::string& geometry, const std::string& more = "") {
  return "<visual>" + more + "<geometry>" + geometry + "</geometry></visual>";
}

class VisualsTest : public UrdfTest {
 protected:
  std::vector<Visual> visuals(const std::string& urdf, const std::string& toml = "") {
    return read_visuals(load(urdf, toml), {});
  }
};

TEST_F(VisualsTest, BodiesHaveTheirSizesPlacesAndColours) {
  const std::vector<Visual> all =
      visuals(link("base", 1,
                   visual("<box size='1 2 3'/>", "<origin xyz='0 0 4'/>") +
                       visual("<cylinder radius='0.5' length='2'/>", "<material name='sea'/>") +
                       visual("<sphere radius='2'/>",
                              "<material name='x'><color rgba='2 0.5 -1 0.25'/></material>")) +
              "<material name='sea'><color rgba='0 0.25 1 1'/></material>");
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].size, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(all[0].placement.p, Eigen::Vector3d(0, 0, 4));
  EXPECT_FALSE(all[0].colour);
  EXPECT_EQ(all[1].size, Eigen::Vector3d(1, 1, 2));
  EXPECT_EQ(all[1].colour, (std::array<double, 4>{0, 0.25, 1, 1}));
  EXPECT_EQ(all[2].size, Eigen::Vector3d(4, 4, 4));
  EXPECT_EQ(all[2].colour, (std::array<double, 4>{1, 0.5, 0, 0.25}));  // within 0 .. 1
}

/// A joint that is locked at a quarter turn about y carries its link, 1 m along x, and the ball on
/// it, at (1, 0, 0) of the link: to (1, 0, -1).
TEST_F(VisualsTest, ALockedLinkIsPartOfItsCarrier) {
  const std::vector<Visual> all = visuals(
      link("base") + link("arm", 1, visual("<sphere radius='1'/>", "<origin xyz='1 0 0'/>")) +
          joint("lock", "base", "arm"),
      "joints.lock.lock = 1.5707963267948966\n");
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].link, 0);
  EXPECT_LT((all[0].placement.p - Eigen::Vector3d(1, 0, -1)).norm(), 1e-12);
}

TEST_F(VisualsTest, LooksNeverMakeARobotUnreadable) {
  const Robot robot = load(link(
      "base", 1,
      visual("<box size='1 2'/>") + visual("<mesh filename='lost.stl'/>") + "<visual/>" +
          visual("<blob/>") + visual("<sphere radius='0'/>") + visual("<sphere radius='1'/>")));
  EXPECT_TRUE(robot.warnings.empty());
  ASSERT_EQ(robot.notes.size(), 1U);
  EXPECT_NE(robot.notes[0].find("link[base].visual: not shown: "), std::string::npos)
      << robot.notes[0];
  EXPECT_EQ(read_visuals(robot, {}).size(), 1U);
  std::filesystem::remove(folder_.path() / "robot.urdf");
  EXPECT_TRUE(read_visuals(robot, {}).empty());
  EXPECT_TRUE(read_visuals(Robot(), {}).empty());
}

TEST_F(VisualsTest, AUrdfAloneHasThemToo) {
  load(link("base") + link("arm", 1, visual("<sphere radius='1'/>")) +
       joint("turn", "base", "arm"));
  const Robot robot = load_urdf(folder_.path() / "robot.urdf");
  const std::vector<Visual> all = read_visuals(robot, {});
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].link, 1);
}

TEST_F(VisualsTest, AMeshIsAFileAndItsScale) {
  std::ofstream(folder_.path() / "one.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
  const std::vector<Visual> all =
      visuals(link("base", 1, visual("<mesh filename='one.obj' scale='1 -2 1'/>")));
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].size, Eigen::Vector3d(1, -2, 1));
  const std::vector<Triangles> parts = read_parts(all[0].mesh);
  ASSERT_EQ(parts.size(), 1U);
  const Triangles& mesh = parts[0];
  EXPECT_FALSE(mesh.colour);
  double area = 0;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const auto at = [&](int i) { return mesh.points[static_cast<std::size_t>(t[i])]; };
    area += (at(1) - at(0)).cross(at(2) - at(0)).z() / 2;
  }
  EXPECT_NEAR(area, 1, 1e-6);  // a square of two triangles, counterclockwise from above
}

/// A sphere of 2 * 200 * 199 triangles.
Triangles sphere() {
  constexpr int kRound = 200;
  Triangles mesh;
  for (int i = 0; i <= kRound; ++i) {
    for (int j = 0; j < kRound; ++j) {
      const double a = std::numbers::pi * i / kRound, b = 2 * std::numbers::pi * j / kRound;
      mesh.points.emplace_back(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a));
      const int here = i * kRound + j, next = i * kRound + (j + 1) % kRound;
      if (i == kRound) continue;
      mesh.triangles.emplace_back(here, here + kRound, next);
      mesh.triangles.emplace_back(next, here + kRound, next + kRound);
    }
  }
  return mesh;
}

/// The means of points within cells of a few per cent are that near the sphere, and the volume by
/// the divergence theorem is about 4/3 pi.
TEST(ThinnedOut, KeepsTheShapeWithFewTriangles) {
  const Triangles mesh = thinned_out(sphere(), 3000);
  EXPECT_LE(mesh.triangles.size(), 3000U);
  EXPECT_GE(mesh.triangles.size(), 800U);
  for (const Eigen::Vector3d& x : mesh.points) EXPECT_NEAR(x.norm(), 1, 0.03);
  double volume = 0;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const auto at = [&](int i) { return mesh.points[static_cast<std::size_t>(t[i])]; };
    volume += at(0).dot(at(1).cross(at(2))) / 6;
  }
  EXPECT_NEAR(volume, 4.0 / 3 * std::numbers::pi, 0.25);
}

TEST(ThinnedOut, LeavesSmallMeshesAlone) {
  const Triangles corner{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}},
                         {{0, 1, 2}, {0, 3, 2}, {1, 3, 2}}};
  const Triangles mesh = thinned_out(corner, 10);
  EXPECT_EQ(mesh.points.size(), 3U);     // one was there twice
  EXPECT_EQ(mesh.triangles.size(), 1U);  // twice, and one without area
  EXPECT_TRUE(thinned_out({}, 10).points.empty());
}

}  // namespace
}  // namespace maxwrench
