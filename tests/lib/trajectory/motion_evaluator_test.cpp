#include "lib/trajectory/motion_evaluator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "maxwrench/load.h"
#include "maxwrench/strategies.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

/// A path that turns and moves the tool of a shipped problem, with a curve of theta_r beside it.
struct Moving {
  explicit Moving(const std::string& name) : problem(load_problem(name)) {
    const bool planar = problem.robot.base_axes.size() == 3;
    const Eigen::Vector3d axis =
        planar ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d(1, -2, 3).normalized();
    path = Path::screw(problem.pose, axis, {0.2, 0.1, 0}, 0.8, {0.1, -0.2, planar ? 0 : 0.3},
                       Timing::kQuintic, 3);
    Random random(5);
    for (int i = 0; i < 3; ++i) curve.push_back(random_theta_r(problem, random));
  }

  /// q(t) = a + b sin(t) / 10 + c t^2 / 50 and its derivatives.
  void set(double t, RobotMotion<double>& robot_motion) const {
    const Eigen::VectorXd q = curve[0] + std::sin(t) / 10 * curve[1] + t * t / 50 * curve[2];
    const Eigen::VectorXd rate = std::cos(t) / 10 * curve[1] + t / 25 * curve[2];
    const Eigen::VectorXd bend = -std::sin(t) / 10 * curve[1] + 1.0 / 25 * curve[2];
    robot_motion.set(path.at(t), q, rate, bend);
  }

  Problem problem;
  Path path = Path::constant({}, 1);
  std::vector<Eigen::VectorXd> curve;
};

class FollowedPath : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Robots, FollowedPath, testing::Values("uvms/valve", "planar/force"));

TEST_P(FollowedPath, VelocitiesAreThoseOfTheEndEffector) {
  const Moving moving(GetParam());
  const Robot& robot = moving.problem.robot;
  RobotMotion<double> robot_motion(moving.problem);
  Kinematics<double> kinematics(robot);
  Matrix6Xd J(6, robot.velocities());
  for (const double t : {0.4, 1.5, 2.6}) {
    moving.set(t, robot_motion);
    kinematics.set_joints(robot_motion.q());
    const EndEffector& tool = robot.end_effectors[0];
    const Pose<double> reached = robot_motion.base() * kinematics.end_effector(tool);
    EXPECT_TRUE(reached.p.isApprox(moving.path.pose(t).p, 1e-12));
    EXPECT_TRUE(reached.R.isApprox(moving.path.pose(t).R, 1e-12));
    kinematics.jacobian(tool, robot_motion.base().R, J);
    EXPECT_TRUE((J * robot_motion.v()).isApprox(moving.path.at(t).twist, 1e-11));
  }
}

TEST_P(FollowedPath, AccelerationsAreDerivativesOfTheVelocities) {
  const Moving moving(GetParam());
  RobotMotion<double> robot_motion(moving.problem);
  const double h = 1e-5;
  for (const double t : {0.4, 1.5, 2.6}) {
    moving.set(t + h, robot_motion);
    const Eigen::VectorXd after = robot_motion.v();
    moving.set(t - h, robot_motion);
    const Eigen::VectorXd before = robot_motion.v();
    moving.set(t, robot_motion);
    EXPECT_TRUE(((after - before) / (2 * h)).isApprox(robot_motion.v_dot(), 1e-8));
  }
}

TEST(Motion, AllocatesNothingAfterTheFirstCall) {
  for (const char* name : {"uvms/valve_trajectory", "uvms/valve_impulse", "mobile/trajectory"}) {
    const Problem problem = load_problem(name);
    MotionEvaluator motion(problem, make_scheme(*problem.motion));
    const Eigen::MatrixXd Q =
        problem.theta_r_default.transpose().replicate(motion.maps().knots(), 1);
    std::vector<Instant> instants;
    std::vector<MotionSlopes> slopes;
    motion.evaluate(Q, instants);
    motion.linearize(instants, slopes);
    const long before = allocation_count();
    motion.evaluate(Q, instants);
    motion.linearize(instants, slopes);
    EXPECT_EQ(allocation_count(), before) << name;
  }
}

/// A task in time and how its value is found.
struct Sloped {
  const char* problem;
  Scheme scheme;
  Wrench wrench;
};

std::string name_of(const testing::TestParamInfo<Sloped>& info) {
  std::string name = info.param.problem;
  name.replace(name.find('/'), 1, "_");
  return name + "_" + to_string(info.param.scheme) + "_" + to_string(info.param.wrench);
}

class TrajectoryGradient : public testing::TestWithParam<Sloped> {};
INSTANTIATE_TEST_SUITE_P(
    Schemes, TrajectoryGradient,
    testing::Values(Sloped{"uvms/valve_trajectory", Scheme::kSpline, Wrench::kPure},
                    Sloped{"uvms/valve_trajectory", Scheme::kEnds, Wrench::kPure},
                    Sloped{"uvms/valve_trajectory", Scheme::kForward, Wrench::kPure},
                    Sloped{"uvms/valve_trajectory", Scheme::kSpline, Wrench::kAny},
                    Sloped{"uvms/jet_trajectory", Scheme::kSpline, Wrench::kPure},
                    Sloped{"planar/trajectory", Scheme::kSpline, Wrench::kPure},
                    Sloped{"mobile/trajectory", Scheme::kSpline, Wrench::kPure},
                    Sloped{"mobile/trajectory", Scheme::kEnds, Wrench::kPure},
                    Sloped{"mobile/trajectory", Scheme::kForward, Wrench::kPure},
                    Sloped{"mobile/trajectory", Scheme::kSpline, Wrench::kAny},
                    Sloped{"mobile/push", Scheme::kSpline, Wrench::kPure},
                    Sloped{"mobile/push", Scheme::kForward, Wrench::kPure},
                    Sloped{"uvms/valve_impulse", Scheme::kSpline, Wrench::kPure},
                    Sloped{"uvms/valve_impulse", Scheme::kBackward, Wrench::kPure},
                    Sloped{"uvms/valve_impulse", Scheme::kForward, Wrench::kPure}),
    name_of);

/// A table around a random constant posture, or around the start of an impulse.
Eigen::VectorXd random_table(const Problem& problem, Random& random) {
  const int k = problem.motion->k;
  const Eigen::VectorXd around =
      problem.motion->impulse ? problem.theta_r_default : random_theta_r(problem, random);
  Eigen::VectorXd x = around.replicate(k, 1);
  for (double& x_i : x) x_i += random.uniform(-0.05, 0.05);
  return x;
}

/// A static problem as an impulse from its default.
Problem load_moving(const char* name) {
  Problem problem = load_problem(name);
  if (problem.motion) return problem;
  MotionTask& task = problem.motion.emplace();
  task.impulse = true;
  task.T = 4;
  task.k = 4;
  task.t_h = 3;
  task.path = Path::constant(problem.pose, task.T);
  task.theta_0 = problem.theta_r_default;
  return problem;
}

TEST_P(TrajectoryGradient, IsThatOfCentralDifferences) {
  Problem problem = load_moving(GetParam().problem);
  problem.motion->scheme = GetParam().scheme;
  problem.robot.collision = nullptr;
  for (Joint& joint : problem.robot.joints) joint.velocity_max = kInfinity;
  for (const int i : problem.dependent) {
    Joint& joint = problem.robot.joints[static_cast<std::size_t>(i)];
    joint.q_min = -10;
    joint.q_max = 10;
  }
  const Problem drawn = problem;
  problem.theta_r_min.setConstant(-10);
  problem.theta_r_max.setConstant(10);
  // The row on the start of a smooth impulse is no matter of the gradient: any table has a value
  // here that keeps it, so tables are drawn in its null space.
  const auto objective = make_trajectory_objective(
      problem, GetParam().wrench, find_trajectory_solver("facets_or_ipm").make, false);
  const KnotRows& rows = *objective->rows();
  const Eigen::MatrixXd R = rows.R;
  std::vector<Eigen::Index> equations;
  for (Eigen::Index i = 0; i < rows.r_min.size(); ++i) {
    if (rows.r_min[i] == rows.r_max[i]) equations.push_back(i);
  }
  const Eigen::MatrixXd E = R(equations, Eigen::all);
  const auto kept = [&](Eigen::VectorXd direction) {
    if (E.rows() == 0) return direction;
    return Eigen::VectorXd(direction -
                           E.transpose() * (E * E.transpose()).ldlt().solve(E * direction));
  };
  Random random(11);
  Eigen::VectorXd gradient;
  const int wanted = std::max(4, samples(200));
  const Eigen::VectorXd start = problem.theta_r_default.replicate(problem.motion->k, 1);
  int compared = 0, kinks = 0;
  for (int sample = 0; compared < wanted && sample < 6 * wanted; ++sample) {
    // What is beyond the limits of other joints is hardly ever reached.
    const Problem& around = problem.dependent.empty() ? problem : drawn;
    const Eigen::VectorXd x = start + kept(random_table(around, random) - start);
    Eigen::VectorXd direction(x.size());
    for (double& d : direction) d = random.normal();
    direction = kept(direction).normalized();
    const double value = objective->evaluate(x, &gradient);
    if (value == -kInfinity) continue;
    const double h = 1e-5;
    const double right = (objective->evaluate(x + h * direction) - value) / h;
    const double left = (value - objective->evaluate(x - h * direction)) / h;
    const double scale = 1 + gradient.norm();
    // At a kink the one-sided derivatives differ by more than curvature makes of them.
    if (std::abs(right - left) > 1e-3 * scale) {
      ++kinks;
      continue;
    }
    ++compared;
    // Of 200 tables the worst are off by 3e-7.
    EXPECT_NEAR(gradient.dot(direction), (right + left) / 2, 1e-6 * scale);
  }
  EXPECT_GE(compared, wanted / 2) << kinks << " kinks";
  RecordProperty("kinks", kinks);
}

}  // namespace
}  // namespace maxwrench
