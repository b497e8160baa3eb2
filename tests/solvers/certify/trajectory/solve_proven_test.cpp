#include <gtest/gtest.h>

#include "maxwrench/load.h"
#include "maxwrench/trajectory_proof.h"
#include "tests/support/trajectory_proofs.h"

namespace maxwrench {
namespace {

/// The shipped impulse keeps the speed limit of its elbow at its instants, not between them. The
/// search with a tighter limit finds one that keeps it at all times, of almost the same value.
TEST(SolveProven, SLOW_FindsAProvenImpulse) {
  const Problem problem = load_problem("uvms/valve_impulse");
  const TrajectoryProof shipped =
      certify_trajectory(problem, shipped_knots("uvms_valve_impulse_spline", problem));
  EXPECT_EQ(shipped.status, Status::kInvalidPosture);
  EXPECT_NE(shipped.reason.str().find("q3_elbow moves at 0.50"), std::string::npos);
  Options options;
  options.budget = 1000;
  const TrajectoryProof proof = solve_proven(problem, options);
  EXPECT_EQ(proof.status, Status::kProven) << proof.reason.str();
  EXPECT_EQ(proof.answer.status, Status::kBestFound);
  const double between = proof.answer.trajectory.value_between_knots;
  EXPECT_LE(proof.guaranteed, between);
  EXPECT_GE(proof.guaranteed, between * (1 - 5e-4));
  EXPECT_GT(proof.guaranteed, 39.7);
  EXPECT_FALSE(proof.held);
  EXPECT_GT(proof.searched, 39.7);
  EXPECT_NE(proof.rejection.find("q3_elbow moves at 0.50"), std::string::npos) << proof.rejection;
}

/// The trajectory that the search finds is too fast between its instants, and what follows from
/// slower joints touches itself between knots. Little is lost where its bodies move apart there.
TEST(SolveProven, SLOW_FindsAProvenLiftThatTouchesItself) {
  const Problem problem = load_problem("uvms/lift_impulse");
  Options options;
  options.budget = 1000;
  const TrajectoryProof proof = solve_proven(problem, options);
  EXPECT_EQ(proof.status, Status::kProven) << proof.reason.str();
  EXPECT_NE(proof.rejection, "");
  EXPECT_GE(proof.guaranteed, proof.searched * (1 - 1e-3));
  EXPECT_GE(proof.clearance, -1e-5);
}

/// What the search finds for 4 instants an interval, no efforts follow between them.
TEST(SolveProven, SLOW_FindsAProvenTurnInAHurry) {
  const Problem problem = load_problem("uvms/valve_trajectory_fast");
  Options options;
  options.budget = 2000;
  const Answer searched = solve(problem, options);
  EXPECT_NE(certify_trajectory(problem, searched.trajectory.knots).status, Status::kProven);
  const TrajectoryProof proof = solve_proven(problem, options);
  EXPECT_EQ(proof.status, Status::kProven) << proof.reason.str();
  EXPECT_EQ(proof.answer.status, Status::kBestFound);
  EXPECT_GE(proof.guaranteed, searched.beta() * (1 - 3e-3));
  EXPECT_GT(proof.answer.evaluations, searched.evaluations);
}

/// In 1.2 s no effort rates follow what the search finds between its instants. The start is a
/// static optimum, held with 35.4083 N m.
TEST(SolveProven, SLOW_FindsAProvenImpulseInAHurry) {
  Problem problem = load_problem("uvms/valve_impulse");
  problem.motion->T = 1.2;
  problem.motion->k = 6;
  problem.motion->t_h = 4;
  Options options;
  options.budget = 300;
  const Answer searched = solve(problem, options);
  const TrajectoryProof proof = solve_proven(problem, options);
  EXPECT_EQ(proof.status, Status::kProven) << proof.reason.str();
  EXPECT_EQ(proof.answer.status, Status::kBestFound);
  EXPECT_GT(proof.guaranteed, 35.4083);
  EXPECT_GE(proof.answer.beta(), proof.guaranteed);
  EXPECT_LE(proof.answer.beta(), proof.guaranteed * (1 + 1e-3));
  EXPECT_GE(proof.answer.evaluations, searched.evaluations);
}

/// Wheels have no effort rates, and the plan of the search needs all of an effort at an instant
/// where no wrench helps. It pushes 406.37 N at its instants, a posture that is held 187.94 N.
TEST(SolveProven, SLOW_FindsAProvenImpulseOfDependentJoints) {
  const Problem problem = load_problem(MAXWRENCH_SOURCE_DIR "/examples/tasks/rover_impulse.toml");
  const TrajectoryProof proof = solve_proven(problem, {});
  EXPECT_EQ(proof.status, Status::kProven) << proof.reason.str();
  EXPECT_FALSE(proof.held);
  EXPECT_GE(proof.guaranteed, proof.searched * (1 - 1e-3));
  EXPECT_LE(proof.guaranteed, proof.answer.trajectory.value_between_knots);
  EXPECT_NE(proof.rejection.find("shoulder_yaw moves at 1.50"), std::string::npos)
      << proof.rejection;
}

/// With 100 evaluations the search ends at a trajectory that leaves the limits of the wrist between
/// its instants, and so do those from there. The default posture, held, is worth a little less.
TEST(SolveProven, SaysWhereAPostureIsHeldInsteadOfWhatWasFound) {
  Problem problem = load_problem("uvms/valve_impulse");
  problem.motion->T = 100;
  Options options;
  options.budget = 100;
  const Answer searched = solve(problem, options);
  const TrajectoryProof refused = certify_trajectory(problem, searched.trajectory.knots);
  ASSERT_EQ(refused.status, Status::kInvalidPosture);
  const TrajectoryProof proof = solve_proven(problem, options);
  EXPECT_EQ(proof.status, Status::kProven) << proof.reason.str();
  EXPECT_TRUE(proof.held);
  EXPECT_EQ(proof.answer.trajectory.knots,
            problem.theta_r_default.transpose().replicate(problem.motion->k, 1));
  EXPECT_EQ(proof.searched, searched.trajectory.value_between_knots);
  EXPECT_GT(proof.searched, proof.guaranteed);
  EXPECT_EQ(proof.rejection, "invalid_posture: " + refused.reason.str());
}

/// The trajectory of the search is proven: there is no other.
TEST(SolveProven, HasNothingToSayOfTheSearchWhereItsTrajectoryIsProven) {
  const Problem problem = load_problem("uvms/valve_trajectory");
  Options options;
  options.budget = 60;
  const TrajectoryProof proof = solve_proven(problem, options);
  EXPECT_EQ(proof.status, Status::kProven) << proof.reason.str();
  EXPECT_FALSE(proof.held);
  EXPECT_TRUE(std::isnan(proof.searched));
  EXPECT_EQ(proof.rejection, "");
}

}  // namespace
}  // namespace maxwrench
