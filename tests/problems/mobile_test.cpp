#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"
#include "maxwrench/wrench_program.h"
#include "solvers/solve/method.h"
#include "solvers/solve/row.h"
#include "tests/reference_models/vertices.h"
#include "tests/support/mechanics.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

TEST(Mobile, AnOpenDefaultKeepsThePoseWhereItIsIfJointsAloneWillDo) {
  const Problem problem = load_problem("mobile/push_any_height");
  EXPECT_EQ(problem.theta_r_default.tail(2), Eigen::Vector2d::Zero());
  EXPECT_EQ(PostureEvaluator(problem).evaluate(problem.theta_r_default).status, Status::kValid);
}

/// A base that drives anywhere follows a free coordinate anywhere: 100 m from X_0.
TEST(Mobile, AFreeRangeMayLieFarAway) {
  const TemporaryFolder folder;
  std::filesystem::copy(std::filesystem::path(MAXWRENCH_SOURCE_DIR) / "problems" / "mobile",
                        folder.path());
  std::string text = read_text(folder.path() / "push_any_height.toml");
  text.replace(text.find("range.z = [-0.4, 0.3]"), 21, "range.x = [100, 100.5]");
  std::ofstream(folder.path() / "far.toml") << text;
  const Problem problem = load_problem((folder.path() / "far.toml").string());
  PostureEvaluator model(problem);
  const Posture& posture = model.evaluate(problem.theta_r_default);
  ASSERT_EQ(posture.status, Status::kValid) << posture.reason.c_str();
  EXPECT_GT(posture.base.p.x(), 98);
}

TEST(Mobile, TwoJointsAreRedundantAndThreeFollow) {
  const Problem problem = load_problem("mobile/push");
  EXPECT_EQ(problem.redundant, (std::vector<int>{0, 1}));
  EXPECT_EQ(problem.dependent, (std::vector<int>{2, 3, 4}));
  EXPECT_TRUE(problem.robot.actuation.full_row_rank());
}

/// The arm moves in a vertical plane that contains the tool's axis, so elbow and wrist follow from
/// heights alone: with a = -q_pitch and f = a - q_elbow the angles of upper arm and forearm to the
/// ground, 0.5 + 0.45 sin a + 0.4 sin f = 0.9, f increasing on the IK solution of the guess (elbow
/// up).
TEST(Mobile, ArmFollowsFromHeights) {
  const Problem problem = load_problem("mobile/push");
  PostureEvaluator model(problem, false);
  for (const double yaw : {-2.0, 0.0, 1.0}) {
    for (const double pitch : {-1.9, -1.4, -0.9, -0.4}) {
      const Posture& posture = model.evaluate(Eigen::Vector2d(yaw, pitch));
      ASSERT_EQ(posture.status, Status::kValid) << posture.reason.c_str();
      const double a = -pitch;
      const double f = std::asin((0.4 - 0.45 * std::sin(a)) / 0.4);
      EXPECT_NEAR(posture.q[2], a - f, 1e-12);
      EXPECT_NEAR(posture.q[3], f, 1e-12);  // the hand is level
      EXPECT_NEAR(posture.q[4], 0, 1e-12);
      const double heading = 0.7 - yaw;
      EXPECT_NEAR(std::atan2(posture.base.R(1, 0), posture.base.R(0, 0)),
                  std::remainder(heading, 2 * M_PI), 1e-12);
      const double reach = 0.45 * std::cos(a) + 0.4 * std::cos(f) + 0.18;
      EXPECT_NEAR(posture.base.p.x(), -0.2 * std::cos(heading) - reach * std::cos(0.7), 1e-12);
      EXPECT_NEAR(posture.base.p.y(), -0.2 * std::sin(heading) - reach * std::sin(0.7), 1e-12);
      EXPECT_EQ(posture.base.p.z(), 0);
    }
  }
}

/// Elbow and wrist of an impulse follow at its start: at the default of other tasks, zero, the
/// stretched arm would be singular.
TEST(Mobile, AImpulseFollowsFromItsStart) {
  TemporaryFolder folder;
  const auto shipped = std::filesystem::path(MAXWRENCH_SOURCE_DIR) / "problems" / "mobile";
  std::string text = read_text(shipped / "push.toml");
  const auto replace = [&](const std::string& from, const std::string& to) {
    ASSERT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.find(from), from.size(), to);
  };
  replace("type = \"static\"",
          "type = \"impulse\"\nmotion = { T = 2, k = 4, t_h = 3 }\n"
          "start = { theta_r = [0.5, -1.2] }");
  replace("default = [0, -1]\n", "");
  replace("rover.toml", (shipped / "rover.toml").string());
  std::ofstream(folder.path() / "impulse.toml") << text;
  const Problem problem = load_problem((folder.path() / "impulse.toml").string());
  EXPECT_EQ(problem.theta_r_default, Eigen::Vector2d(0.5, -1.2));
  TrajectoryEvaluator evaluator(problem, Wrench::kPure, trajectory_solvers().front().make);
  const Trajectory& trajectory =
      evaluator.evaluate(problem.theta_r_default.transpose().replicate(4, 1));
  ASSERT_EQ(trajectory.status, Status::kOptimal) << trajectory.reason.c_str();
  // At rest throughout, no effort rates: the static capability.
  PostureEvaluator model(problem);
  WrenchProgram program = make_wrench_program(problem, Wrench::kPure);
  set_posture(model.evaluate(problem.theta_r_default), program);
  const std::optional<double> best = brute_force(program);
  ASSERT_TRUE(best);
  EXPECT_NEAR(trajectory.value, *best, 1e-7 * *best);
}

/// The ground carries the weight: it loads the arm's joints and no axis of the base.
TEST(Mobile, WeightLoadsTheArmOnly) {
  const Problem problem = load_problem("mobile/push");
  PostureEvaluator model(problem, false);
  Random random(1);
  for (int i = 0; i < 20; ++i) {
    const Posture& posture =
        model.evaluate(Eigen::Vector2d(random.uniform(-3, 3), random.uniform(-1.9, -0.3)));
    EXPECT_LT(posture.tau_d.head<3>().norm(), 1e-12);
    EXPECT_GT(std::abs(posture.tau_d[4]), 1);
    const Eigen::VectorXd slopes =
        potential_energy_slopes(problem.robot, posture.base, posture.q, 1e-6);
    EXPECT_LT((posture.tau_d - slopes).norm(), 1e-6);
  }
}

void expect_solvers_equal_enumeration(const char* name) {
  const Problem problem = load_problem(name);
  PostureEvaluator model(problem);
  for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
    WrenchProgram program = make_wrench_program(problem, wrench);
    set_posture(model.evaluate(problem.theta_r_default), program);
    const std::optional<double> best = brute_force(program);
    ASSERT_TRUE(best);
    for (const WrenchSolverEntry& solver : wrench_solvers()) {
      if (solver.one_column_only && wrench == Wrench::kAny) continue;
      Capability capability;
      solver.make()->solve(program, true, capability);
      EXPECT_NEAR(capability.beta, *best, 1e-5 * *best) << solver.name;
    }
  }
}

TEST(Mobile, SolversEqualTheEnumerationOfAllBases) {
  expect_solvers_equal_enumeration("mobile/push");
}

/// Joints alone: B is the identity.
TEST(FixedArm, SolversEqualTheEnumerationOfAllBases) {
  expect_solvers_equal_enumeration("fixed/push");
}

TEST(Mobile, SLOW_SearchFindsTheBestOfAGrid) {
  const Problem problem = load_problem("mobile/push");
  Case c;
  c.problem = "mobile/push";
  c.search = "annealing+cmaes";
  c.budget = 6000;
  const Answer row = solve(problem, {c, 1});
  ASSERT_EQ(row.status, Status::kBestFound);
  const auto objective =
      make_capability_objective(problem, c.wrench, resolve(problem, c).make_measure);
  constexpr int kPoints = 120;
  double best = 0;
  for (int i = 0; i < kPoints; ++i) {
    for (int j = 0; j < kPoints; ++j) {
      const Eigen::Vector2d s(i / (kPoints - 1.0), j / (kPoints - 1.0));
      const Eigen::VectorXd theta_r =
          problem.theta_r_min + s.cwiseProduct(problem.theta_r_max - problem.theta_r_min);
      best = std::max(best, objective->evaluate(theta_r));
    }
  }
  EXPECT_GE(row.capability.beta, best);
  EXPECT_LE(row.capability.beta, 1.02 * best);
}

/// The four rollers lie at 45 degrees to the base's x and take 135 N each (the motor's), so no push
/// is beyond 4 x 135 N / sqrt 2, which is reached along x of a base that stands straight: with a
/// tool that may turn.
TEST(Mobile, SLOW_DoorPushedAnywhereTakesAllThatTheWheelsGive) {
  const Problem problem = load_problem("mobile/push_any_height");
  EXPECT_EQ(problem.free.axes, (std::vector<int>{2, 5}));
  EXPECT_EQ(problem.theta_r_name(2), "pose_z");
  EXPECT_EQ(problem.theta_r_name(3), "pose_yaw");
  Case c;
  c.problem = problem.name;
  const Answer row = solve(problem, {c, 1});
  const double most = 4 * 135 / std::sqrt(2);
  EXPECT_LE(row.capability.beta, most + 1e-9);
  EXPECT_GE(row.capability.beta, 0.999 * most);
}

/// Two wheels cannot hold the base in all its axes: what divides by B rejects, the polytope does
/// not.
TEST(Mobile, TwoWheelsAreRankDeficient) {
  Problem problem = load_problem("mobile/push");
  problem.robot.thrusters.resize(2);
  complete_actuation(problem.robot);
  EXPECT_EQ(problem.robot.actuation.rank, problem.robot.velocities() - 1);
  Case c;
  c.problem = "mobile/push";
  const Eigen::VectorXd theta_r = problem.theta_r_default;
  for (const char* measure : {"ellipsoid", "l2_polytope"}) {
    c.measure = measure;
    c.solver.clear();
    EXPECT_THROW(evaluate(problem, theta_r, {c}), std::invalid_argument) << measure;
  }
  c.measure = "linf_polytope";
  c.wrench = Wrench::kAny;
  c.solver = "simplex";
  EXPECT_EQ(evaluate(problem, theta_r, {c}).status, Status::kOptimal);
}

}  // namespace
}  // namespace maxwrench
