#include "view/still/still.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "maxwrench/load.h"
#include "tests/support/snake.h"
#include "view/scene/scene.h"

namespace maxwrench {
namespace {

using Json = nlohmann::ordered_json;

Json default_scene(const Problem& problem, const std::vector<Visual>& visuals = {}) {
  return scene_of(problem, visuals, {{"default", evaluate(problem, problem.theta_r_default)}});
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t i = text.find(part); i != std::string::npos; i = text.find(part, i + 1)) ++found;
  return found;
}

/// The value at the default posture is 9 N m: the joint about the vertical has that limit.
TEST(Still, SaysWhatItShows) {
  const std::string svg = still_figure(default_scene(load_problem("uvms/valve")), {});
  for (const char* text :
       {">default posture<", ">\u03b2 = 9.000 N m, optimal<", "uvms/valve: BlueROV2", "q1 shoulder",
        "yaw \u22129.00 N m", "rear right", ">h 9.000 N m<", "all torques in reach",
        "N of a force at the base"}) {
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  }
  EXPECT_LT(svg.size(), 200'000U);
}

/// An effort at its limit is red: #e11d30 in any light is redder than the others.
TEST(Still, EffortsAtTheirLimitAreRed) {
  const Problem problem = load_problem("planar/force");
  Json scene = default_scene(problem);
  Json& frame = scene["shown"][0]["frames"][0];
  const auto red_labels = [&](double u) {
    for (Json& value : frame["u"]) value = 0;
    frame["u"][0] = u;
    return count(still_figure(scene, {}), "fill=\"#c2182b\" text-anchor");
  };
  const double most = scene["robot"]["actuators"][0]["max"];
  EXPECT_EQ(red_labels(most), 1U);
  EXPECT_EQ(red_labels(0.9999 * most), 1U);  // "1.00", which is the limit
  EXPECT_EQ(red_labels(0.998 * most), 0U);   // "0.998"
}

TEST(Still, PosturesAreSideBySide) {
  const Problem problem = load_problem("planar/force");
  const Answer one = evaluate(problem, Eigen::RowVector2d(0.3, -0.7)),
               two = evaluate(problem, Eigen::RowVector2d(9, 9));
  const std::string svg =
      still_figure(scene_of(problem, {}, {{"given", one}, {"default", two}}), {});
  EXPECT_EQ(count(svg, "<linearGradient"), 2U);
  EXPECT_NE(svg.find(">given posture<"), std::string::npos);
  // It is drawn, and says what is wrong with it; its efforts have no values.
  EXPECT_NE(svg.find(">invalid posture: joint limit: shoulder at 9 rad"), std::string::npos);
  EXPECT_NE(svg.find(">shoulder<"), std::string::npos);
}

/// In one row, at the instants nearest to the times.
TEST(Still, ATrajectoryIsARow) {
  const Problem problem = load_problem("mobile/trajectory");
  const Json scene = default_scene(problem);
  const double end = problem.motion->T;
  const std::string svg = still_figure(scene, {0, end / 3, 2 * end / 3, end});
  EXPECT_EQ(count(svg, "<linearGradient"), 4U);
  EXPECT_EQ(count(svg, ">t = "), 4U);
  EXPECT_NE(svg.find(">t = 0 s<"), std::string::npos);
  EXPECT_NE(svg.find(">default trajectory: "), std::string::npos);
  std::set<std::string> tops;
  const std::regex title("y=\"([0-9.]+)\"[^>]*>t = ");
  for (std::sregex_iterator at(svg.begin(), svg.end(), title), last; at != last; ++at) {
    tops.insert((*at)[1]);
  }
  EXPECT_EQ(tops.size(), 1U);
}

TEST(Still, NothingToDraw) {
  Json scene = default_scene(load_problem("planar/force"));
  scene["shown"] = Json::array();
  EXPECT_THROW(still_figure(scene, {}), std::invalid_argument);
}

TEST(Still, WithoutSolidsThereAreBars) {
  Problem problem = load_problem("planar/force");
  problem.robot.convex_bodies.clear();
  EXPECT_GT(count(still_figure(default_scene(problem), {}), "<path"), 50U);
}

TEST(Still, FortyLinksHaveAPicture) {
  const Snake snake(40);
  const std::string svg = still_figure(default_scene(load_problem(snake.task())), {});
  EXPECT_LT(svg.size(), 1'500'000U);
  EXPECT_GT(count(svg, "<path"), 200U);
}

/// A mesh of 80,000 triangles, a wavy sheet, on each of two links.
TEST(Still, AHugeMeshIsThinnedOut) {
  const TemporaryFolder folder;
  std::ofstream mesh(folder.path() / "sheet.obj");
  constexpr int kSide = 200;
  for (int i = 0; i <= kSide; ++i) {
    for (int k = 0; k <= kSide; ++k) {
      mesh << "v " << 0.002 * i << ' ' << 0.002 * k << ' ' << 0.01 * std::sin(0.1 * (i + k))
           << '\n';
    }
  }
  for (int i = 0; i < kSide; ++i) {
    for (int k = 1; k <= kSide; ++k) {
      const int a = i * (kSide + 1) + k, b = a + kSide + 1;
      mesh << "f " << a << ' ' << b << ' ' << b + 1 << "\nf " << a << ' ' << b + 1 << ' ' << a + 1
           << '\n';
    }
  }
  mesh.close();
  std::vector<Visual> visuals;
  for (const int link : {0, 1}) {
    visuals.push_back({link, Visual::Kind::kMesh, {}, {1, 1, 1}, folder.path() / "sheet.obj", {}});
  }
  const std::string svg = still_figure(default_scene(load_problem("planar/force"), visuals), {});
  EXPECT_LT(svg.size(), 400'000U);
  EXPECT_GT(count(svg, "<path"), 300U);
}

/// Names of robots and tasks may hold anything.
TEST(Still, TextIsEscaped) {
  Problem problem = load_problem("planar/force");
  problem.name = "a < b & c";
  problem.robot.thrusters[0].name = "<left>";
  const std::string svg = still_figure(default_scene(problem), {});
  EXPECT_NE(svg.find("a &lt; b &amp; c"), std::string::npos);
  EXPECT_EQ(svg.find("<left>"), std::string::npos);
}

/// The floor of a robot that is not in water is just below it; water has a surface above.
TEST(Still, WaterHasASurface) {
  const auto waves = [](const char* name) {
    return count(still_figure(default_scene(load_problem(name)), {}), "stroke=\"#5bb3dd\"");
  };
  EXPECT_EQ(waves("uvms/lift"), 1U);
  EXPECT_EQ(waves("mobile/push"), 0U);
}

}  // namespace
}  // namespace maxwrench
