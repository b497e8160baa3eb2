#include "solvers/search/projected_flow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "lib/trajectory/robot_motion.h"
#include "maxwrench/load.h"
#include "maxwrench/problem.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"

namespace maxwrench {
namespace {

std::unique_ptr<TrajectoryObjective> flow_objective(const Problem& problem) {
  return make_trajectory_objective(problem, Wrench::kPure,
                                   find_trajectory_solver("facets_or_ipm").make);
}

/// A flow of a task, with as many evaluations as it needs.
class FlowCase {
 public:
  explicit FlowCase(const Problem& problem, long budget = 1'000'000)
      : objective_(flow_objective(problem)),
        run_(options_),
        probe_(*objective_, budget, run_),
        count_(probe_, problem.motion->instants_per_interval * (problem.motion->k - 1) + 1, 0),
        flow(dynamic_cast<const InstantSource&>(*objective_), problem, count_) {}

 private:
  std::unique_ptr<TrajectoryObjective> objective_;
  SearchOptions options_;
  SearchRun run_;
  Probe probe_;
  InstantCount count_;

 public:
  ProjectedFlow flow;
};

/// Away from the default, which is a maximum in some tasks.
Eigen::VectorXd aside(const Problem& problem, double by) {
  Eigen::VectorXd theta_r = problem.theta_r_default;
  for (Eigen::Index j = 0; j < theta_r.size(); ++j) theta_r[j] += by * static_cast<double>(j + 1);
  return theta_r;
}

Problem at_constant_pose(const char* name) {
  Problem problem = load_problem(name);
  problem.motion->path = Path::constant(problem.pose, problem.motion->T);
  return problem;
}

/// While joints are so slow that the posture hardly changes, the flow at a constant pose is a
/// straight line along M^-1 g: g by differences of the static capability, A_r column by column from
/// the motion at rates of one. The fastest joint moves at its limit throughout.
TEST(ProjectedFlow, FollowsTheProjectedGradientAtTheSpeedLimit) {
  constexpr double kSlow = 1e-4, kDifference = 1e-5;
  for (const char* name : {"planar/trajectory", "uvms/valve_trajectory"}) {
    Problem problem = at_constant_pose(name);
    for (Joint& joint : problem.robot.joints) joint.velocity_max = kSlow;
    const MotionTask& task = *problem.motion;
    Problem rest = problem;
    rest.motion.reset();
    const Eigen::Index r = problem.redundancy();
    const Eigen::VectorXd start = aside(problem, 0.1);
    Eigen::VectorXd g(r);
    RobotMotion<double> motion(problem);
    Eigen::MatrixXd A_r(problem.robot.velocities(), r);
    for (Eigen::Index j = 0; j < r; ++j) {
      const Eigen::VectorXd step = kDifference * Eigen::VectorXd::Unit(r, j);
      g[j] = (evaluate(rest, start + step, {}).beta() - evaluate(rest, start - step, {}).beta()) /
             (2 * kDifference);
      motion.set(task.path.at(0), start, Eigen::VectorXd::Unit(r, j), Eigen::VectorXd::Zero(r));
      A_r.col(j) = motion.v();
    }
    const Eigen::VectorXd way = (A_r.transpose() * A_r).ldlt().solve(g);
    FlowCase given(problem);
    const Eigen::MatrixXd P = given.flow.flow(start);
    ASSERT_FALSE(given.flow.stopped());
    const Eigen::VectorXd moved = (P.bottomRows<1>() - P.topRows<1>()).transpose();
    const Eigen::VectorXd expected = kSlow * task.T * way / way.lpNorm<Eigen::Infinity>();
    EXPECT_LT((moved - expected).norm(), 0.02 * expected.norm())
        << name << ": " << moved.transpose() << " for " << expected.transpose();
  }
}

/// At a constant pose f never falls along a flow, and a maximum rests.
TEST(ProjectedFlow, RaisesTheCapabilityAtAConstantPose) {
  for (const char* name : {"planar/trajectory", "uvms/valve_trajectory"}) {
    const Problem problem = at_constant_pose(name);
    FlowCase given(problem);
    const Eigen::VectorXd start = aside(problem, 0.1);
    const Eigen::MatrixXd P = given.flow.flow(start);
    double before = -kInfinity;
    for (const auto row : P.rowwise()) {
      const double value = given.flow.value(0, row.transpose());
      EXPECT_GE(value, before) << name;
      before = value;
    }
    EXPECT_GT(before, given.flow.value(0, start)) << name;
    const Eigen::VectorXd top = given.flow.climb(start);
    EXPECT_GE(given.flow.value(0, top), before - 0.05 * std::abs(before)) << name;
  }
}

/// A joint without a limit of its speed moves, too.
TEST(ProjectedFlow, MovesJointsWithoutASpeedLimit) {
  Problem problem = load_problem("planar/trajectory");
  for (Joint& joint : problem.robot.joints) joint.velocity_max = kInfinity;
  FlowCase given(problem);
  const Eigen::VectorXd start = aside(problem, 0.1);
  const Eigen::MatrixXd P = given.flow.flow(start);
  EXPECT_TRUE(P.allFinite());
  EXPECT_GT((P.row(1) - P.row(0)).norm(), 1e-3);
}

/// Neighbouring knots of the flow are as far apart as the joints' speeds permit at most, and within
/// the limits.
TEST(ProjectedFlow, KeepsLimitsAndSpeeds) {
  for (const char* name : {"planar/trajectory", "uvms/valve_trajectory", "mobile/trajectory"}) {
    Problem problem = load_problem(name);
    for (Joint& joint : problem.robot.joints) {
      joint.velocity_max = std::min(joint.velocity_max, 0.2);
    }
    const Eigen::VectorXd start = aside(problem, 0.05);
    problem.theta_r_min = start.array() - 0.1;
    problem.theta_r_max = start.array() + 0.1;
    FlowCase given(problem);
    const Eigen::MatrixXd P = given.flow.flow(start);
    const double dt = problem.motion->T / (problem.motion->k - 1);
    for (Eigen::Index j = 0; j < P.cols(); ++j) {
      const double speed =
          problem.robot
              .joints[static_cast<std::size_t>(problem.redundant[static_cast<std::size_t>(j)])]
              .velocity_max;
      for (Eigen::Index i = 0; i < P.rows(); ++i) {
        EXPECT_GE(P(i, j), problem.theta_r_min[j]) << name;
        EXPECT_LE(P(i, j), problem.theta_r_max[j]) << name;
        if (i > 0) {
          EXPECT_LE(std::abs(P(i, j) - P(i - 1, j)), speed * dt + 1e-12) << name;
        }
      }
    }
    EXPECT_GT((P.bottomRows<1>() - P.topRows<1>()).norm(), 1e-3) << name;
  }
}

}  // namespace
}  // namespace maxwrench
