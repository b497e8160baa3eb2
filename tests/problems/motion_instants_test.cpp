#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <kdl/chainidsolver_recursive_newton_euler.hpp>
#include <numbers>

#include "lib/robot/chain.h"
#include "maxwrench/load.h"
#include "maxwrench/motion_table.h"
#include "maxwrench/solve.h"
#include "problems/make/base_motion.h"
#include "tests/support/coded_tasks.h"
#include "tests/support/dependents.h"
#include "tests/support/kdl_chain.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// A smooth motion of coordinate k: a_k sin(w_k t + k) + b_k, with its derivatives.
double wave(int k, double t, int order) {
  const double amplitude = 0.3 / (1 + k), w = 1 + 0.4 * k;
  const double phase = w * t + k;
  if (order == 0) return amplitude * std::sin(phase) + 0.1 * k;
  if (order == 1) return amplitude * w * std::cos(phase);
  return -amplitude * w * w * std::sin(phase);
}

/// Rows of waves; how many derivatives the table has.
MotionTable waves(const std::vector<std::string>& names, int rows, double T, int derivatives) {
  MotionTable table;
  table.names = names;
  const auto d = static_cast<Eigen::Index>(names.size());
  table.values.resize(rows, d);
  if (derivatives > 0) table.rates.resize(rows, d);
  if (derivatives > 1) table.accelerations.resize(rows, d);
  for (int row = 0; row < rows; ++row) {
    const double t = T * row / (rows - 1);
    table.t.push_back(t);
    for (int k = 0; k < d; ++k) {
      table.values(row, k) = wave(k, t, 0);
      if (derivatives > 0) table.rates(row, k) = wave(k, t, 1);
      if (derivatives > 1) table.accelerations(row, k) = wave(k, t, 2);
    }
  }
  return table;
}

std::vector<std::string> joint_names(const Robot& robot) {
  std::vector<std::string> names;
  for (const Joint& joint : robot.joints) names.push_back(joint.name);
  return names;
}

/// Orocos KDL has the same inverse dynamics of the arm. With derivatives in the table they agree to
/// rounding; with those of a spline to the error of the spline, 5e-4 of the largest acceleration
/// for 200 rows a second.
TEST(MotionInstants, TauIsThatOfKdl) {
  const Problem problem = load_problem("fixed/push");
  const Robot& robot = problem.robot;
  const auto joints = static_cast<unsigned>(robot.joints.size());
  const KDL::Chain chain = kdl_chain(robot);
  KDL::ChainIdSolver_RNE solver(chain, KDL::Vector(0, 0, -robot.gravity));
  const KDL::Wrenches none(chain.getNrOfSegments(), KDL::Wrench::Zero());
  for (const int derivatives : {0, 1, 2}) {
    const std::vector<Instant> instants =
        motion_instants(problem, waves(joint_names(robot), 401, 2, derivatives));
    ASSERT_EQ(instants.size(), 401u);
    for (const Instant& instant : instants) {
      KDL::JntArray q(joints), rate(joints), bend(joints), tau(joints);
      for (unsigned k = 0; k < joints; ++k) {
        q(k) = wave(static_cast<int>(k), instant.t, 0);
        rate(k) = wave(static_cast<int>(k), instant.t, 1);
        bend(k) = wave(static_cast<int>(k), instant.t, 2);
      }
      ASSERT_EQ(solver.CartToJnt(q, rate, bend, none, tau), 0);
      const double allowed = derivatives == 2 ? 1e-11 : 2e-3;
      EXPECT_LT((instant.tau_d - tau.data).cwiseAbs().maxCoeff(),
                allowed * (1 + tau.data.cwiseAbs().maxCoeff()))
          << derivatives << " at " << instant.t;
    }
  }
}

/// The twist of the base and its derivative by central differences of the pose, whose errors are
/// about 1e-9 and 1e-6.
TEST(BaseMotion, IsTheDerivativeOfThePose) {
  const auto at = [](double t, int order) {
    Vector6d x;
    for (int k = 0; k < 6; ++k) x[k] = wave(k, t, order);
    return x;
  };
  const auto pose = [&](double t) { return base_motion(at(t, 0), at(t, 1), at(t, 2)).pose; };
  const auto twist = [&](double t) -> Vector6d {
    const double h = 1e-5;
    const Pose<double> before = pose(t - h), after = pose(t + h);
    Vector6d v;
    v << pose(t).R.transpose() * (after.p - before.p) / (2 * h),
        logarithm(before.R.transpose() * after.R) / (2 * h);
    return v;
  };
  for (const double t : {0.0, 0.7, 1.9}) {
    const BaseMotion motion = base_motion(at(t, 0), at(t, 1), at(t, 2));
    EXPECT_LT((motion.twist - twist(t)).norm(), 1e-8);
    const double h = 1e-4;
    EXPECT_LT((motion.acceleration - (twist(t + h) - twist(t - h)) / (2 * h)).norm(), 1e-5);
    EXPECT_LT((roll_pitch_yaw(motion.pose.R) - at(t, 0).tail<3>()).norm(), 1e-12);
  }
}

/// The table of a trajectory's own instants gives these instants again: the base follows from the
/// joints and the path.
TEST(MotionInstants, TheBaseFollowsFromThePath) {
  const Problem problem = load_problem("uvms/valve_trajectory");
  const std::string file =
      MAXWRENCH_SOURCE_DIR "/results/trajectories/uvms_valve_trajectory_spline.csv";
  const Answer answer = evaluate(problem, load_knots(file, problem));
  const std::vector<Instant>& own = answer.trajectory.instants;
  MotionTable table;
  table.names = joint_names(problem.robot);
  const auto rows = static_cast<Eigen::Index>(own.size());
  const auto d = static_cast<Eigen::Index>(table.names.size());
  for (Eigen::MatrixXd* each : {&table.values, &table.rates, &table.accelerations}) {
    each->resize(rows, d);
  }
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Instant& instant = own[static_cast<std::size_t>(i)];
    table.t.push_back(instant.t);
    table.values.row(i) = instant.q;
    table.rates.row(i) = instant.v.tail(d);
    table.accelerations.row(i) = instant.v_dot.tail(d);
  }
  const std::vector<Instant> instants = motion_instants(problem, table);
  ASSERT_EQ(instants.size(), own.size());
  for (std::size_t i = 0; i < own.size(); ++i) {
    EXPECT_LT((instants[i].tau_d - own[i].tau_d).norm(), 1e-9);
    EXPECT_LT((instants[i].J - own[i].J).norm(), 1e-12);
    EXPECT_LT((instants[i].c - own[i].c).norm(), 1e-12);
    EXPECT_LT((instants[i].base.p - own[i].base.p).norm(), 1e-12);
  }
  // The same with the base in the table, by a spline through 41 rows.
  MotionTable moved;
  moved.t = table.t;
  moved.names = table.names;
  for (const char* axis : kTwistAxes) moved.names.push_back("base_" + std::string(axis));
  moved.values.resize(rows, d + 6);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Pose<double>& base = own[static_cast<std::size_t>(i)].base;
    moved.values.row(i) << table.values.row(i), base.p.transpose(),
        roll_pitch_yaw(base.R).transpose();
  }
  const std::vector<Instant> free = motion_instants(problem, moved);
  for (std::size_t i = 2; i + 2 < own.size(); ++i) {
    EXPECT_LT((free[i].end_effector.p - own[i].end_effector.p).norm(), 1e-9);
    EXPECT_LT((free[i].tau_d - own[i].tau_d).norm(), 0.05 * (1 + own[i].tau_d.norm())) << i;
  }
}

/// The wrench of 1 kg needs the end effector's acceleration: along a path that is known in closed
/// form, and in the motion of the robot that follows it.
TEST(MotionInstants, ThePayloadMovesWithTheEndEffector) {
  const Problem problem = load_problem(MAXWRENCH_SOURCE_DIR "/examples/tasks/two_link/lift.toml");
  const Answer answer = evaluate(problem, default_knots(problem));
  const std::vector<Instant>& own = answer.trajectory.instants;
  MotionTable table;
  table.names = joint_names(problem.robot);
  const auto rows = static_cast<Eigen::Index>(own.size());
  for (Eigen::MatrixXd* each : {&table.values, &table.rates, &table.accelerations}) {
    each->resize(rows, 2);
  }
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Instant& instant = own[static_cast<std::size_t>(i)];
    table.t.push_back(instant.t);
    table.values.row(i) = instant.q;
    table.rates.row(i) = instant.v;
    table.accelerations.row(i) = instant.v_dot;
  }
  const std::vector<Instant> instants = motion_instants(problem, table);
  for (std::size_t i = 0; i < own.size(); ++i) {
    EXPECT_LT((instants[i].c - own[i].c).norm(), 1e-10) << i;
    EXPECT_LT((instants[i].tau_d - own[i].tau_d).norm(), 1e-10) << i;
  }
}

/// At rest the instant is the posture of `evaluate`.
TEST(MotionInstants, RestIsThePosture) {
  const Problem problem = load_problem("uvms/valve");
  MotionTable table;
  table.names = joint_names(problem.robot);
  table.t = {0, 1, 2};
  table.values = problem.theta_r_default.transpose().replicate(3, 1);
  table.instants_per_interval = 3;
  const std::vector<Instant> instants = motion_instants(problem, table);
  ASSERT_EQ(instants.size(), 7u);
  EXPECT_NEAR(instants[1].t, 1.0 / 3, 1e-15);
  const Answer answer = evaluate(problem, problem.theta_r_default.transpose());
  for (const Instant& instant : instants) {
    EXPECT_LT((instant.tau_d - answer.posture.tau_d).norm(), 1e-12);
    EXPECT_LT((instant.J - answer.posture.J).norm(), 1e-12);
  }
}

/// A fixed arm of three links of 1 m and a tool, whose first joint alone is in theta_r: the others
/// follow from the pose, or are checked if the table has some of them.
TEST(MotionInstants, DependentJointsKeepTheLoop) {
  Problem problem = four_bars();
  std::vector<Joint>& joints = problem.robot.joints;
  for (std::size_t i = 0; i < joints.size(); ++i) joints[i].name = "joint_" + std::to_string(i);
  MotionTable table;
  table.t = {0, 0.5, 1};
  table.names = {joints[static_cast<std::size_t>(problem.redundant[0])].name};
  const double start = problem.theta_r_default[0];
  table.values.resize(3, 1);
  table.values << start, start + 0.02, start + 0.04;
  const std::vector<Instant> instants = motion_instants(problem, table);
  for (const Instant& instant : instants) {
    EXPECT_LT((instant.end_effector.p - problem.pose.p).norm(), 1e-9);
    EXPECT_LT((instant.end_effector.R - problem.pose.R).norm(), 1e-9);
    EXPECT_LT((instant.J * instant.v).norm(), 1e-7);  // the end effector rests
  }
  const int dependent = problem.dependent[0];
  table.names.push_back(joints[static_cast<std::size_t>(dependent)].name);
  table.values.conservativeResize(3, 2);
  for (Eigen::Index row = 0; row < 3; ++row) {
    table.values(row, 1) = instants[static_cast<std::size_t>(row)].q[dependent];
  }
  EXPECT_EQ(motion_instants(problem, table).size(), 3u);
  table.values(1, 1) += 0.01;
  const std::string line = rejection_of([&] { motion_instants(problem, table); });
  EXPECT_THAT(line, StartsWith("row 2: got " + table.names[1]));
  EXPECT_THAT(line, HasSubstr("where the other coordinates put it"));
}

struct BadMotionFile {
  const char *name, *problem, *text, *line;
};
void PrintTo(const BadMotionFile& bad, std::ostream* out) { *out << bad.name; }

class BadInstantTable : public testing::TestWithParam<BadMotionFile> {};

TEST_P(BadInstantTable, IsOneLine) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "motion.csv";
  std::ofstream(file) << GetParam().text;
  const Problem problem = load_problem(GetParam().problem);
  const std::string line = rejection_of([&] { load_motion(file, problem); });
  EXPECT_THAT(line, StartsWith(file + ": "));
  EXPECT_THAT(line, HasSubstr(GetParam().line));
  EXPECT_THAT(line, HasSubstr("expected"));
  EXPECT_EQ(line.find('\n'), std::string::npos) << line;
}

INSTANTIATE_TEST_SUITE_P(
    All, BadInstantTable,
    testing::Values(
        BadMotionFile{"no header", "planar/force", "0,1\n1,1\n", "line 1: got '0,1'"},
        BadMotionFile{"empty", "planar/force", "", "columns: got no t"},
        BadMotionFile{"no t", "planar/force", "shoulder,elbow\n1,1\n", "columns: got no t"},
        BadMotionFile{"one row", "planar/force", "t,shoulder,elbow\n0,1,1\n", "rows: got 1"},
        BadMotionFile{"nan", "planar/force", "t,shoulder,elbow\n0,1,1\n1,nan,1\n", "line 3: got"},
        BadMotionFile{"text", "planar/force", "t,shoulder,elbow\n0,1,1\n1,one,1\n", "line 3: got"},
        BadMotionFile{"short row", "planar/force", "t,shoulder,elbow\n0,1,1\n1,1\n", "line 3: got"},
        BadMotionFile{"t repeats", "planar/force", "t,shoulder,elbow\n0,1,1\n\n0,1,1\n",
                      "line 4: got t = 0 after 0"},
        BadMotionFile{"t falls", "planar/force", "t,shoulder,elbow\n0,1,1\n1,1,1\n0.5,1,1\n",
                      "line 4: got t = 0.5 after 1"},
        BadMotionFile{"too large", "planar/force", "t,shoulder,elbow\n0,1,1\n1,1e300,1\n",
                      "got forces that are not finite"},
        BadMotionFile{"unknown joint", "planar/force", "t,shoulder,elbo\n0,1,1\n1,1,1\n",
                      "columns: got elbo, expected one of"},
        BadMotionFile{"twice", "planar/force", "t,shoulder,shoulder\n0,1,1\n1,1,1\n",
                      "columns: got shoulder twice"},
        BadMotionFile{"missing joint", "planar/force", "t,shoulder\n0,1\n1,1\n",
                      "columns: got no elbow"},
        BadMotionFile{"missing rate", "planar/force",
                      "t,shoulder,elbow,shoulder_dot\n0,1,1,0\n1,1,1,0\n",
                      "columns: got no elbow_dot"},
        BadMotionFile{"only second derivatives", "planar/force",
                      "t,shoulder,elbow,shoulder_ddot,elbow_ddot\n0,1,1,0,0\n1,1,1,0,0\n",
                      "NAME_ddot without NAME_dot"},
        BadMotionFile{"base of a fixed robot", "fixed/push", "t,base_x\n0,1\n1,1\n",
                      "columns: got base_x"},
        BadMotionFile{"part of a free base", "uvms/valve",
                      "t,q1_shoulder_yaw,q2_shoulder_pitch,q3_elbow,q4_wrist_roll,base_x\n"
                      "0,3,0.4,2,0,0\n1,3,0.4,2,0,0\n",
                      "columns: got no base_y"},
        BadMotionFile{"base beside its axes", "planar/force",
                      "t,shoulder,elbow,base_x,base_z\n0,1,1,0,0\n1,1,1,0,0.1\n",
                      "line 3: got the base at"},
        BadMotionFile{"after the path", "planar/trajectory",
                      "t,shoulder,elbow\n0,-0.8,1\n99,-0.8,1\n",
                      "line 3: got t = 99, expected a time of the path"},
        BadMotionFile{"second contact", "planar/two_arms", "t,a\n0,1\n1,1\n",
                      "contact: got a second contact"}));

/// A joint that a gear moves may come before the joint that leads it: its motion is the same as
/// with a column of its own.
TEST(MotionInstants, AFollowerMayComeBeforeItsLeader) {
  Problem problem = load_problem("fixed/push");
  std::vector<std::string> names = joint_names(problem.robot);
  MotionTable table = waves(names, 5, 2, 2);
  table.values.col(0) = 0.5 * table.values.col(2).array() + 0.1;
  table.rates.col(0) = 0.5 * table.rates.col(2);
  table.accelerations.col(0) = 0.5 * table.accelerations.col(2);
  const std::vector<Instant> stated = motion_instants(problem, table);
  problem.robot.joints[0].gear = Gear{.leader = 2, .ratio = 0.5, .offset = 0.1};
  const Eigen::Index others = table.values.cols() - 1;
  table.names.erase(table.names.begin());
  for (Eigen::MatrixXd* each : {&table.values, &table.rates, &table.accelerations}) {
    *each = each->rightCols(others).eval();
  }
  const std::vector<Instant> geared = motion_instants(problem, table);
  ASSERT_EQ(geared.size(), stated.size());
  for (std::size_t i = 0; i < stated.size(); ++i) {
    EXPECT_TRUE(geared[i].q.isApprox(stated[i].q, 1e-15)) << geared[i].q.transpose();
    EXPECT_TRUE(geared[i].v.isApprox(stated[i].v, 1e-15)) << geared[i].v.transpose();
    EXPECT_TRUE(geared[i].v_dot.isApprox(stated[i].v_dot, 1e-15)) << geared[i].v_dot.transpose();
  }
}

/// Roll, pitch and yaw go on beyond a whole turn: the base does not spin back.
TEST(MotionInstants, AnglesOfTheBaseGoOn) {
  const Problem problem = load_problem("planar/force");
  MotionTable table;
  table.names = {"shoulder", "elbow", "base_yaw"};
  table.values.resize(9, 3);
  for (int row = 0; row < 9; ++row) {
    table.t.push_back(0.1 * row);
    table.values.row(row) << -0.8, 1, std::remainder(3 + 0.1 * row, 2 * std::numbers::pi);
  }
  for (const Instant& instant : motion_instants(problem, table)) {
    EXPECT_NEAR(instant.v[2], 1, 1e-9);
  }
}

}  // namespace
}  // namespace maxwrench
