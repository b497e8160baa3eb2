#include "lib/trajectory/robot_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/trajectory/motion_evaluator.h"
#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"
#include "tests/reference_models/lagrange.h"
#include "tests/reference_models/vertices.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

/// The rover with a level tool at (x, y) that heads along `heading`, in closed form: the arm moves
/// in a vertical plane that contains the tool's axis, so with a = -q_pitch and f = a - q_elbow the
/// angles of upper arm and forearm to the ground, 0.5 + 0.45 sin a + 0.4 sin f = 0.9 (elbow up, as
/// the guess), the hand is level, and the base stands under the shoulder with yaw = heading -
/// q_yaw.
struct RoverPose {
  double x, y, yaw;
  Eigen::VectorXd q = Eigen::VectorXd::Zero(5);

  RoverPose(const Pose<double>& tool, const Eigen::Vector2d& theta_r) {
    const double heading = std::atan2(tool.R(1, 0), tool.R(0, 0)), a = -theta_r[1];
    const double f = std::asin((0.4 - 0.45 * std::sin(a)) / 0.4);
    q << theta_r, a - f, f, 0;
    yaw = heading - theta_r[0];
    const double reach = 0.45 * std::cos(a) + 0.4 * std::cos(f) + 0.18;
    x = tool.p.x() - 0.2 * std::cos(yaw) - reach * std::cos(heading);
    y = tool.p.y() - 0.2 * std::sin(yaw) - reach * std::sin(heading);
  }
};

/// Fourth-order differences.
template <class F>
Eigen::VectorXd slope_of(const F& f, double t, double h) {
  return (8 * (f(t + h) - f(t - h)) - (f(t + 2 * h) - f(t - 2 * h))) / (12 * h);
}

/// mobile/trajectory with a curve of theta_r, and its dependent coordinates in closed form.
struct Door {
  Problem problem = load_problem("mobile/trajectory");

  Eigen::Vector2d theta_r(double t) const {
    return {0.3 + 0.8 * std::sin(t), -1.1 + 0.3 * std::cos(1.3 * t)};
  }
  RoverPose pose(double t) const { return {problem.motion->path.pose(t), theta_r(t)}; }
  Eigen::VectorXd velocity(double t) const {
    const Eigen::VectorXd rates = slope_of(
        [&](double at) {
          const RoverPose rover = pose(at);
          Eigen::VectorXd all(8);
          all << rover.x, rover.y, rover.yaw, rover.q;
          return all;
        },
        t, 1e-3);
    Eigen::VectorXd v = rates;
    v.head<2>() = Eigen::Rotation2Dd(-pose(t).yaw) * rates.head<2>();
    return v;
  }
  Eigen::VectorXd acceleration(double t) const {
    return slope_of([&](double at) { return velocity(at); }, t, 1e-3);
  }
};

TEST(RobotMotionTracker, IsTheClosedFormOfTheRover) {
  const Door door;
  RobotMotionTracker robot_motion(door.problem);
  const auto rate = [&](double t) -> Eigen::VectorXd {
    return slope_of([&](double at) -> Eigen::VectorXd { return door.theta_r(at); }, t, 1e-3);
  };
  for (double t = 0.05; t < 2.9; t += 0.05) {
    const Eigen::VectorXd bend = slope_of(rate, t, 1e-3);
    ASSERT_EQ(robot_motion.set(door.problem.motion->path.at(t), door.theta_r(t), rate(t), bend),
              nullptr);
    const RobotMotion<double>& motion = robot_motion.motion();
    const RoverPose expected = door.pose(t);
    EXPECT_LT((motion.q() - expected.q).norm(), 1e-12);
    EXPECT_NEAR(motion.base().p.x(), expected.x, 1e-12);
    EXPECT_NEAR(motion.base().p.y(), expected.y, 1e-12);
    EXPECT_NEAR(
        std::remainder(std::atan2(motion.base().R(1, 0), motion.base().R(0, 0)) - expected.yaw,
                       2 * M_PI),
        0, 1e-12);
    EXPECT_LT((motion.v() - door.velocity(t)).norm(), 1e-9);
    EXPECT_LT((motion.v_dot() - door.acceleration(t)).norm(), 1e-7);
    EXPECT_LT(motion.twist_missed(), 1e-12);
    EXPECT_LT(motion.acceleration_missed(), 1e-12);
  }
}

/// On a screw about a skew axis, with all six of the tool's motions: velocities are the derivatives
/// of positions and of the base's pose, accelerations those of velocities.
TEST(RobotMotionTracker, VelocitiesAndAccelerationsAreDerivatives) {
  for (const char* name : {"mobile/push", "fixed/push"}) {
    const Problem problem = load_problem(name);
    const Path path = Path::screw(problem.pose, Eigen::Vector3d(1, -2, 3).normalized(),
                                  {0.2, 0.1, 0}, 0.4, {0.05, -0.05, 0.03}, Timing::kQuintic, 2);
    const Eigen::VectorXd way = Eigen::VectorXd::LinSpaced(problem.redundancy(), 0.2, -0.1);
    RobotMotionTracker robot_motion(problem);
    const auto at = [&](double t) {
      const Eigen::VectorXd theta_r = problem.theta_r_default + std::sin(t) * way;
      EXPECT_EQ(robot_motion.set(path.at(t), theta_r, std::cos(t) * way, -std::sin(t) * way),
                nullptr);
      return robot_motion.motion();
    };
    const double h = 1e-5;
    const auto axes = static_cast<Eigen::Index>(problem.robot.base_axes.size());
    for (const double t : {0.2, 0.7, 1.2, 1.7}) {
      const auto before = at(t - h), now = at(t), after = at(t + h);
      EXPECT_LT(((after.q() - before.q()) / (2 * h) - now.v().tail(now.q().size())).norm(), 1e-8);
      EXPECT_LT(((after.v() - before.v()) / (2 * h) - now.v_dot()).norm(), 1e-7);
      Vector6d base;
      base << now.base().R.transpose() * (after.base().p - before.base().p),
          logarithm(before.base().R.transpose() * after.base().R);
      for (Eigen::Index i = 0; i < axes; ++i) {
        const int axis = problem.robot.base_axes[static_cast<std::size_t>(i)];
        EXPECT_NEAR(base[axis] / (2 * h), now.v()[i], 1e-8);
        base[axis] = 0;
      }
      EXPECT_LT(base.norm(), 1e-14);
    }
  }
}

/// A table around the task's default.
Eigen::MatrixXd knots_near_default(const Problem& problem, Random& random) {
  Eigen::MatrixXd knots = problem.theta_r_default.transpose().replicate(problem.motion->k, 1);
  for (double& q : knots.reshaped()) q += random.uniform(-0.05, 0.05);
  return knots;
}

/// Along trajectories of all schemes: the pose is met, J v is the twist, and tau_d and J are those
/// of Lagrange's equations on the files of the robot, as is the value of the worst instant (no
/// effort of the rover has a rate limit) by trying every vertex.
TEST(RobotMotionTracker, TrajectoriesAreThoseOfAnIndependentModel) {
  const reference::Lagrange lagrange(std::filesystem::path(MAXWRENCH_SOURCE_DIR) /
                                     "problems/mobile/rover.toml");
  Random random(8);
  for (const Scheme scheme : {Scheme::kSpline, Scheme::kForward, Scheme::kEnds}) {
    Problem problem = load_problem("mobile/trajectory");
    problem.motion->scheme = scheme;
    for (Joint& joint : problem.robot.joints) joint.velocity_max = kInfinity;
    TrajectoryEvaluator evaluator(problem, Wrench::kPure, trajectory_solvers().front().make);
    const Trajectory& trajectory = evaluator.evaluate(knots_near_default(problem, random));
    ASSERT_EQ(trajectory.status, Status::kOptimal) << trajectory.reason.c_str();
    double worst = kInfinity;
    for (const Instant& instant : trajectory.instants) {
      reference::Place place;
      place.p = instant.base.p;
      place.rpy.z() = std::atan2(instant.base.R(1, 0), instant.base.R(0, 0));
      const auto terms = lagrange.terms(place, instant.q, instant.v, instant.v_dot, "tool");
      const Eigen::Isometry3d tool = lagrange.tool(place, instant.q, "tool");
      EXPECT_LT((tool.translation() - instant.end_effector.p).norm(), 1e-12);
      EXPECT_LT((tool.linear() - instant.end_effector.R).norm(), 1e-12);
      EXPECT_LT((terms.tau_d - instant.tau_d).norm(), 1e-9 * (1 + terms.tau_d.norm()));
      EXPECT_LT((terms.J - instant.J).norm(), 1e-11);
      WrenchProgram program = make_wrench_program(problem, Wrench::kPure);
      program.tau_d = terms.tau_d;
      program.JtW = terms.J.transpose() * instant.c;
      const std::optional<double> beta = brute_force(program);
      ASSERT_TRUE(beta);
      worst = std::min(worst, *beta);
    }
    EXPECT_NEAR(trajectory.value, worst, 1e-7 * worst) << to_string(scheme);
  }
}

/// At rest a trajectory of one knot is a posture.
TEST(RobotMotionTracker, OneKnotIsTheStaticPosture) {
  const Problem problem = load_problem("mobile/push");
  TrajectoryEvaluator evaluator(problem, Wrench::kPure, trajectory_solvers().front().make);
  PostureEvaluator model(problem);
  const auto measure = make_linf_polytope(problem.robot, find_wrench_solver("facets").make());
  WrenchProgram program = make_wrench_program(problem, Wrench::kPure);
  Random random(3);
  int compared = 0;
  for (int i = 0; i < 200; ++i) {
    const Eigen::VectorXd theta_r = random_theta_r(problem, random);
    const Posture& posture = model.evaluate(theta_r);
    const Trajectory& trajectory = evaluator.evaluate(theta_r.transpose());
    const bool collides = posture.violation == Violation::kCollision;
    EXPECT_EQ(trajectory.status == Status::kInvalidPosture,
              posture.status != Status::kValid && !collides);
    EXPECT_TRUE(!collides || !trajectory.collision.empty());
    if (posture.status != Status::kValid || trajectory.status != Status::kOptimal) continue;
    Capability capability;
    set_posture(posture, program);
    measure->evaluate(posture, program, true, capability);
    EXPECT_NEAR(trajectory.value, capability.beta, 1e-9 * (1 + std::abs(capability.beta)));
    ++compared;
  }
  EXPECT_GT(compared, 50);
}

/// A dependent joint goes on from instant to instant, beyond half a turn too; there is no IK
/// solution to fall back to.
TEST(RobotMotionTracker, KeepsToItsIkSolutionOverATurn) {
  Problem problem = load_problem("mobile/trajectory");
  problem.motion->path =
      Path::screw(problem.pose, Eigen::Vector3d::UnitZ(), problem.pose.p, 3 * M_PI,
                  Eigen::Vector3d::Zero(), Timing::kCubic, problem.motion->T);
  MotionEvaluator motion(problem, make_dense_spline(*problem.motion, 25));
  std::vector<Instant> instants;
  const Eigen::MatrixXd Q = problem.theta_r_default.transpose().replicate(problem.motion->k, 1);
  motion.evaluate(Q, instants);
  ASSERT_EQ(motion.lost(), -1) << motion.lost_reason();
  for (const Instant& instant : instants) {
    EXPECT_LT((instant.q - instants.front().q).norm(), 1e-11);
    EXPECT_NEAR(instant.base.p.z(), 0, 1e-12);
  }
}

TEST(RobotMotionTracker, SaysWhereItGetsLost) {
  Problem problem = load_problem("mobile/trajectory");
  const auto reason_along = [&](const Eigen::Vector3d& way, Timing timing) {
    problem.motion->path = Path::screw(problem.pose, Eigen::Vector3d::UnitZ(), problem.pose.p, 0,
                                       way, timing, problem.motion->T);
    TrajectoryEvaluator evaluator(problem, Wrench::kPure, trajectory_solvers().front().make);
    const Trajectory& trajectory =
        evaluator.evaluate(problem.theta_r_default.transpose().replicate(problem.motion->k, 1));
    EXPECT_EQ(trajectory.status, Status::kInvalidPosture);
    EXPECT_TRUE(std::isnan(trajectory.instants.back().q[2]));
    EXPECT_FALSE(evaluator.least_clearance());
    EXPECT_EQ(evaluator.evaluate_elastic(trajectory.knots, nullptr), -kInfinity);
    return trajectory.reason.str();
  };
  // 0.5 + 0.45 sin 1 + 0.4 m is 1.279 m above the ground; the tool leaves 0.9 m.
  const std::string up = reason_along({0, 0, 1}, Timing::kLinear);
  EXPECT_TRUE(up.starts_with("unreachable pose at t = 1.") || up.starts_with("singular at t = 1."))
      << up;
}

/// A fixed arm of three links of 1 m that turn about z cannot lift its tool: the twist at the start
/// shows it before any pose does.
TEST(RobotMotionTracker, RejectsAPathThatTheRobotCannotMoveAlong) {
  Problem problem;
  Robot& robot = problem.robot;
  robot.links.resize(5);
  for (int i = 0; i < 4; ++i) {
    Joint joint;
    joint.parent = i;
    joint.placement.p = Eigen::Vector3d(i == 0 ? 0 : 1, 0, 0);
    robot.joints.push_back(joint);
  }
  robot.end_effectors = {{"tool", 4, {}}};
  complete_actuation(robot);
  problem.pose.p = {1.5, 0.5, 0};
  problem.redundant = {0};
  problem.dependent = {1, 2, 3};
  problem.theta_r_default = Eigen::VectorXd::Constant(1, 0.5);
  problem.theta_r_min = problem.theta_r_max = problem.theta_r_default;
  problem.guess_q = Eigen::Vector4d(0.5, -0.5, 1.5, 0);
  MotionTask task;
  task.k = 3;
  const auto lost_along = [&](const Eigen::Vector3d& way) {
    task.path = Path::screw(problem.pose, Eigen::Vector3d::UnitZ(), problem.pose.p, 0, way,
                            Timing::kLinear, 1);
    MotionEvaluator motion(problem, make_scheme(task));
    std::vector<Instant> instants;
    motion.evaluate(Eigen::MatrixXd::Constant(3, 1, 0.5), instants);
    return std::pair(motion.lost(), std::string(motion.lost() < 0 ? "" : motion.lost_reason()));
  };
  EXPECT_EQ(lost_along({0.2, 0, 0}).first, -1);
  const auto [at, reason] = lost_along({0.2, 0, 0.1});
  EXPECT_EQ(at, 0);
  EXPECT_TRUE(reason.starts_with("unreachable motion: ")) << reason;
}

}  // namespace
}  // namespace maxwrench
