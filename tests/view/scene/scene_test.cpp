#include "view/scene/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <nlohmann/json.hpp>

#include "maxwrench/load.h"
#include "maxwrench/trajectory.h"
#include "tests/support/kdl_chain.h"

namespace maxwrench {
namespace {

using Json = nlohmann::ordered_json;

Json scene_with_default(const Problem& problem) {
  const Eigen::MatrixXd theta_r = problem.theta_r_default.transpose();
  return scene_of(problem, {}, {{"default", evaluate(problem, theta_r)}});
}

Eigen::Matrix<double, 3, 4> pose(const Json& numbers, std::size_t i = 0) {
  Eigen::Matrix<double, 3, 4> result;
  for (std::size_t k = 0; k < 12; ++k) {
    result(static_cast<Eigen::Index>(k / 4), static_cast<Eigen::Index>(k % 4)) =
        numbers.at(12 * i + k).get<double>();
  }
  return result;
}

/// KDL computes the way from the base to the tool of its own reading of joints and placements.
TEST(Scene, LinksLeadFromTheBaseToTheToolAsKdlHasIt) {
  const Problem problem = load_problem("uvms/valve");
  const Json frame = scene_with_default(problem)["shown"][0]["frames"][0];
  ASSERT_EQ(frame["links"].size(), 12 * problem.robot.links.size());
  const KDL::Chain chain = kdl_chain(problem.robot);
  KDL::JntArray q(chain.getNrOfJoints());
  for (unsigned i = 0; i < q.rows(); ++i) q(i) = frame["theta"][i].get<double>();
  KDL::Frame to_tool;
  KDL::ChainFkSolverPos_recursive solver(chain);
  ASSERT_EQ(solver.JntToCart(q, to_tool), 0);
  const Eigen::Matrix<double, 3, 4> base = pose(frame["links"]);
  const Eigen::Map<const Eigen::Vector3d> p(to_tool.p.data);
  const Eigen::Vector3d tool = base.leftCols<3>() * p + base.col(3);
  EXPECT_LT((tool - problem.pose.p).norm(), 1e-12);
  EXPECT_LT((pose(frame["end_effector"]).col(3) - tool).norm(), 1e-12);
}

/// The tool's link and placement give the tool, of every task, at every instant.
TEST(Scene, TheToolIsWhereItsLinkCarriesIt) {
  for (const char* name : {"dual_arm/two_arms", "mobile/push_any_height", "fixed/push",
                           "planar/trajectory", "uvms/valve_impulse"}) {
    const Problem problem = load_problem(name);
    const Json scene = scene_with_default(problem);
    const Json& tool = scene["robot"]["end_effectors"][scene["task"]["end_effector"].get<int>()];
    ASSERT_FALSE(scene["shown"].empty()) << name;
    for (const Json& frame : scene["shown"][0]["frames"]) {
      const auto link = pose(frame["links"], tool["link"].get<std::size_t>());
      const auto placement = pose(tool["placement"]);
      const auto end = pose(frame["end_effector"]);
      EXPECT_LT((link.leftCols<3>() * placement.col(3) + link.col(3) - end.col(3)).norm(), 1e-7)
          << name;
      EXPECT_LT((link.leftCols<3>() * placement.leftCols<3>() - end.leftCols<3>()).norm(), 1e-7)
          << name;
    }
  }
}

/// The second arm of two_arms holds a rail along y through (0, -0.24, 0), its default place.
TEST(Scene, TheSecondToolTouchesItsSurface) {
  const Json scene = scene_with_default(load_problem("dual_arm/two_arms"));
  EXPECT_EQ(scene["task"]["contact"]["surface"], "line");
  const Json frame = scene["shown"][0]["frames"][0];
  EXPECT_LT((pose(frame["contact"]).col(3) - Eigen::Vector3d(0, -0.24, 0)).norm(), 1e-12);
  for (const Json& tool : scene["robot"]["end_effectors"]) {
    if (tool["name"] != "right_tool") continue;
    const auto link = pose(frame["links"], tool["link"].get<std::size_t>());
    const Eigen::Vector3d at = link.leftCols<3>() * pose(tool["placement"]).col(3) + link.col(3);
    EXPECT_LT((at - pose(frame["contact"]).col(3)).norm(), 1e-7);
  }
}

/// The greatest of c'v over the vertices v bounds beta c, a point of the set along c. All efforts
/// of these tasks have limits, so there is such a set.
TEST(Scene, TheSetReachesAsFarAsBeta) {
  for (const char* name : {"uvms/valve", "mobile/push", "planar/force"}) {
    const Json frame = scene_with_default(load_problem(name))["shown"][0]["frames"][0];
    const Json& polytope = frame["sets"]["polytope"];
    const std::size_t first = frame["sets"]["of"] == "torque" ? 3 : 0,
                      vertices = polytope["vertices"].size() / 3;
    double farthest = 0;
    for (std::size_t v = 0; v < vertices; ++v) {
      double along = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        along +=
            frame["c"][first + i].get<double>() * polytope["vertices"][3 * v + i].get<double>();
      }
      farthest = std::max(farthest, along);
    }
    EXPECT_GE(farthest, frame["beta"].get<double>() * (1 - 1e-5)) << name;
    for (const char* indices : {"triangles", "edges"}) {
      ASSERT_FALSE(polytope[indices].empty());
      for (const Json& i : polytope[indices]) EXPECT_LT(i.get<std::size_t>(), vertices);
    }
  }
}

TEST(Scene, AnInvalidPostureHasItsReasonAndNoEfforts) {
  const Problem problem = load_problem("planar/force");
  const Answer beyond = evaluate(problem, Eigen::RowVector2d(9, 9));
  const Json frame = scene_of(problem, {}, {{"given", beyond}})["shown"][0]["frames"][0];
  EXPECT_EQ(frame["status"], "invalid_posture");
  EXPECT_EQ(frame["reason"], "joint limit: shoulder at 9 rad, limits -1.0472 .. 1.0472");
  EXPECT_TRUE(frame["beta"].is_null());
  EXPECT_TRUE(frame["u"].empty());
  EXPECT_TRUE(frame["h"].empty());
  EXPECT_EQ(frame["links"].size(), 12 * problem.robot.links.size());
}

/// At its instants, a trajectory has the wrench and the efforts of its program.
TEST(Scene, InstantsAreThoseOfTheTrajectory) {
  const Problem problem = load_problem("planar/trajectory");
  const Answer answer = evaluate(problem, problem.theta_r_default.transpose());
  ASSERT_TRUE(answer.has_value());
  const Json frames = scene_of(problem, {}, {{"default", answer}})["shown"][0]["frames"];
  ASSERT_EQ(frames.size(), answer.trajectory.instants.size());
  double least = kInfinity;
  for (const Json& frame : frames) least = std::min(least, frame["beta"].get<double>());
  EXPECT_NEAR(least, answer.beta(), 1e-9);  // the value of a path is its least wrench
  EXPECT_EQ(frames.back()["t"], 10);
}

/// A page moves the row of the table whose time is nearest to its cursor.
TEST(Scene, EachRowOfTheTableHasItsTime) {
  for (const char* name : {"planar/trajectory", "uvms/valve_impulse",
                           MAXWRENCH_SOURCE_DIR "/examples/tasks/carry_steel_along.toml",
                           MAXWRENCH_SOURCE_DIR "/examples/tasks/two_link/luus.toml"}) {
    const Problem problem = load_problem(name);
    const Json scene = scene_with_default(problem);
    const auto times = scene["task"]["knot_times"].get<std::vector<double>>();
    EXPECT_EQ(times.size(), scene["shown"][0]["knots"].size()) << name;
    EXPECT_TRUE(std::is_sorted(times.begin(), times.end())) << name;
    if (problem.motion->transfer) {  // the ends are given
      EXPECT_GT(times.front(), 0) << name;
      EXPECT_LT(times.back(), problem.motion->T - 0.01) << name;
    }
  }
}

TEST(Scene, WithoutSolidsThereAreBars) {
  Problem problem = load_problem("planar/force");
  problem.robot.convex_bodies.clear();
  const Json links = scene_with_default(problem)["robot"]["links"];
  for (std::size_t i = 0; i < links.size(); ++i) {
    ASSERT_EQ(links[i]["bodies"].size(), 1U) << i;
    // The base encloses four thrusters and the shoulder; a link leads to its joint or tool.
    EXPECT_EQ(links[i]["bodies"][0]["points"].size(), i == 0 ? 15U : 6U) << i;
  }
}

TEST(Scene, VisualsStandForTheBodiesOfTheirLink) {
  const Problem problem = load_problem("fixed/push");
  const Eigen::MatrixXd theta_r = problem.theta_r_default.transpose();
  const Visual ball{2, Visual::Kind::kSphere, {}, {0.1, 0.1, 0.1}, "", {{1, 0, 0, 0.5}}};
  const Visual lost{3, Visual::Kind::kMesh, {}, {1, 1, 1}, "/nowhere.stl", {}};
  const Json plain = scene_with_default(problem)["robot"]["links"];
  const Json links =
      scene_of(problem, {ball, lost}, {{"default", evaluate(problem, theta_r)}})["robot"]["links"];
  ASSERT_EQ(links[2]["bodies"].size(), 1U);
  EXPECT_EQ(links[2]["bodies"][0]["kind"], "sphere");
  EXPECT_EQ(links[2]["bodies"][0]["opacity"], 0.5);
  EXPECT_EQ(links[3], plain[3]);  // a mesh that cannot be read hides nothing
}

}  // namespace
}  // namespace maxwrench
