#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lib/robot/dynamics.h"
#include "maxwrench/load.h"
#include "maxwrench/margin.h"
#include "maxwrench/motion_table.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"
#include "maxwrench/wrench_solver.h"
#include "solvers/margin/instant_scan.h"
#include "tests/support/refusals.h"
#include "tests/support/scenario_task.h"
#include "tests/support/support.h"
#include "tests/support/task_in_time.h"

namespace maxwrench {
namespace {

using testing::HasSubstr;

/// An instant of a random motion: `speed` scales its velocities, the square of it its
/// accelerations.
Instant random_instant(const Problem& problem, Random& random, double speed) {
  const Robot& robot = problem.robot;
  Instant instant;
  if (robot.base_axes.size() == 6) instant.base.R = random_rotation(random);
  instant.q.resize(static_cast<Eigen::Index>(robot.joints.size()));
  for (double& q : instant.q) q = random.uniform(-2, 2);
  instant.v.resize(robot.velocities());
  instant.v_dot.resize(robot.velocities());
  for (double& v : instant.v) v = speed * random.uniform(-1, 1);
  for (double& v : instant.v_dot) v = speed * speed * random.uniform(-1, 1);
  Dynamics dynamics(robot);
  dynamics.set_configuration(instant.base.R, instant.q);
  dynamics.inverse(instant.v, instant.v_dot, instant.tau_d);
  const EndEffector& tool = robot.end_effectors[static_cast<std::size_t>(problem.end_effector)];
  dynamics.kinematics().jacobian(tool, instant.base.R, instant.J);
  instant.end_effector = instant.base * dynamics.kinematics().end_effector(tool);
  instant.c = problem.c;
  return instant;
}

/// The largest factor of a wrench by GLPK, which knows no facets; NaN if there is none.
double by_program(const Problem& problem, const Instant& instant, const Vector6d& wrench) {
  WrenchProgram program = make_wrench_program(problem, Wrench::kPure);
  program.W = wrench;
  program.c_w.setOnes();
  program.JtW = instant.J.transpose() * wrench;
  program.tau_d = instant.tau_d;
  Capability found;
  find_wrench_solver("glpk").make()->solve(program, true, found);
  return found.status == Status::kOptimal ? found.beta : std::nan("");
}

/// Directions on the unit sphere of d axes, evenly spread: a spiral in space.
std::vector<Eigen::VectorXd> directions(Eigen::Index d, int count) {
  std::vector<Eigen::VectorXd> all;
  for (int i = 0; i < count; ++i) {
    const double z = d == 3 ? 1 - (2.0 * i + 1) / count : 0, r = std::sqrt(1 - z * z);
    const double angle =
        d == 3 ? i * std::numbers::pi * (3 - std::sqrt(5.0)) : 2 * std::numbers::pi * i / count;
    Eigen::VectorXd z_i(d);
    if (d == 3) {
      z_i << r * std::cos(angle), r * std::sin(angle), z;
    } else {
      z_i << std::cos(angle), std::sin(angle);
    }
    all.push_back(z_i);
  }
  return all;
}

struct Ball {
  const char* problem;
  std::vector<std::string> axes;
  double speed;
};
void PrintTo(const Ball& ball, std::ostream* out) { *out << ball.problem << ball.axes.front(); }

class MarginOfBall : public testing::TestWithParam<Ball> {};

/// No direction has less than the margin, some direction has little more: the directions are 0.1
/// rad or less apart, and where the worst one meets its facet, one at the angle a has margin / cos
/// a.
TEST_P(MarginOfBall, IsTheLeastOfAllDirections) {
  const Problem problem = load_problem(GetParam().problem);
  const MarginSet set = margin_ball(GetParam().axes);
  const auto d = static_cast<Eigen::Index>(GetParam().axes.size());
  Random random(3);
  int feasible = 0;
  for (int sample = 0; sample < 4; ++sample) {
    const Instant instant = random_instant(problem, random, GetParam().speed);
    const MotionMargin result = motion_margin(problem, {instant}, set);
    const InstantMargin& at = result.instants[0];
    if (result.status == Status::kInfeasible) {
      EXPECT_TRUE(std::isnan(by_program(problem, instant, Vector6d::Zero())));
      continue;
    }
    ASSERT_EQ(result.status, Status::kOptimal) << result.reason.str();
    ++feasible;
    double least = kInfinity;
    for (const Eigen::VectorXd& z : directions(d, samples(d == 3 ? 1600 : 120))) {
      const double most = by_program(problem, instant, set.E * z);
      EXPECT_GE(most, at.margin - 1e-9 * (1 + at.margin));
      least = std::min(least, most);
    }
    if (!kSanitized) {  // they try few directions
      EXPECT_LE(least, 1.02 * at.margin + 1e-9);
    }
    EXPECT_NEAR(by_program(problem, instant, at.worst), at.margin, 1e-8 * (1 + at.margin));
    EXPECT_NEAR(at.worst.norm(), 1, 1e-12);
    // The efforts exert it, and those that bind are at their limits.
    const Zonotope& actuation = problem.robot.actuation;
    const Eigen::VectorXd missing =
        actuation.B * at.u - instant.tau_d - instant.J.transpose() * (at.margin * at.worst);
    EXPECT_LT(missing.lpNorm<Eigen::Infinity>(), 1e-7);
    EXPECT_FALSE(at.binding.empty());
    for (const LimitRate& limit : at.binding) EXPECT_NE(limit.rate, 0);
  }
  EXPECT_GT(feasible, 0);
}

INSTANTIATE_TEST_SUITE_P(All, MarginOfBall,
                         testing::Values(Ball{"uvms/valve", {"fx", "fy", "fz"}, 0.1},
                                         Ball{"uvms/valve", {"fx", "fy"}, 0.2},
                                         Ball{"uvms/valve", {"tx", "ty", "tz"}, 0.1},
                                         Ball{"fixed/push", {"fx", "fy", "fz"}, 0.5},
                                         Ball{"fixed/push", {"fy", "fz"}, 1}));

/// Each joint of an arm has its own motor: the residual force polytope is |tau_d + J'f| <= u_max,
/// row by row, whose inscribed radius is min (u_max,i - |tau_d,i|) / |J_i| over the force columns.
TEST(MotionMargin, OfAnArmIsTheNearestRow) {
  const Problem problem = load_problem("fixed/push");
  Random random(8);
  std::vector<Instant> instants;
  for (int i = 0; i < 50; ++i) {
    instants.push_back(random_instant(problem, random, 0.4 * i));
    instants.back().t = i;
  }
  const MotionMargin result = motion_margin(problem, instants);
  int feasible = 0;
  for (std::size_t i = 0; i < instants.size(); ++i) {
    double radius = kInfinity;
    for (Eigen::Index row = 0; row < instants[i].tau_d.size(); ++row) {
      const double limit = problem.robot.joints[static_cast<std::size_t>(row)].effort_max;
      const double length = instants[i].J.col(row).head<3>().norm();
      if (length < 1e-12) continue;
      radius = std::min(radius, (limit - std::abs(instants[i].tau_d[row])) / length);
    }
    if (result.instants[i].margin == -kInfinity) continue;  // the last joint, which no force loads
    EXPECT_NEAR(result.instants[i].margin, radius, 1e-9 * (1 + std::abs(radius)));
    feasible += radius >= 0;
    EXPECT_EQ(result.instants[i].status, radius >= 0 ? Status::kOptimal : Status::kInfeasible);
  }
  EXPECT_GT(feasible, 5);
  EXPECT_LT(feasible, 50);
  EXPECT_EQ(result.status, Status::kInfeasible);
  EXPECT_EQ(result.infeasible, 50 - feasible);
}

/// Less help than the negative margin, from any direction, leaves the motion infeasible.
TEST(MotionMargin, OfAnInfeasibleMotionIsNegative) {
  const Problem problem = load_problem("uvms/valve");
  Random random(5);
  const Instant instant = random_instant(problem, random, 3);
  const MotionMargin result = motion_margin(problem, {instant});
  ASSERT_EQ(result.status, Status::kInfeasible);
  EXPECT_THAT(result.reason.str(), HasSubstr("1 of 1 instants"));
  const double help = -result.instants[0].margin;
  ASSERT_GT(help, 1);
  ASSERT_TRUE(std::isfinite(help));
  for (const Eigen::VectorXd& z : directions(3, 200)) {
    Instant helped = instant;
    helped.tau_d += 0.999 * help * (instant.J.transpose().leftCols(3) * z);
    EXPECT_TRUE(std::isnan(by_program(problem, helped, Vector6d::Zero())));
  }
}

/// A force out of the plane loads no actuator of a planar vehicle. If its motion needs more than
/// they have, no such force helps.
TEST(MotionMargin, OfASetThatLoadsNothing) {
  const Problem problem = load_problem("planar/force");
  Random random(2);
  Instant instant = random_instant(problem, random, 0);
  const MarginSet set = margin_ball({"fz"});
  EXPECT_EQ(motion_margin(problem, {instant}, set).status, Status::kUnbounded);
  instant.tau_d[0] = 1000;
  const MotionMargin none = motion_margin(problem, {instant}, set);
  EXPECT_EQ(none.status, Status::kInfeasible);
  EXPECT_EQ(none.instants[0].margin, -kInfinity);
  EXPECT_FALSE(none.instants[0].binding.empty());
  EXPECT_THAT(to_json(none), HasSubstr("\"margin\":null"));
  EXPECT_THAT(summary(none), HasSubstr("none"));
}

/// At rest the margin of the task's own wrench is beta, and that of a ball is the value of
/// `wrench.ball`: 30.67224 N for any horizontal force at the default posture, by an independent
/// model.
TEST(MotionMargin, AtRestIsTheValue) {
  const Problem problem = load_problem("uvms/lift");
  MotionTable table;
  for (const Joint& joint : problem.robot.joints) table.names.push_back(joint.name);
  table.t = {0, 1};
  table.values = problem.theta_r_default.transpose().replicate(2, 1);
  const std::vector<Instant> instants = motion_instants(problem, table);
  MarginSet own;
  own.of_task = true;
  const MotionMargin lift = motion_margin(problem, instants, own);
  EXPECT_NEAR(lift.instants[0].margin,
              evaluate(problem, problem.theta_r_default.transpose()).beta(), 1e-9);
  EXPECT_EQ(lift.unit, "N");
  const MotionMargin any = motion_margin(problem, instants, margin_ball({"fx", "fy"}));
  EXPECT_NEAR(any.instants[1].margin, 30.67224, 1e-5);
  // With any one thruster dead: 14.55665 N, by the same model.
  const Problem lossy = scenario_task(kLift, "[loss]\nany = 1\n");
  const MotionMargin dead = motion_margin(lossy, instants, own);
  EXPECT_NEAR(dead.instants[0].margin, 14.55665, 1e-5);
  EXPECT_THAT(dead.instants[0].limits, HasSubstr("dead"));
}

/// Axes of the end effector turn with it: by a quarter turn about z its x is the world's y.
TEST(MotionMargin, AxesMayTurnWithTheEndEffector) {
  const Problem problem = load_problem("uvms/valve");
  Random random(12);
  Instant instant = random_instant(problem, random, 0.1);
  instant.end_effector.R << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const double turned =
      motion_margin(problem, {instant}, margin_ball({"fx"}, true)).instants[0].margin;
  const double fixed = motion_margin(problem, {instant}, margin_ball({"fy"})).instants[0].margin;
  EXPECT_NEAR(turned, fixed, 1e-9);
}

/// The worst instant of the shipped trajectory, with the task's own torque, is below its value: the
/// value counts rates of efforts, which may only lower it.
TEST(MotionMargin, OfOurOwnTrajectory) {
  const Problem problem = load_problem("uvms/valve_trajectory");
  const std::string file =
      MAXWRENCH_SOURCE_DIR "/results/trajectories/uvms_valve_trajectory_spline.csv";
  const Answer answer = evaluate(problem, load_knots(file, problem));
  MarginSet own;
  own.of_task = true;
  const MotionMargin result = motion_margin(problem, answer.trajectory.instants, own);
  ASSERT_EQ(result.status, Status::kOptimal) << result.reason.str();
  const double least = result.instants[static_cast<std::size_t>(result.worst)].margin;
  EXPECT_GE(least, answer.beta() - 1e-6);
  EXPECT_LT(least, 1.02 * answer.beta());
}

TEST(InstantScan, AllocatesNothing) {
  if (!kAllocationsAreCounted) GTEST_SKIP() << "a sanitizer replaces malloc";
  const Problem problem = load_problem("uvms/valve");
  for (const bool of_task : {false, true}) {
    MarginSet set = margin_ball({"fx", "fy", "fz"}, true);
    set.of_task = of_task;
    const Problem listed = task_of_margins(problem, set);
    InstantScan scan(listed, set);
    Random random(1);
    std::vector<Instant> instants;
    for (int i = 0; i < 20; ++i) instants.push_back(random_instant(problem, random, 0.2 * i));
    scan.scan(instants[0]);
    const long before = allocation_count();
    double sum = 0;
    for (const Instant& instant : instants) sum += scan.scan(instant);
    EXPECT_EQ(allocation_count(), before);
    EXPECT_FALSE(std::isnan(sum));
  }
}

TEST(MotionMargin, RejectsWhatItDoesNotSupport) {
  const Problem problem = load_problem("uvms/valve");
  Random random(1);
  const Instant instant = random_instant(problem, random, 0.1);
  expect_rejected("margin", [&] { motion_margin(problem, {}); });
  Instant broken = instant;
  broken.tau_d[0] = std::nan("");
  expect_rejected("margin", [&] { motion_margin(problem, {broken}); });
  expect_rejected("margin", [&] { motion_margin(load_problem("fixed/push"), {instant}); });
  expect_rejected("contact", [&] { motion_margin(load_problem("planar/two_arms"), {instant}); });
  expect_rejected("uncertainty", [&] {
    motion_margin(scenario_task(kTurn, "[uncertainty]\ntrim = 0.2\n"), {instant});
  });
  expect_rejected("environment.current", [&] {
    motion_margin(scenario_task(kTurn, "[environment]\ncurrent = [0.3, 0, 0]\n"), {instant});
  });
  MarginSet skew;
  skew.E.col(0) *= 2;
  expect_rejected("margin", [&] { motion_margin(problem, {instant}, skew); });
  expect_rejected("ball", [] { margin_ball({}); });
  expect_rejected("ball", [] { margin_ball({"fx", "fx"}); });
  expect_rejected("ball", [] { margin_ball({"fx", "tx"}); });
  expect_rejected("ball", [] { margin_ball({"gx"}); });
}

/// The set of a task in time: at each instant the least margin of its wrenches alone.
TEST(MotionMargin, OfASetInTimeIsTheLeastOfItsWrenches) {
  const auto margins_of = [](const std::string& wrench) {
    const Problem task = task_in_time("valve_trajectory", wrench, "");
    const Answer answer = evaluate(task, task.theta_r_default);
    MarginSet set;
    set.of_task = true;
    return motion_margin(task, answer.trajectory.instants, set);
  };
  const std::vector<std::string> each = {"[0,0,-1,0,0,0]", "[0,-1,0,0,0,0]", "[-1,0,0,0,0,0]"};
  const MotionMargin all = margins_of("set = [" + each[0] + "," + each[1] + "," + each[2] + "]");
  std::vector<double> least(all.instants.size(), kInfinity);
  for (const std::string& wrench : each) {
    const MotionMargin alone = margins_of("set = [" + wrench + "]");
    ASSERT_EQ(alone.instants.size(), least.size());
    for (std::size_t i = 0; i < least.size(); ++i) {
      least[i] = std::min(least[i], alone.instants[i].margin);
    }
  }
  for (std::size_t i = 0; i < least.size(); ++i) {
    EXPECT_NEAR(all.instants[i].margin, least[i], 1e-9 * (1 + least[i])) << i;
  }
}

}  // namespace
}  // namespace maxwrench
