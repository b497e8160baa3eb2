#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>

#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "tests/support/edited_copy.h"

namespace maxwrench {
namespace {

Eigen::Matrix3d turned(double angle, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

Problem load(const EditedCopy& copy, const char* file = "trajectory.toml") {
  return load_problem((copy.path() / file).string());
}

TEST(Motion, TheTurnOfTheValve) {
  const Problem problem = load_problem("uvms/valve_trajectory"), valve = load_problem("uvms/valve");
  EXPECT_STREQ(problem.type(), "trajectory");
  ASSERT_TRUE(problem.motion);
  const MotionTask& motion = *problem.motion;
  EXPECT_FALSE(motion.impulse);
  EXPECT_EQ(motion.T, 5);
  EXPECT_EQ(motion.k, 10);
  EXPECT_EQ(motion.scheme, Scheme::kSpline);
  EXPECT_EQ(motion.instants_per_interval, 4);
  EXPECT_TRUE(motion.rates);
  EXPECT_FALSE(motion.c_turns);
  EXPECT_EQ(motion.path.duration(), 5);
  EXPECT_EQ(motion.path.angle(), M_PI);
  EXPECT_TRUE(motion.path.pose(2.5).R.isApprox(turned(M_PI / 2, Eigen::Vector3d::UnitZ()), 1e-14));
  EXPECT_LT(motion.path.pose(5).p.norm(), 1e-15);
  EXPECT_EQ(problem.c, valve.c);
  EXPECT_EQ(problem.pose.R, valve.pose.R);
  EXPECT_EQ(problem.W_any, valve.W_any);
  EXPECT_EQ(load_problem("uvms/valve_trajectory_fast").motion->T, 1.5);
  EXPECT_FALSE(valve.motion);
  EXPECT_STREQ(valve.type(), "static");
}

/// The tool's x axis points at the axis of the pipe, 0.3 m ahead of it, and so does c.
TEST(Motion, TheJetStaysNormalToThePipe) {
  const Problem problem = load_problem("uvms/jet_trajectory");
  const MotionTask& motion = *problem.motion;
  EXPECT_TRUE(motion.c_turns);
  EXPECT_EQ(problem.c, Vector6d::Unit(0));
  for (const double t : {0.0, 3.0, 10.0}) {
    const Pose<double> pose = motion.path.pose(t);
    EXPECT_TRUE((pose.p + 0.3 * pose.R.col(0)).isApprox(Eigen::Vector3d(0.3, 0, 0), 1e-14));
  }
  EXPECT_TRUE(motion.path.pose(10).p.isApprox(Eigen::Vector3d(0.3, 0, 0.3), 1e-14));
}

TEST(Motion, Impulses) {
  const std::map<std::string, std::string> neighbours = {{"uvms/valve_impulse", "uvms/valve"},
                                                         {"uvms/lift_impulse", "uvms/lift"}};
  for (const auto& [name, neighbour] : neighbours) {
    const Problem problem = load_problem(name), at_rest = load_problem(neighbour);
    EXPECT_STREQ(problem.type(), "impulse");
    const MotionTask& motion = *problem.motion;
    EXPECT_TRUE(motion.impulse);
    EXPECT_EQ(motion.T, 2.5);
    EXPECT_EQ(motion.k, 4);
    EXPECT_EQ(motion.t_h, 3);
    EXPECT_EQ(motion.instants_per_interval, 16);
    EXPECT_EQ(motion.start, Start::kStatic);
    EXPECT_EQ(motion.theta_0, problem.theta_r_default);
    EXPECT_EQ(motion.path.pose(1).p, problem.pose.p);
    EXPECT_TRUE(motion.path.at(1).twist.isZero(0));
    EXPECT_EQ(problem.c, at_rest.c);
  }
  EXPECT_EQ(load_problem("uvms/valve_impulse").motion->theta_0[0], 3.064281330005719);
}

TEST(Motion, ShippedTasksStartAtAPostureThatExists) {
  int moving = 0;
  for (const std::string& name : shipped_problems()) {
    const Problem problem = load_problem(name);
    if (!problem.motion) continue;
    ++moving;
    PostureEvaluator model(problem);
    EXPECT_EQ(model.evaluate(problem.theta_r_default).status, Status::kValid) << name;
  }
  EXPECT_GE(moving, 6);
}

TEST(Motion, DefaultsOfATrajectory) {
  EditedCopy copy;
  copy.replace("trajectory.toml", "scheme = \"spline\"\ninstants_per_interval = 4\n", "");
  copy.replace("trajectory.toml", "timing = \"cubic\"\n", "");
  const MotionTask motion = *load(copy).motion;
  EXPECT_EQ(motion.scheme, Scheme::kSpline);
  EXPECT_EQ(motion.instants_per_interval, 4);
  EXPECT_TRUE(motion.rates);
  EXPECT_NEAR(motion.path.at(5).twist[5], 1.5 * M_PI / 2 / 10, 1e-15);  // cubic
}

TEST(Motion, WhatATrajectoryMayChoose) {
  EditedCopy copy;
  copy.replace("trajectory.toml", "scheme = \"spline\"\ninstants_per_interval = 4",
               "scheme = \"ends\"\nrates = false");
  copy.replace("trajectory.toml", "k = 8", "k = 1");  // at rest; not for the spline
  copy.replace("trajectory.toml", "\"cubic\"", "\"linear\"");
  const MotionTask motion = *load(copy).motion;
  EXPECT_EQ(motion.scheme, Scheme::kEnds);
  EXPECT_EQ(motion.k, 1);
  EXPECT_FALSE(motion.rates);
  EXPECT_NEAR(motion.path.at(1).twist[5], M_PI / 2 / 10, 1e-15);
}

constexpr const char* kImpulseText = R"(type = "impulse"
robot = "vehicle.toml"
end_effector = "tool"
label = "test"
source = "test"
pose = { xyz = [0, 0, 0], rpy = [0, 0, 0] }
motion = { T = 1, k = 3 }
start = { theta_r = [0.1, 0.2] }
wrench = { c = [1, 0, 0, 0, 0, 0] }
theta_r = { joints = ["shoulder", "elbow"] }
)";

TEST(Motion, DefaultsOfAImpulse) {
  EditedCopy copy;
  std::ofstream(copy.path() / "impulse.toml") << kImpulseText;
  const Problem problem = load(copy, "impulse.toml");
  EXPECT_EQ(problem.motion->t_h, 0);  // the best one
  EXPECT_EQ(problem.motion->scheme, Scheme::kSpline);
  EXPECT_EQ(problem.motion->instants_per_interval, 16);
  EXPECT_EQ(problem.motion->start, Start::kStatic);
  EXPECT_EQ(problem.theta_r_default, Eigen::Vector2d(0.1, 0.2));
}

TEST(Motion, WhatAImpulseMayChoose) {
  EditedCopy copy;
  std::ofstream(copy.path() / "impulse.toml") << kImpulseText;
  copy.replace("impulse.toml", "k = 3", "k = 1, scheme = \"backward_stop\", t_h = \"best\"");
  copy.replace("impulse.toml", "0.2]", "0.2], kind = \"free\"");
  const Problem problem = load(copy, "impulse.toml");
  EXPECT_EQ(problem.motion->t_h, 0);
  EXPECT_EQ(problem.motion->k, 1);
  EXPECT_EQ(problem.motion->scheme, Scheme::kBackwardStop);
  EXPECT_EQ(problem.motion->start, Start::kFree);
}

/// Given in the axes of the end effector, stored in the world's as the path starts: 10 degrees.
TEST(Motion, AWrenchInTheEndEffectorsAxes) {
  EditedCopy copy;
  copy.replace("trajectory.toml", "[wrench]", "[wrench]\nframe = \"end_effector\"");
  copy.replace("trajectory.toml", "[\"fx\", \"fy\", \"tz\"]", "[\"fx\"]");
  const Problem problem = load(copy);
  const double angle = 10 * M_PI / 180;
  Vector6d expected = Vector6d::Zero();
  expected.head<2>() << std::cos(angle), std::sin(angle);
  EXPECT_TRUE(problem.motion->c_turns);
  EXPECT_TRUE(problem.c.isApprox(expected, 1e-15));
  EXPECT_TRUE(problem.W_any.isApprox(expected, 1e-15));
}

TEST(Motion, Arc) {
  EditedCopy copy;
  copy.replace("trajectory.toml", "\"rotation\"", "\"arc\"\ncentre = [0, 1, 5]");
  const Problem problem = load(copy);
  const Pose<double> end = problem.motion->path.pose(10);  // a quarter of a circle about (0, 1)
  EXPECT_TRUE(end.p.isApprox(Eigen::Vector3d(1, 1, 0), 1e-14));
  EXPECT_TRUE((end.R * problem.pose.R.transpose())
                  .isApprox(turned(M_PI / 2, Eigen::Vector3d::UnitZ()), 1e-14));
}

TEST(Motion, Line) {
  EditedCopy copy;
  copy.replace("trajectory.toml",
               "\"rotation\"\naxis = [0, 0, 1]\nangle = 1.5707963267948966\ntiming = \"cubic\"",
               "\"line\"\ndisplacement = [0.2, -1, 0]\ntiming = \"quintic\"");
  const Problem problem = load(copy);
  const Path& path = problem.motion->path;
  EXPECT_TRUE(path.pose(5).p.isApprox(Eigen::Vector3d(0.1, -0.5, 0), 1e-14));
  EXPECT_EQ(path.pose(10).R, problem.pose.R);
  EXPECT_NEAR(path.at(5).twist[1], -1.875 / 10, 1e-15);
  EXPECT_EQ(path.angle(), 0);
}

/// A task of planar/trajectory through poses of a table.
Problem through_poses(const std::string& csv) {
  EditedCopy copy;
  const std::filesystem::path file = copy.path() / "trajectory.toml";
  std::string task = read_text(file);
  const auto cut = [&](const char* from, const char* to, const char* replacement) {
    task.replace(task.find(from), task.find(to) - task.find(from), replacement);
  };
  cut("[pose]", "[motion]", "[path]\nkind = \"poses\"\nfile = \"poses.csv\"\n");
  cut("T = ", "k = ", "");
  std::ofstream(file) << task;
  std::ofstream(copy.path() / "poses.csv") << csv;
  return load(copy);
}

TEST(Motion, PosesOfATable) {
  const Problem problem = through_poses(
      "t,x, y ,z,roll,pitch,yaw\r\n0,1,0,0,0,0,0.2\r\n\r\n1.5,1,1,0,0,0,1\n4,+1,2,0,0,0,2");
  const MotionTask& motion = *problem.motion;
  EXPECT_EQ(motion.T, 4);
  EXPECT_TRUE(problem.pose.p.isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_TRUE(problem.pose.R.isApprox(turned(0.2, Eigen::Vector3d::UnitZ()), 1e-14));
  const Pose<double> middle = motion.path.pose(1.5), end = motion.path.pose(4);
  EXPECT_TRUE(middle.p.isApprox(Eigen::Vector3d(1, 1, 0)));
  EXPECT_TRUE(middle.R.isApprox(turned(1, Eigen::Vector3d::UnitZ()), 1e-14));
  EXPECT_TRUE(end.R.isApprox(turned(2, Eigen::Vector3d::UnitZ()), 1e-14));
}

/// The same poses as quaternions, rounded and with one sign changed, are nearly the same path.
TEST(Motion, PosesAsQuaternions) {
  const Problem angles = through_poses("0,1,0,0,0,0,0.2\n1.5,1,1,0,0,0,1\n4,1,2,0,0,0,2\n");
  const Problem quaternions = through_poses(
      "t,x,y,z,qw,qx,qy,qz\n0,1,0,0,0.995004,0,0,0.099833\n1.5,1,1,0,-0.877583,0,0,-0.479426\n"
      "4,1,2,0,0.540302,0,0,0.841471\n");
  for (double t = 0; t <= 4; t += 0.5) {
    const PathPoint a = angles.motion->path.at(t), b = quaternions.motion->path.at(t);
    EXPECT_TRUE(a.pose.R.isApprox(b.pose.R, 1e-5)) << t;
    EXPECT_LT((a.acceleration - b.acceleration).norm(), 1e-4) << t;
  }
}

}  // namespace
}  // namespace maxwrench
