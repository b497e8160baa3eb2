#include <gtest/gtest.h>

#include "maxwrench/load.h"
#include "maxwrench/trajectory.h"
#include "solvers/certify/trajectory/edge_program.h"
#include "tests/support/trajectory_proofs.h"
#include "verify/trajectory/trajectory_model.h"
#include "verify/trajectory/verify_trajectory.h"

namespace maxwrench {
namespace {

/// The positions and rates of the dependent joints hold those of `lib` at other instants of a
/// slice, and are tight at a point.
TEST(DependentJointsInTime, EnclosesDependentJoints) {
  const Problem problem = load_problem("mobile/trajectory");
  Random random(4);
  const Eigen::MatrixXd knots = moving_knots(problem, random);
  const TrajectoryModel model(problem, knots, dependent_places(problem, knots));
  ASSERT_EQ(model.lost().reason, "");
  const int parts = 24;
  const auto axes = static_cast<Eigen::Index>(problem.robot.base_axes.size());
  const std::vector<Instant> instants = instants_by_lib(problem, knots, parts);
  int open = 0;
  for (int interval = 0; interval < model.curve().intervals(); ++interval) {
    for (int part = 0; part <= parts; ++part) {
      const Instant& here = instants[static_cast<std::size_t>(interval * parts + part)];
      const double x = part / double{parts};
      const std::vector<Jet<3>> at = model.dependent(interval, Narrow(x)).value();
      const Narrow around(std::max(0.0, x - 0.01), std::min(1.0, x + 0.02));
      const std::optional<std::vector<Jet<3>>> on_slice = model.dependent(interval, around);
      if (!on_slice) ++open;
      if (!on_slice) continue;
      const std::vector<Jet<3>>& over = *on_slice;
      for (std::size_t k = 0; k < problem.dependent.size(); ++k) {
        const Eigen::Index joint = problem.dependent[k];
        expect_holds(over[k].c[0], here.q[joint], 1e-11, "position");
        expect_holds(over[k].c[1], here.v[axes + joint], 1e-11, "rate");
        expect_holds(over[k].c[2], here.v_dot[axes + joint] / 2, 1e-9, "bend");
        EXPECT_NEAR(at[k].c[0].low, here.q[joint], 1e-10);
        EXPECT_NEAR(at[k].c[0].high, here.q[joint], 1e-10);
        EXPECT_NEAR(at[k].c[1].high, here.v[axes + joint], 1e-9);
        EXPECT_LT(over[k].c[0].high - over[k].c[0].low, 0.1);
      }
    }
  }
  EXPECT_LE(open, model.curve().intervals() * parts / 20);
}

/// Dependent joints that rest, whose boxes in time are as narrow as they begin.
TEST(DependentJointsInTime, EnclosesDependentJointsAtRest) {
  const Problem problem = load_problem(MAXWRENCH_SOURCE_DIR "/examples/tasks/rover_impulse.toml");
  const Eigen::MatrixXd knots = constant_knots(problem, problem.motion->theta_0);
  const Eigen::MatrixXd places = dependent_places(problem, knots);
  const TrajectoryModel model(problem, knots, places);
  EXPECT_EQ(model.lost().reason, "");
  const std::vector<double> moved = model.moved_from_middle(0, 0, 1);
  for (const int joint : problem.dependent) EXPECT_LT(moved[static_cast<std::size_t>(joint)], 1e-9);
}

/// Between two places, no joint is farther from the middle than it may be.
TEST(DependentJointsInTime, KnowsHowFarJointsMove) {
  const Problem problem = load_problem("mobile/trajectory");
  Random random(6);
  const Eigen::MatrixXd knots = moving_knots(problem, random);
  const TrajectoryModel model(problem, knots, dependent_places(problem, knots));
  ASSERT_EQ(model.lost().reason, "");
  const std::vector<Instant> instants = instants_by_lib(problem, knots, 24);
  double most = 0;
  for (int interval = 0; interval < model.curve().intervals(); ++interval) {
    const std::vector<double> moved = model.moved_from_middle(interval, 0.25, 0.5);
    const Instant& middle = instants[static_cast<std::size_t>(interval * 24 + 9)];
    for (int part = 6; part <= 12; ++part) {
      const Instant& here = instants[static_cast<std::size_t>(interval * 24 + part)];
      for (std::size_t joint = 0; joint < moved.size(); ++joint) {
        const double from = middle.q[static_cast<Eigen::Index>(joint)];
        const double to = here.q[static_cast<Eigen::Index>(joint)];
        EXPECT_LE(std::abs(to - from), moved[joint] + 1e-11) << joint;
        most = std::max(most, std::abs(to - from));
      }
    }
  }
  EXPECT_GT(most, 1e-3);
}

/// No tube: places of another size, not numbers, or a pose that the arm does not reach.
TEST(DependentJointsInTime, LosesDependentJointsThatHaveNoSolution) {
  Problem problem = load_problem("mobile/trajectory");
  const Eigen::MatrixXd knots = constant_knots(problem, problem.theta_r_default);
  const Eigen::MatrixXd places = dependent_places(problem, knots);
  EXPECT_EQ(TrajectoryModel(problem, knots, places).lost().reason, "");
  for (const Eigen::MatrixXd& wrong :
       {Eigen::MatrixXd(), Eigen::MatrixXd(places.leftCols(places.cols() - 1)),
        Eigen::MatrixXd(places.topRows(2)), Eigen::MatrixXd(places * NAN)}) {
    EXPECT_NE(TrajectoryModel(problem, knots, wrong).lost().reason, "");
  }
  for (Joint& joint : problem.robot.joints) joint.placement.p *= 0.2;  // too short for the pose
  const TrajectoryModel model(problem, knots, places);
  EXPECT_NE(model.lost().reason, "");
  EXPECT_FALSE(model.dependent(0, Narrow(0.5)));
  EXPECT_FALSE(model.loads<3>(0, Narrow(0.5)));
}

/// A certificate with dependent joints; each change of it is rejected.
TEST(DependentJointsInTime, KnowsDependentJoints) {
  Problem problem = load_problem("mobile/trajectory");
  const Eigen::MatrixXd knots = constant_knots(problem, problem.theta_r_default);
  const TrajectoryCertificate proof = certified(problem, knots, 25);
  ASSERT_EQ(proof.dependent.rows(), 3);
  EXPECT_TRUE(verify(problem, proof, 1).verified());
  // The places only tell solutions apart.
  TrajectoryCertificate changed = proof;
  changed.dependent.array() += 0.01;
  EXPECT_TRUE(verify(problem, changed, 1).verified());
  changed.value *= 1.01;
  EXPECT_FALSE(verify(problem, changed, 1).verified());
  changed = proof;
  changed.dependent.col(5) *= -1;  // another solution, or none
  EXPECT_FALSE(verify(problem, changed, 1).verified());
  changed.dependent.resize(0, 0);
  EXPECT_EQ(verify(problem, changed, 1).rejection, "its dependent joints have another size");
  changed.dependent.setConstant(3, proof.dependent.cols(), NAN);
  EXPECT_FALSE(verify(problem, changed, 1).verified());
}

/// The speed limit of a dependent joint, below its largest speed.
TEST(DependentJointsInTime, HoldsTheSpeedsOfDependentJoints) {
  Problem problem = load_problem("mobile/trajectory");
  Eigen::MatrixXd knots = constant_knots(problem, problem.theta_r_default);
  for (Eigen::Index i = 0; i < knots.rows(); ++i) knots(i, 1) += 0.02 * static_cast<double>(i % 2);
  const Eigen::MatrixXd places = dependent_places(problem, knots);
  EXPECT_EQ(check_motion(TrajectoryModel(problem, knots, places)).reason, "");
  Joint& elbow = problem.robot.joints[static_cast<std::size_t>(problem.dependent.front())];
  elbow.velocity_max = 0.01;
  const MotionFault fault = check_motion(TrajectoryModel(problem, knots, places));
  EXPECT_NE(fault.reason.find(elbow.name + " moves at "), std::string::npos) << fault.reason;
  EXPECT_GT(fault.t, 0);
  elbow.velocity_max = 10;
  elbow.q_max = places.row(0).minCoeff() - 0.01;
  EXPECT_NE(check_motion(TrajectoryModel(problem, knots, places)).reason.find(" is at "),
            std::string::npos);
}

}  // namespace
}  // namespace maxwrench
