#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "maxwrench/capability.h"
#include "maxwrench/load.h"
#include "tests/support/coded_tasks.h"

namespace maxwrench {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;

TaskSpec valve_with(const UncertaintySpec& uncertainty) {
  TaskSpec task = valve();
  task.uncertainty = uncertainty;
  return task;
}

std::vector<std::string> names_of_cases(const LoadGroup& group) {
  std::vector<std::string> names;
  for (const LoadCase& each : group) names.push_back(each.name);
  return names;
}

void expect_load(const LoadCase& one, int link, double mass, const Vector3d& moment) {
  SCOPED_TRACE(one.name);
  ASSERT_EQ(one.loads.size(), 1u);
  EXPECT_EQ(one.loads[0].link, link);
  EXPECT_NEAR(one.loads[0].mass, mass, 1e-15);
  EXPECT_LT((one.loads[0].moment - moment).norm(), 1e-15) << one.loads[0].moment.transpose();
  EXPECT_TRUE(one.current.isZero(0));
}

TEST(UncertainLoads, CornersOfMassAndCentre) {
  UncertaintySpec uncertainty;
  uncertainty.mass = {{"link_2", 0.038}};
  uncertainty.com = {{"link_2", {0.01, 0, 0}}};
  const ScenarioList list = make_problem(valve_with(uncertainty)).scenarios;
  ASSERT_EQ(list.loads.size(), 1u);
  const LoadGroup& group = list.loads[0];
  EXPECT_THAT(
      names_of_cases(group),
      ElementsAre("link_2 mass +0.038 kg, com.x +0.01 m", "link_2 mass -0.038 kg, com.x +0.01 m",
                  "link_2 mass +0.038 kg, com.x -0.01 m", "link_2 mass -0.038 kg, com.x -0.01 m"));
  // 0.38 kg at (0.0746, 0.00055, 0) in the file.
  expect_load(group[0], 2, 0.038, {0.418 * 0.0846 - 0.38 * 0.0746, 0.038 * 0.00055, 0});
  expect_load(group[1], 2, -0.038, {0.342 * 0.0846 - 0.38 * 0.0746, -0.038 * 0.00055, 0});
  expect_load(group[2], 2, 0.038, {0.418 * 0.0646 - 0.38 * 0.0746, 0.038 * 0.00055, 0});
  expect_load(group[3], 2, -0.038, {0.342 * 0.0646 - 0.38 * 0.0746, -0.038 * 0.00055, 0});
  ASSERT_EQ(list.limits.size(), 1u);
}

/// The arm's foot is fixed to the vehicle, turned by half a turn about x: its y and z are those of
/// the vehicle with the other sign.
TEST(UncertainLoads, ABodyOnAFixedJoint) {
  UncertaintySpec uncertainty;
  uncertainty.mass = {{"base", 0.02}};
  uncertainty.cob = {{"base", {0, 0, 0.01}}};
  uncertainty.com = {{"vehicle", {0, 0.01, 0}}};
  const ScenarioList list = make_problem(valve_with(uncertainty)).scenarios;
  ASSERT_EQ(list.loads.size(), 3u);
  // The vehicle's comes first, as in the URDF.
  expect_load(list.loads[0][0], 0, 0, {0, 0.145, 0});
  expect_load(list.loads[1][0], 0, 0.02, 0.02 * Vector3d(0.203 - 0.065, 0, -0.1317));
  EXPECT_EQ(list.loads[1][0].name, "base mass +0.02 kg");
  expect_load(list.loads[2][0], 0, 0, {0, 0, 998 * 0.00016 * 0.01});
  EXPECT_EQ(list.loads[2][0].name, "base cob.z +0.01 m");
}

TEST(UncertainLoads, BuoyancyCarries) {
  UncertaintySpec uncertainty;
  uncertainty.volume = {{"link_4", 1e-5}};
  uncertainty.cob = {{"link_4", {0, 0.01, 0}}};
  const LoadGroup group = make_problem(valve_with(uncertainty)).scenarios.loads.at(0);
  ASSERT_EQ(group.size(), 4u);
  EXPECT_EQ(group[0].name, "link_4 volume +1e-05 m^3, cob.y +0.01 m");
  expect_load(group[0], 4, -0.00998, -998 * Vector3d(0, 1.44e-4 * 0.01, -1e-5 * 0.1195));
}

/// Each case tells its changes by the keys of the task.
TEST(UncertainLoads, CasesHaveDeltas) {
  UncertaintySpec uncertainty;
  uncertainty.mass = {{"link_4", 0.1}, {"link_2", 0.05}};
  uncertainty.com = {{"link_4", {0.01, 0, 0.02}}};
  uncertainty.cob = {{"vehicle", {0, 0, 0.005}}};
  uncertainty.trim = 0.2;
  uncertainty.payload_mass = 0.5;
  uncertainty.current_speed = 0.3;
  uncertainty.current_directions = 4;
  const Problem task = make_problem(valve_with(uncertainty));
  // link_2, link_4, the buoyancy of the vehicle, trim, payload, current.
  ASSERT_EQ(task.scenarios.loads.size(), 6u);
  ScenarioChoice choice;
  choice.cases = {1, 5, 0, 1, 0, 2};  // of link_4, bits 0 and 2 of its corner: mass and com.z less
  const ScenarioData data = scenario_data(task, choice);
  ASSERT_EQ(data.deltas.size(), 6u);
  const auto expect = [&](std::size_t i, const char* key, const Eigen::VectorXd& change) {
    EXPECT_EQ(data.deltas[i].key, key);
    EXPECT_EQ(data.deltas[i].change, change) << key;
  };
  const auto one = [](double x) { return Eigen::VectorXd::Constant(1, x); };
  expect(0, "mass.link_2", one(-0.05));
  expect(1, "mass.link_4", one(-0.1));
  expect(2, "com.link_4", Vector3d(0.01, 0, -0.02));
  expect(3, "cob.vehicle", Vector3d(0, 0, 0.005));
  expect(4, "trim", one(-0.2));
  expect(5, "payload.mass", one(0));
  ASSERT_TRUE(data.current);
  EXPECT_LT((*data.current - Vector3d(0, 0.3, 0)).norm(), 1e-15);
  EXPECT_TRUE(data.wrench.empty() && data.dead.empty() && data.weaker.empty());
  choice.cases.back() = 0;
  EXPECT_EQ(*scenario_data(task, choice).current, Vector3d(0, 0, 0));
  EXPECT_EQ(describe(task.scenarios, choice),
            "link_2 mass -0.05 kg; link_4 mass -0.1 kg, com.x +0.01 m, com.z -0.02 m; vehicle "
            "cob.z +0.005 m; trim -0.2 kg");
}

TEST(UncertainLoads, TrimAndAnUnknownPayload) {
  UncertaintySpec uncertainty;
  uncertainty.trim = 0.2;
  uncertainty.payload_mass = 0.5;
  uncertainty.payload_com = {0.05, 0, 0.02};
  const ScenarioList list = make_problem(valve_with(uncertainty)).scenarios;
  ASSERT_EQ(list.loads.size(), 2u);
  EXPECT_THAT(names_of_cases(list.loads[0]), ElementsAre("trim +0.2 kg", "trim -0.2 kg"));
  const Vector3d at(0.086, 0, -0.109);
  expect_load(list.loads[0][0], 0, -0.2, -0.2 * at);
  expect_load(list.loads[0][1], 0, 0.2, 0.2 * at);
  EXPECT_THAT(names_of_cases(list.loads[1]), ElementsAre("", "payload 0.5 kg"));
  EXPECT_TRUE(list.loads[1][0].loads.empty());
  // The tool's x is -z of link 4, its y is x there and its z is -y.
  expect_load(list.loads[1][1], 4, 0.5, 0.5 * Vector3d(0, -0.02, -0.05 - 0.18));
}

TEST(UncertainLoads, Currents) {
  UncertaintySpec uncertainty;
  uncertainty.current_speed = 0.3;
  uncertainty.current_directions = 8;
  LoadGroup group = make_problem(valve_with(uncertainty)).scenarios.loads.at(0);
  ASSERT_EQ(group.size(), 9u);
  EXPECT_EQ(group[0].name, "");
  EXPECT_TRUE(group[0].current.isZero(0));
  EXPECT_EQ(group[2].name, "current 0.3 m/s at 45 deg");
  const double root = std::sqrt(0.5);
  EXPECT_LT((group[1].current - Vector3d(0.3, 0, 0)).norm(), 1e-15);
  EXPECT_LT((group[2].current - Vector3d(0.3 * root, 0.3 * root, 0)).norm(), 1e-15);
  EXPECT_LT((group[8].current - Vector3d(0.3 * root, -0.3 * root, 0)).norm(), 1e-15);
  uncertainty = {};
  uncertainty.current_vectors = {{0.1, 0, -0.2}, Vector3d::Zero()};
  group = make_problem(valve_with(uncertainty)).scenarios.loads.at(0);
  EXPECT_THAT(names_of_cases(group), ElementsAre("current [0.1, 0, -0.2] m/s", ""));
  EXPECT_EQ(group[0].current, Vector3d(0.1, 0, -0.2));
}

/// The corners of the table of parameters for which values are known: 64.
TEST(UncertainLoads, ManyCorners) {
  UncertaintySpec uncertainty;
  uncertainty.trim = 0.2;
  uncertainty.cob = {{"vehicle", {0.005, 0, 0.005}}};
  uncertainty.mass = {{"link_2", 0.038}, {"link_4", 0.1}};
  uncertainty.com = {{"link_2", {0.01, 0, 0}}};
  const ScenarioList list = make_problem(valve_with(uncertainty)).scenarios;
  std::vector<std::size_t> sizes;
  for (const LoadGroup& group : list.loads) sizes.push_back(group.size());
  EXPECT_THAT(sizes, ElementsAre(4u, 2u, 4u, 2u));
  EXPECT_STREQ(list.unit, "N m");
  EXPECT_FALSE(list.non_negative);
}

}  // namespace
}  // namespace maxwrench
