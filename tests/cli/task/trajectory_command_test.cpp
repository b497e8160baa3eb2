#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lib/robot/dynamics.h"
#include "maxwrench/load.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using nlohmann::json;

/// The best static posture as the independent model of these values rounded it.
const std::string kFixed = " --theta-r 3.0643,0.6895,0.4288,-3.0278";

json object_of(const std::string& words, int exit_status = 0) {
  const CommandResult result = run_maxwrench(words + " --json");
  EXPECT_EQ(result.exit_status, exit_status) << words << "\n" << result.err;
  EXPECT_EQ(result.err, "");
  return result.out.empty() ? json::object() : json::parse(result.out);
}

Eigen::VectorXd numbers(const json& array) {
  const auto values = array.get<std::vector<double>>();
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

Eigen::Matrix3d rotation(const json& rpy) {
  return (Eigen::AngleAxisd(rpy[2], Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(rpy[1], Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(rpy[0], Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

struct KnownValue {
  const char* words;
  double value, value_between_knots;
};

class KnownTrajectory : public testing::TestWithParam<KnownValue> {};

/// Of an independent model in another language, with another LP solver.
INSTANTIATE_TEST_SUITE_P(Each, KnownTrajectory,
                         testing::Values(KnownValue{"--scheme forward", 34.17591, 34.30164},
                                         KnownValue{"--scheme ends", 34.36105, 34.30164},
                                         KnownValue{"", 34.30190, 34.30164},
                                         KnownValue{"--solver clp", 34.30190, 34.30164},
                                         KnownValue{"--scheme ends --wrench any", 40.78087,
                                                    34.30164}));

TEST_P(KnownTrajectory, HasTheValueOfTheIndependentModel) {
  const json trajectory = object_of("eval uvms/valve_trajectory " + (GetParam().words + kFixed));
  EXPECT_EQ(trajectory["status"], "optimal");
  EXPECT_NEAR(trajectory["value"], GetParam().value, 1e-5);
  EXPECT_EQ(trajectory["value"], trajectory["beta"]);
  if (trajectory["wrench"] == "any") return;
  EXPECT_NEAR(trajectory["value_between_knots"], GetParam().value_between_knots, 1e-5);
}

TEST(TrajectoryCommand, PrintsOneObjectWithEverything) {
  const json trajectory = object_of("eval uvms/valve_trajectory");
  for (const char* key : {"problem",
                          "measure",
                          "wrench",
                          "solver",
                          "search",
                          "seed",
                          "status",
                          "reason",
                          "beta",
                          "unit",
                          "theta_r",
                          "theta",
                          "w",
                          "h",
                          "u",
                          "lambda",
                          "gradient",
                          "residual",
                          "evaluations",
                          "wall_s",
                          "version",
                          "task",
                          "value",
                          "value_between_knots",
                          "between_knots_reason",
                          "instants",
                          "clearance"}) {
    EXPECT_TRUE(trajectory.contains(key)) << key;
  }
  for (const char* key : {"theta", "w", "h", "u", "lambda", "search", "seed", "reason"}) {
    EXPECT_TRUE(trajectory[key].is_null()) << key;
  }
  EXPECT_EQ(trajectory["unit"], "N m");
  EXPECT_EQ(trajectory["theta_r"].size(), 10U);
  EXPECT_EQ(trajectory["gradient"].size(), 10U);
  EXPECT_EQ(trajectory["gradient"][0].size(), 4U);
  EXPECT_EQ(trajectory["instants"].size(), 37U);  // 4 k - 3
  const json& actuators = trajectory["actuators"];
  ASSERT_EQ(actuators.size(), trajectory["instants"][0]["u"].size());
  // As in robot.toml and the URDF: T200 thrusters with a rate, and an arm without.
  EXPECT_EQ(actuators[0]["min"], -40);
  EXPECT_EQ(actuators[0]["max"], 50);
  EXPECT_GT(actuators[0]["rate"], 0);
  EXPECT_TRUE(actuators.back()["rate"].is_null());
  const json expected = {{"kind", "trajectory"},
                         {"scheme", "spline"},
                         {"k", 10},
                         {"T", 5},
                         {"c", {0, 0, 0, 0, 0, 1}},
                         {"rates", true},
                         {"wrench", "pure"},
                         {"t_h", nullptr},
                         {"u0", nullptr},
                         {"theta0", nullptr},
                         {"collision", true},
                         {"angle", M_PI},
                         {"sub", 4}};
  EXPECT_EQ(trajectory["task"], expected);
  EXPECT_GE(trajectory["clearance"]["least"], -1e-9);  // the best static posture, which is allowed
  EXPECT_EQ(trajectory["clearance"]["t"], 0);          // and held throughout
  EXPECT_EQ(trajectory["clearance"]["pair"], "link_2 and link_4");
}

TEST(TrajectoryCommand, DescribesAImpulse) {
  const json trajectory = object_of("eval uvms/valve_impulse --t-h best --ignore-collision");
  EXPECT_EQ(trajectory["task"]["u0"], "static");
  EXPECT_EQ(trajectory["task"]["sub"], 16);
  EXPECT_EQ(trajectory["task"]["theta0"], trajectory["theta_r"][0]);
  EXPECT_EQ(trajectory["task"]["collision"], false);
  EXPECT_TRUE(trajectory["clearance"].is_null());
  EXPECT_GE(trajectory["task"]["t_h"], 1);
  EXPECT_EQ(trajectory["instants"].size(), 65U);  // 16 k + 1: knot 0 is the first
  EXPECT_EQ(object_of("eval uvms/valve_impulse")["task"]["t_h"], 3);
  EXPECT_EQ(object_of("eval uvms/valve_impulse --t-h 2")["task"]["t_h"], 2);
  EXPECT_EQ(object_of("eval uvms/valve_impulse --scheme backward")["instants"].size(), 5U);
  EXPECT_FALSE(trajectory["task"].contains("angle"));
}

/// What a trajectory says of itself, recomputed from the numbers that it prints.
class TrajectoryCheck {
 public:
  explicit TrajectoryCheck(const std::string& words)
      : trajectory_(object_of("eval " + words)),
        problem_(load_problem(trajectory_["problem"])),
        dynamics_(problem_.robot) {}

  void run() {
    const json& instants = trajectory_["instants"];
    const bool impulse = problem_.motion->impulse;
    double least = kInfinity;
    for (std::size_t i = 0; i < instants.size(); ++i) {
      check_instant(instants[i]);
      if (i > 0) check_rates(instants[i - 1], instants[i]);
      least = std::min(least, instants[i]["beta"].get<double>());
    }
    if (impulse) {
      const int peak =
          trajectory_["task"]["t_h"].get<int>() * trajectory_["task"]["sub"].get<int>();
      least = instants[static_cast<std::size_t>(peak)]["beta"];
    }
    EXPECT_NEAR(least, trajectory_["value"], 1e-7 * (1 + std::abs(least)));
  }

 private:
  Eigen::VectorXd joints(const json& theta) const {
    Eigen::VectorXd q(static_cast<Eigen::Index>(problem_.robot.joints.size()));
    for (Eigen::Index j = 0; j < q.size(); ++j)
      q[j] = theta[problem_.robot.joints[static_cast<std::size_t>(j)].name];
    return q;
  }

  void check_instant(const json& instant) {
    const Zonotope& set = problem_.robot.actuation;
    const json& theta = instant["theta"];
    const Eigen::Matrix3d R = rotation(theta["rpy"]);
    dynamics_.set_configuration(R, joints(theta));
    Eigen::VectorXd tau_d(problem_.robot.velocities());
    dynamics_.inverse(numbers(instant["velocity"]), numbers(instant["acceleration"]), tau_d);
    EXPECT_LT((tau_d - numbers(instant["tau_d"])).norm(), 1e-9 * (1 + tau_d.norm()));
    Matrix6Xd J(6, tau_d.size());
    dynamics_.kinematics().jacobian(
        problem_.robot.end_effectors[static_cast<std::size_t>(problem_.end_effector)], R, J);
    const Eigen::VectorXd h = numbers(instant["h"]), u = numbers(instant["u"]);
    EXPECT_LT((set.B * u - J.transpose() * h - tau_d).norm(), 1e-6);
    EXPECT_TRUE((u.array() <= set.u_max.array() + 1e-6).all());
    EXPECT_TRUE((u.array() >= set.u_min.array() - 1e-6).all());
    const Eigen::VectorXd c = numbers(instant["c"]);
    EXPECT_NEAR(c.dot(h), instant["beta"], 1e-9 * (1 + h.norm()));
    if (trajectory_["wrench"] == "pure") {
      EXPECT_LT((h - c * c.dot(h)).norm(), 1e-9 * (1 + h.norm()));
    }
    if (trajectory_["task"]["scheme"] != "spline") return;  // differences of knots
    const Vector6d twist = J * numbers(instant["velocity"]);
    EXPECT_LT((twist - problem_.motion->path.at(instant["t"]).twist).norm(), 1e-9);
  }

  void check_rates(const json& before, const json& after) const {
    const double dt = after["t"].get<double>() - before["t"].get<double>();
    const Eigen::ArrayXd step = (numbers(after["u"]) - numbers(before["u"])).array().abs();
    EXPECT_TRUE((step <= dt * problem_.robot.u_rate_max.array() + 1e-6).all());
  }

  json trajectory_;
  Problem problem_;
  Dynamics dynamics_;
};

class SelfConsistentTrajectory : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(
    Each, SelfConsistentTrajectory,
    testing::Values("uvms/valve_trajectory", "uvms/valve_trajectory --wrench any --solver clp",
                    "uvms/valve_trajectory --scheme ends", "uvms/jet_trajectory",
                    "planar/trajectory", "mobile/trajectory",
                    "mobile/trajectory --scheme forward --wrench any", "uvms/valve_impulse",
                    "uvms/lift_impulse", "uvms/valve_impulse --scheme backward --t-h best"));

TEST_P(SelfConsistentTrajectory, IsWhatItsNumbersSay) { TrajectoryCheck(GetParam()).run(); }

TEST(TrajectoryCommand, TextSaysWhatBindsWhere) {
  const CommandResult turn = run_maxwrench("eval uvms/valve_trajectory" + kFixed);
  EXPECT_EQ(turn.exit_status, 0) << turn.err;
  for (const char* part :
       {"trajectory of 5 s, 10 knots, scheme spline, 37 instants\noptimal\n",
        "value      34.30190 N m\n", "value_between_knots 34.30164 N m\n", "binds at ",
        "clearance ", " m at 0.0000 s: link_2 and link_4\n", "    t [s]  ", "100 % "}) {
    EXPECT_NE(turn.out.find(part), std::string::npos) << part << turn.out;
  }
  EXPECT_LT(std::count(turn.out.begin(), turn.out.end(), '\n'), 30);
  const CommandResult impulse = run_maxwrench("eval uvms/valve_impulse");
  EXPECT_NE(impulse.out.find("peak at knot 3\n"), std::string::npos) << impulse.out;
  EXPECT_NE(impulse.out.find("binds at 1.8750 s: "), std::string::npos) << impulse.out;
}

/// What clp makes of the file is the value, and the columns are the efforts.
TEST(TrajectoryCommand, WritesItsProgram) {
  const TemporaryFolder folder;
  for (const char* problem : {"uvms/valve_trajectory --wrench any", "uvms/valve_impulse"}) {
    const CommandResult result =
        run_maxwrench(std::string("eval ") + problem + " --json --write p.mps", folder.path());
    ASSERT_EQ(result.exit_status, 0) << result.err;
    const json trajectory = json::parse(result.out);
    const json program =
        json::parse(run_maxwrench("lp p.mps --solver clp --json", folder.path()).out);
    EXPECT_NEAR(program["objective"], trajectory["value"], 1e-6) << problem;
    EXPECT_TRUE(program["x"].contains("front_right_vertical.3")) << problem;
    EXPECT_TRUE(program["duals"].contains("base_x.0")) << problem;
    EXPECT_TRUE(program["duals"].contains("rate.front_right_vertical.0")) << problem;
    EXPECT_EQ(program["x"].contains("t"), trajectory["task"]["kind"] == "trajectory");
  }
}

}  // namespace
}  // namespace maxwrench
