#include "maxwrench/trajectory_proof.h"

#include <gtest/gtest.h>

#include "maxwrench/load.h"
#include "tests/support/trajectory_proofs.h"
#include "verify/trajectory/trajectory_model.h"
#include "verify/trajectory/verify_trajectory.h"

namespace maxwrench {
namespace {

/// The shipped turn. An independent model found 35.776335 N m as the least of 9,001 instants, at
/// 0.8972 s, and 35.7770 at 25 instants per interval.
TEST(TrajectoryProof, ProvesTheShippedTurn) {
  const Problem problem = load_problem("uvms/valve_trajectory");
  const Eigen::MatrixXd knots = shipped_knots("uvms_valve_trajectory_spline", problem);
  const TrajectoryProof proof = certify_trajectory(problem, knots);
  EXPECT_EQ(proof.status, Status::kProven) << proof.reason.str();
  EXPECT_LE(proof.guaranteed, 35.776336);
  EXPECT_GE(proof.guaranteed, 35.7770 * (1 - 5e-4));
  EXPECT_GE(proof.clearance, -1e-5);
  EXPECT_TRUE(proof.certificate.empty());
  TrajectoryProofOptions fine;
  fine.parts = 100;
  const TrajectoryProof finer = certify_trajectory(problem, knots, {}, fine);
  EXPECT_GE(finer.guaranteed, 35.7756);
  EXPECT_LE(finer.guaranteed, 35.776336);
}

/// At a posture that is held, nothing lies between samples: by an independent model 34.30164 at 25
/// instants per interval of the turn, and at rest the static capability 35.40830 of an impulse.
TEST(TrajectoryProof, ProvesHeldPostures) {
  const Problem held = load_problem("uvms/valve_trajectory");
  const TrajectoryProof turn = certify_trajectory(held, constant_knots(held, held.theta_r_default));
  EXPECT_LE(turn.guaranteed, turn.answer.trajectory.value_between_knots + 1e-9);
  EXPECT_NEAR(turn.guaranteed, 34.3, 34.3 * 5e-4);
  const Problem rest = load_problem("uvms/valve_impulse");
  const TrajectoryProof impulse =
      certify_trajectory(rest, constant_knots(rest, rest.motion->theta_0));
  EXPECT_LE(impulse.guaranteed, 35.40831);
  EXPECT_NEAR(impulse.guaranteed, 35.4083, 35.4 * 5e-4);
  for (const char* name :
       {"planar/trajectory", "uvms/jet_trajectory", "uvms/lift_impulse", "mobile/trajectory"}) {
    const Problem problem = load_problem(name);
    const Eigen::VectorXd start =
        problem.motion->impulse ? problem.motion->theta_0 : problem.theta_r_default;
    const TrajectoryProof proof = certify_trajectory(problem, constant_knots(problem, start));
    EXPECT_EQ(proof.status, Status::kProven) << name << proof.reason.str();
    const double between = proof.answer.trajectory.value_between_knots;
    EXPECT_LE(proof.guaranteed, between + 1e-6 * std::abs(between)) << name;
    EXPECT_NEAR(proof.guaranteed, between, 5e-4 * std::abs(between)) << name;
  }
}

/// The plans of coarse schemes exceed the speed of a joint on the spline through their knots.
TEST(TrajectoryProof, RefusesPlansOfCoarseSchemes) {
  Problem problem = load_problem("uvms/valve_trajectory");
  for (const Scheme scheme : {Scheme::kForward, Scheme::kEnds}) {
    problem.motion->scheme = scheme;
    const Eigen::MatrixXd knots =
        shipped_knots(std::string("uvms_valve_trajectory_") + to_string(scheme), problem);
    const TrajectoryProof proof = certify_trajectory(problem, knots);
    EXPECT_EQ(proof.status, Status::kInvalidPosture);
    EXPECT_GE(proof.t, 0);
    EXPECT_EQ(proof.reason.str().find("t = "), 0u) << proof.reason.str();
    EXPECT_NE(proof.reason.str().find("q2_shoulder_pitch moves at"), std::string::npos);
  }
  // Without limits of joints the dip between its knots is proven: 31.99 for 35.41 at its instants.
  for (Joint& joint : problem.robot.joints) joint.velocity_max = 10;
  problem.theta_r_min.array() -= 1;
  problem.theta_r_max.array() += 1;
  problem.motion->scheme = Scheme::kForward;
  Options options;
  options.check_collision = false;
  const TrajectoryProof dip =
      certify_trajectory(problem, shipped_knots("uvms_valve_trajectory_forward", problem), options);
  EXPECT_EQ(dip.status, Status::kProven) << dip.reason.str();
  EXPECT_NEAR(dip.answer.beta(), 35.408, 1e-3);
  EXPECT_NEAR(dip.guaranteed, 31.99, 31.99 * 1e-3);
}

/// The largest value of a coordinate at `per_interval` instants of each interval between knots.
double largest_at(const KnotCurve& curve, int coordinate, int per_interval, double& t) {
  double most = -kInfinity;
  for (int i = 0; i <= curve.intervals() * per_interval; ++i) {
    const int interval = std::min(i / per_interval, curve.intervals() - 1);
    const double x = double(i) / per_interval - interval;
    const double q = curve.at<3>(coordinate, interval, Narrow(x)).c[0].high;
    if (q <= most) continue;
    most = q;
    t = interval + x;
  }
  return most;
}

/// A joint whose peak lies between the sub-instants at which everything is sampled. A limit midway
/// between the peak and the largest sample is violated only there: all samples keep it.
TEST(TrajectoryProof, RefusesALimitThatIsViolatedBetweenSamplesOnly) {
  Problem problem = load_problem("uvms/valve_trajectory");
  Eigen::MatrixXd knots = constant_knots(problem, problem.theta_r_default);
  knots(4, 2) += 0.05;  // the peak is not at a knot: its neighbours differ
  knots(5, 2) += 0.04;
  const TrajectoryModel model(problem, knots);
  double t = 0;
  const double sampled = largest_at(model.curve(), 2, 25, t);
  const double peak = largest_at(model.curve(), 2, 25 * 64, t);
  ASSERT_GT(peak - sampled, 4e-6);
  problem.theta_r_max[2] = (peak + sampled) / 2;
  Options options;
  options.check_collision = false;
  const TrajectoryProof proof = certify_trajectory(problem, knots, options);
  EXPECT_EQ(proof.answer.status, Status::kOptimal);  // at its instants and between them
  EXPECT_TRUE(std::isfinite(proof.answer.trajectory.value_between_knots));
  EXPECT_EQ(proof.status, Status::kInvalidPosture);
  EXPECT_NEAR(proof.t, t * problem.motion->T / 9, problem.motion->T / 9 / 25);
  EXPECT_NE(proof.reason.str().find("q3_elbow is at"), std::string::npos) << proof.reason.str();
  problem.theta_r_max[2] = peak + 1e-5;
  const TrajectoryProof within = certify_trajectory(problem, knots, options);
  EXPECT_EQ(within.status, Status::kProven) << within.reason.str();
}

/// The proof loses little of the value between knots. It may even be above it: between two instants
/// the efforts of that program are linear, so only the end of each command is at its limit. Without
/// lag no less is proven.
TEST(TrajectoryProof, ProvesAnImpulseOfThrustersThatLag) {
  Problem problem = load_problem("uvms/valve_impulse");
  const Eigen::MatrixXd knots = shipped_knots("uvms_valve_impulse_spline_lag", problem);
  const TrajectoryProof without = certify_trajectory(problem, knots);
  problem.motion->thruster_lag = 0.1;
  const TrajectoryProof proof = certify_trajectory(problem, knots);
  EXPECT_EQ(proof.status, Status::kProven) << proof.reason.str();
  const double between = proof.answer.trajectory.value_between_knots;
  EXPECT_NEAR(proof.guaranteed, between, between * 5e-4);
  EXPECT_GE(without.guaranteed, proof.guaranteed);
}

/// For one of the numbers of parts, the interior point method has no verdict. The load of a posture
/// that is held hardly changes, so the lag costs little.
TEST(TrajectoryProof, DoesNotNeedEachProgramOnItsWay) {
  Problem problem = load_problem("uvms/valve_trajectory");
  problem.motion->thruster_lag = 1;
  const TrajectoryProof proof = certify_trajectory(problem, default_knots(problem));
  EXPECT_EQ(proof.status, Status::kProven) << proof.reason.str();
  EXPECT_NEAR(proof.guaranteed, 34.3, 34.3 * 5e-4);
}

/// What `reproduce` ships as proven is proven, nearly as much as between its knots.
TEST(TrajectoryProof, ProvesTheTrajectoriesThatAreShippedAsProven) {
  for (const std::string name : {"valve_trajectory", "valve_impulse", "lift_impulse"}) {
    for (const bool lags : {false, true}) {
      Problem problem = load_problem("uvms/" + name);
      problem.motion->thruster_lag = lags ? 0.1 : 0;
      const TrajectoryProof proof = certify_trajectory(
          problem,
          shipped_knots("uvms_" + name + (lags ? "_spline_lag" : "_spline_proven"), problem));
      EXPECT_EQ(proof.status, Status::kProven) << name << proof.reason.str();
      EXPECT_GE(proof.guaranteed, proof.answer.trajectory.value_between_knots * (1 - 5e-4)) << name;
    }
  }
}

/// Without effort rates the wrench beside the peak of an impulse could be any, and efforts between
/// the edges would leave their limits by O(H). Limits of joints are a little wider, as the shipped
/// impulse keeps them at its instants only.
TEST(TrajectoryProof, LosesLittleOfAnImpulseWithoutEffortRates) {
  for (const std::string name : {"uvms/valve_impulse", "uvms/lift_impulse"}) {
    for (const Start start : {Start::kStatic, Start::kRest, Start::kFree}) {
      Problem problem = load_problem(name);
      problem.motion->rates = false;
      problem.motion->start = start;
      for (Joint& joint : problem.robot.joints) joint.velocity_max *= 1.01;
      problem.theta_r_min.array() -= 0.01;
      problem.theta_r_max.array() += 0.01;
      Eigen::MatrixXd knots = problem.motion->theta_0.transpose().replicate(problem.motion->k, 1);
      if (name == "uvms/valve_impulse") {
        knots = shipped_knots("uvms_valve_impulse_spline", problem);
      } else {
        // A clamped spline without acceleration at the start: slopes 0, 0.06, 0.21, 0, 0.
        knots.col(2) += Eigen::Vector4d(0.02, 0.15, 0.32, 0.22);
      }
      const TrajectoryProof proof = certify_trajectory(problem, knots);
      ASSERT_EQ(proof.status, Status::kProven) << name << ' ' << proof.reason.str();
      const double between = proof.answer.trajectory.value_between_knots;
      EXPECT_LE(proof.guaranteed, between) << name;
      EXPECT_GE(proof.guaranteed, between * (1 - 1.5e-4)) << name << to_string(start);
      // The check, which shares no code with the search for efforts, rejects a little more.
      TrajectoryCertificate claim = certified(problem, knots, proof.parts);
      EXPECT_TRUE(verify(problem, claim, 1).verified()) << name;
      claim.value *= 1 + 1e-3;
      claim.w[Eigen::Index{claim.t_h} * claim.parts] = claim.value;
      EXPECT_FALSE(verify(problem, claim, 1).verified()) << name;
    }
  }
}

/// Where effort rates bind, the wrench may vary: no less is proven of the least than at 25 instants
/// an interval. Of a wrench that does not vary, 24.1 N m would be.
TEST(TrajectoryProof, LetsTheWrenchVaryAlongAPath) {
  const Problem problem = load_problem("uvms/valve_trajectory_fast");
  const TrajectoryProof proof = certify_trajectory(problem, fast_turn_knots());
  EXPECT_EQ(proof.status, Status::kProven) << proof.reason.str();
  const double between = proof.answer.trajectory.value_between_knots;
  EXPECT_GT(between, 29.6);
  EXPECT_LE(proof.guaranteed, between);
  EXPECT_GE(proof.guaranteed, between * (1 - 5e-4));
}

TEST(TrajectoryProof, RejectsOtherTasksAndChoices) {
  const Problem problem = load_problem("planar/trajectory");
  const Eigen::MatrixXd knots = constant_knots(problem, problem.theta_r_default);
  Options any, ellipsoid;
  any.wrench = Wrench::kAny;
  ellipsoid.measure = "ellipsoid";
  EXPECT_THROW(certify_trajectory(problem, knots, any), std::invalid_argument);
  EXPECT_THROW(certify_trajectory(problem, knots, ellipsoid), std::invalid_argument);
  EXPECT_THROW(certify_trajectory(problem, knots.topRows(3)), std::invalid_argument);
  const Problem fixed = load_problem("planar/force");
  EXPECT_THROW(certify_trajectory(fixed, fixed.theta_r_default), std::invalid_argument);
  for (const double lag : {-0.1, std::nan(""), kInfinity}) {
    Problem lagged = problem;
    lagged.motion->thruster_lag = lag;
    EXPECT_THROW(certify_trajectory(lagged, knots), std::invalid_argument) << lag;
  }
}

/// The path turns about x, and the planar vehicle cannot.
TEST(TrajectoryProof, SaysThatTheBaseCannotFollow) {
  Problem problem = load_problem("planar/trajectory");
  problem.motion->path = Path::screw(problem.pose, Eigen::Vector3d::UnitX(), problem.pose.p, 0.1,
                                     Eigen::Vector3d::Zero(), Timing::kCubic, problem.motion->T);
  const TrajectoryProof proof =
      certify_trajectory(problem, constant_knots(problem, problem.theta_r_default));
  EXPECT_EQ(proof.status, Status::kInvalidPosture) << proof.reason.str();
  EXPECT_EQ(proof.reason.str(), proof.answer.reason.str());
}

/// Thrusters that are too slow cannot carry the turn around: no efforts balance it.
TEST(TrajectoryProof, SaysWhereNothingBalances) {
  Problem problem = load_problem("uvms/valve_trajectory");
  problem.robot.u_rate_max.head(8).setConstant(0.5);
  const TrajectoryProof proof =
      certify_trajectory(problem, shipped_knots("uvms_valve_trajectory_spline", problem));
  EXPECT_EQ(proof.status, Status::kInfeasible) << proof.reason.str();
  EXPECT_GE(proof.t, 0);
  EXPECT_LE(proof.t, 5);
}

}  // namespace
}  // namespace maxwrench
