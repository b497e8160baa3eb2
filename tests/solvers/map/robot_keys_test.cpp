#include "solvers/map/robot_keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "maxwrench/bound.h"
#include "maxwrench/load.h"
#include "maxwrench/solve.h"
#include "tests/support/coded_tasks.h"
#include "tests/support/maps.h"
#include "tests/support/scenario_task.h"

namespace maxwrench {
namespace {

using testing::HasSubstr;

constexpr const char* kCarried = "[payload]\ncom = [0.05, 0.01, 0.02]\nvolume_per_kg = 1.274e-4\n";

/// A task of the underwater vehicle with changes of the robot's file: texts and what replaces them,
/// and further tables.
Problem edited_task(const std::string& wrench, const std::string& tables,
                    const std::vector<std::pair<std::string, std::string>>& changes,
                    const std::string& robot_tables = "") {
  const std::string folder = MAXWRENCH_SOURCE_DIR "/problems/uvms/";
  std::string robot = read_text(folder + "bluerov2_alpha5.toml");
  const auto replace = [](std::string& text, const std::string& from, const std::string& to) {
    ASSERT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.find(from), from.size(), to);
  };
  replace(robot, "\"bluerov2_alpha5.urdf\"", "\"" + folder + "bluerov2_alpha5.urdf\"");
  for (const auto& [from, to] : changes) replace(robot, from, to);
  std::string task = read_text(folder + "lift.toml");
  const std::size_t from = task.find("[wrench]"), to = task.find("[theta_r]");
  task.replace(from, to - from, wrench.empty() ? "" : "[wrench]\n" + wrench + "\n\n");
  replace(task, "bluerov2_alpha5.toml", "robot.toml");
  const TemporaryFolder temporary;
  std::ofstream(temporary.path() / "robot.toml") << robot << "\n" << robot_tables;
  std::ofstream(temporary.path() / "task.toml") << task << "\n" << tables;
  return load_problem((temporary.path() / "task.toml").string());
}

Problem with_value(const Problem& task, const std::string& key, double value) {
  return posed(task, {{key, value, value, 1}}, Eigen::VectorXd::Constant(1, value));
}

/// The two tasks have the same status and value at postures around the default one. Returns whether
/// one of the values differs from that of `before`.
bool expect_same_values(const Problem& got, const Problem& expected, const Problem& before,
                        const std::string& what) {
  bool changes = false;
  for (const double turn : {0.0, 0.2, -0.15, 0.6, 1.0}) {
    Eigen::VectorXd theta_r = before.theta_r_default;
    theta_r[0] -= turn;
    theta_r[1] += turn;
    theta_r[2] += turn;
    const Answer one = evaluate(got, theta_r), other = evaluate(expected, theta_r);
    EXPECT_EQ(one.status, other.status) << what;
    if (!other.has_value()) continue;
    EXPECT_NEAR(one.beta(), other.beta(), 1e-9 * (1 + std::abs(other.beta()))) << what;
    EXPECT_EQ(one.unit, other.unit) << what;
    changes = changes || std::abs(evaluate(before, theta_r).beta() - other.beta()) > 1e-4;
  }
  return changes;
}

/// A key with a value is what a robot's file with this value gives, alone and in lists of
/// scenarios: losses, uncertain loads with volumes, a payload.
TEST(RobotKeys, AreThoseOfTheFile) {
  const std::string volumes = std::string(kParameters) + "volume.vehicle = 0.0004\n";
  struct Key {
    std::string name;
    double value;
    std::pair<std::string, std::string> change;
  };
  const std::vector<Key> keys = {
      {"environment.gravity", 3.7, {"gravity = 9.81", "gravity = 3.7"}},
      {"environment.water_density", 1025, {"water_density = 998", "water_density = 1025"}},
      {"trim.buoyancy_mass", -1.5, {"buoyancy_mass = 0.808", "buoyancy_mass = -1.5"}},
      {"links.link_4.mass", 1.25, {"[base]", "[links.link_4]\nmass = 1.25\n\n[base]"}},
      {"links.vehicle.mass", 14.7, {"[base]", "[links.vehicle]\nmass = 14.7\n\n[base]"}}};
  for (const Key& key : keys) {
    bool changes = false;
    for (const std::string& tables :
         {std::string(), std::string("[loss]\nany = 1\n"), volumes, std::string(kCarried)}) {
      const bool carries = tables == kCarried;
      if (carries && key.name == "environment.water_density") continue;
      if (tables == volumes && key.name == "links.link_4.mass") continue;
      const std::string wrench = carries ? "" : kLift;
      const Problem task = scenario_task(wrench, tables);
      const Problem edited = edited_task(wrench, tables, {key.change});
      const Problem here = with_value(task, key.name, key.value);
      changes = expect_same_values(here, edited, task, key.name + " " + tables) || changes;
    }
    EXPECT_TRUE(changes) << key.name;
  }
}

/// A current by its components is that of the task's file, also from a list, and back to none.
TEST(RobotKeys, CurrentsAreThoseOfTheFile) {
  const std::string current = "[environment]\ncurrent = [0.3, -0.2, 0.1]\n";
  const std::vector<MapAxis> over = {{"environment.current.z", 0.1, 0.1, 1},
                                     {"environment.current.x", 0.3, 0.3, 1},
                                     {"environment.current.y", -0.2, -0.2, 1}};
  for (const std::string& tables : {std::string(), std::string("[loss]\nany = 1\n")}) {
    const Problem still = scenario_task(kLift, tables);
    const Problem flowing = scenario_task(kLift, tables + current);
    const Problem there = posed(still, over, Eigen::Vector3d(0.1, 0.3, -0.2));
    EXPECT_TRUE(expect_same_values(there, flowing, still, tables));
    const Problem back = posed(flowing, over, Eigen::Vector3d(0, 0, 0));
    EXPECT_TRUE(expect_same_values(back, still, flowing, tables));
  }
  // Any wrenches: the free components are those of the file.
  Options any;
  any.wrench = Wrench::kAny;
  const Problem still = scenario_task(kLift, ""), flowing = scenario_task(kLift, current);
  EXPECT_NEAR(
      evaluate(posed(still, over, Eigen::Vector3d(0.1, 0.3, -0.2)), still.theta_r_default, any)
          .beta(),
      evaluate(flowing, still.theta_r_default, any).beta(), 1e-8);
}

/// A carried point is the payload of an uncertain mass that has its full width.
TEST(RobotKeys, ACarriedPointIsAnUncertainOneAtItsWidth) {
  const Problem task = load_problem("uvms/lift");
  Problem full = scenario_task(kLift, "[uncertainty.payload]\nmass = 1.5\n");
  ASSERT_EQ(full.scenarios.loads.size(), 1u);
  full.scenarios.loads[0] = {full.scenarios.loads[0][1]};
  EXPECT_TRUE(expect_same_values(with_value(task, "payload.mass", 1.5), full, task, "carried"));
}

/// Without mass, a body leaves its link as it is without it; the masses of a link add up.
/// A width or a radius with a value is what a task's file with this value gives, with the same
/// names of scenarios.
TEST(RobotKeys, NumbersOfAListAreThoseOfTheFile) {
  struct Key {
    std::string name, wrench, tables, edited;
    double value;
  };
  const std::string mass = "[uncertainty]\nmass.link_4 = ", cone = "c = [1, 0, 0, 0, 0, 0]\n";
  const std::string lost = "thrust = 0.1\n[loss]\ncases = [['front_left_vertical']]\n";
  const std::string ball = "ball = { axes = ['fy', 'fz'], radius = ";
  for (const Key& key : std::vector<Key>{
           {"uncertainty.trim", kLift, "[uncertainty]\ntrim = 0.2\ncom.link_2 = [0.01, 0, 0]\n",
            "[uncertainty]\ntrim = 0.5\ncom.link_2 = [0.01, 0, 0]\n", 0.5},
           {"uncertainty.mass.link_4", kLift, mass + "0.1\n" + lost, mass + "0.3\n" + lost, 0.3},
           {"uncertainty.mass.vehicle", kLift, "[uncertainty]\nmass.vehicle = '1%'\n",
            "[uncertainty]\nmass.vehicle = 0.02\n", 0.02},
           {"uncertainty.volume.vehicle", kLift, "[uncertainty]\nvolume.vehicle = 0.0001\n",
            "[uncertainty]\nvolume.vehicle = 0.0004\n", 0.0004},
           {"uncertainty.payload.mass", kLift,
            "[uncertainty]\npayload = { mass = 1, com = [0.1, 0, 0.02] }\n",
            "[uncertainty]\npayload = { mass = 0.4, com = [0.1, 0, 0.02] }\n", 0.4},
           {"wrench.ball.radius", cone + ball + "0.2 }", "", cone + ball + "0.7 }", 0.7}}) {
    const bool radius = key.tables.empty();
    const Problem task = scenario_task(key.wrench, key.tables);
    const Problem edited =
        radius ? scenario_task(key.edited, "") : scenario_task(key.wrench, key.edited);
    const Problem here = with_value(task, key.name, key.value);
    EXPECT_TRUE(expect_same_values(here, edited, task, key.name)) << key.name;
    const auto decides = [](const Problem& of) {
      return describe(of.scenarios, evaluate(of, of.theta_r_default).capability.decides);
    };
    EXPECT_EQ(decides(here), decides(edited));
  }
}

TEST(RobotKeys, BodiesOfALinkAddUp) {
  const Problem task = load_problem("uvms/lift");
  for (const double mass : {0.0, 0.5, 40.0}) {
    for (const BodyPart& part : task.robot.parts) {
      const Robot robot = with_value(task, "links." + part.name + ".mass", mass).robot;
      const Link& link = robot.links[static_cast<std::size_t>(part.link)];
      double sum = 0;
      Eigen::Vector3d moment = Eigen::Vector3d::Zero();
      for (const BodyPart& each : robot.parts) {
        if (each.link != part.link) continue;
        sum += each.mass;
        moment += each.mass * (each.frame.R * each.com + each.frame.p);
      }
      EXPECT_NEAR(link.mass, sum, 1e-12) << part.name;
      EXPECT_LT((link.mass * link.com - moment).norm(), 1e-12) << part.name;
      EXPECT_TRUE(link.inertia.allFinite());
    }
  }
}

/// At a point the bound of a payload whose pose has turned is its value there: the weight does not
/// turn with the pose.
TEST(RobotKeys, BoundsOfATurnedPayloadAreItsValues) {
  const Problem task = scenario_task("", "[payload]\ncom = [0.4, 0, 0.3]\n");
  const Problem here = with_value(task, "pitch", -1.2);
  const Answer answer = solve(here, with_budget(500, 1));
  ASSERT_TRUE(answer.has_value());
  const auto bound = make_capability_bound(here, "linf_polytope", Wrench::kPure);
  const Eigen::VectorXd& at = answer.posture.theta_r;
  BoxProof proof;
  bound->evaluate(at, at, 0, bound->ceiling(), proof);
  EXPECT_NEAR(proof.high, answer.beta(), 1e-6 * answer.beta());
}

/// A map over keys has the values of its postures, and units.
TEST(RobotKeys, MapsHaveTheValuesOfTheirPostures) {
  const Problem task = load_problem("uvms/lift");
  const MapPlan plan =
      plan_over({{"environment.water_density", 900, 1100, 2}, {"links.link_4.mass", 0, 3, 3}});
  const CapabilityMap found = map(task, plan, with_budget(200));
  ASSERT_EQ(found.cells.size(), 6u);
  EXPECT_TRUE(found.unchanging.empty());
  for (const MapCell& cell : found.cells) {
    ASSERT_EQ(cell.status, Status::kBestFound);
    const Problem here = edited_task(
        kLift, "",
        {{"density = 998", "density = " + std::to_string(cell.at[0])},
         {"[base]", "[links.link_4]\nmass = " + std::to_string(cell.at[1]) + "\n[base]"}});
    EXPECT_NEAR(evaluate(here, cell.theta_r).beta(), cell.beta, 1e-6);
  }
  EXPECT_STREQ(map_unit("environment.water_density"), "kg/m^3");
  EXPECT_STREQ(map_unit("environment.current.y"), "m/s");
  EXPECT_STREQ(map_unit("links.link_4.mass"), "kg");
}

struct BadKey {
  const char* name;
  std::string wrench, tables;
  MapAxis axis;
  const char* line;
};
void PrintTo(const BadKey& bad, std::ostream* out) { *out << bad.name; }

class BadRobotKey : public testing::TestWithParam<BadKey> {};

TEST_P(BadRobotKey, IsRejectedInOneLine) {
  const BadKey& bad = GetParam();
  const Problem task = scenario_task(bad.wrench, bad.tables);
  const std::string line = rejection_of([&] { map(task, plan_over({bad.axis})); });
  EXPECT_THAT(line, HasSubstr("over: got '" + bad.axis.name));
  EXPECT_THAT(line, HasSubstr(bad.line));
  EXPECT_EQ(line.find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    All, BadRobotKey,
    testing::Values(
        BadKey{"Gravity", kLift, "", {"environment.gravity", -1, 1, 2}, "values of at least 0"},
        BadKey{"Weightless", "", kCarried, {"environment.gravity", 0, 1, 2}, "values above 0"},
        BadKey{"NoWater", kLift, "", {"environment.water_density", 0, 1, 2}, "densities above 0"},
        BadKey{"NegativeDensity", kLift, "", {"environment.water_density", -9, 1, 2}, "at least 0"},
        BadKey{"DensityOfPayload",
               "",
               kCarried,
               {"environment.water_density", 9, 99, 2},
               "the payload is heavier"},
        BadKey{"Fast", kLift, "", {"environment.current.x", 0, 101, 2}, "at most 100 m/s"},
        BadKey{"UncertainCurrent",
               kLift,
               "[uncertainty]\ncurrent = { speed = 0.3 }\n",
               {"environment.current.x", 0, 1, 2},
               "the current of the task is uncertain"},
        BadKey{"CurrentOfPayload", "", kCarried, {"environment.current.x", 0, 1, 2}, "a payload"},
        BadKey{"UnknownBody",
               kLift,
               "",
               {"links.wing.mass", 0, 1, 2},
               "the mass of one of the bodies vehicle, base, link_1"},
        BadKey{"UnknownKey", kLift, "", {"links.link_4.com", 0, 1, 2}, "links.NAME.mass"},
        BadKey{"NegativeMass", kLift, "", {"links.link_4.mass", -1, 1, 2}, "masses of at least 0"},
        BadKey{"UncertainMass",
               kLift,
               kParameters,
               {"links.link_4.mass", 0, 1, 2},
               "this body is uncertain"},
        BadKey{"UncertainCentre",
               kLift,
               kParameters,
               {"links.link_2.mass", 0, 1, 2},
               "this body is uncertain"},
        BadKey{"NoBall", kLift, "", {"wrench.ball.radius", 1, 2, 2}, "no ball of wrenches"},
        BadKey{"UnitBall",
               "ball = { axes = ['fx', 'fy'], radius = 1 }",
               "",
               {"wrench.ball.radius", 1, 2, 2},
               "in N the value is that of a ball of radius 1"},
        BadKey{"EmptyBall",
               "ball = { axes = ['fx', 'fy'], radius = 2 }",
               "",
               {"wrench.ball.radius", 0, 2, 2},
               "radii above 0"},
        BadKey{"KnownTrim", kLift, "", {"uncertainty.trim", 0, 1, 2}, "does not have it"},
        BadKey{"WidthBesideACentre",
               kLift,
               kParameters,
               {"uncertainty.mass.link_2", 0, 0.01, 2},
               "the body's centre is uncertain as well"},
        BadKey{"NegativeWidth", kLift, kParameters, {"uncertainty.trim", -1, 1, 2}, "at least 0"},
        BadKey{"WidthAboveTheMass",
               kLift,
               kParameters,
               {"uncertainty.mass.link_4", 0, 100, 2},
               "at most the nominal value"},
        BadKey{"Carried", kLift, "", {"payload.mass", -1, 1, 2}, "masses of at least 0"},
        BadKey{"CarriedTwice", "", kCarried, {"payload.mass", 0, 1, 2}, "mass of its payload"},
        BadKey{
            "Limit", kLift, "", {"joints.q3_elbow.effort", 1, 2, 2}, "or the name of an actuator"}),
    [](const auto& bad) { return std::string(bad.param.name); });

}  // namespace
}  // namespace maxwrench
