#include "tests/support/trajectory_proofs.h"

#include <gtest/gtest.h>

#include <fstream>

#include "maxwrench/load.h"
#include "maxwrench/trajectory_proof.h"

namespace maxwrench {

Eigen::MatrixXd shipped_knots(const std::string& name, const Problem& problem) {
  return load_knots(std::string(MAXWRENCH_SOURCE_DIR) + "/results/trajectories/" + name + ".csv",
                    problem);
}

TrajectoryCertificate certified(const Problem& problem, const Eigen::MatrixXd& knots, int parts) {
  TrajectoryProofOptions how;
  how.keep_certificate = true;
  how.parts = parts;
  const TrajectoryProof proof = certify_trajectory(problem, knots, {}, how);
  EXPECT_EQ(proof.status, Status::kProven) << proof.reason.str();
  const TemporaryFolder folder;
  const std::string file = folder.path() / "proof";
  std::ofstream(file, std::ios::binary) << proof.certificate;
  return read_trajectory_certificates(file).front();
}

Eigen::MatrixXd fast_turn_knots() {
  return Eigen::MatrixXd{{2.7661, 0.7006, 0.5315, -0.2545}, {2.7568, 0.6953, 0.4985, -0.2582},
                         {2.7484, 0.7032, 0.4489, -0.2626}, {2.7732, 0.7346, 0.4397, -0.2499},
                         {2.8393, 0.7593, 0.4701, -0.1962}, {2.9143, 0.7829, 0.5251, -0.1037},
                         {2.9893, 0.8465, 0.5973, 0.0183},  {3.0596, 0.9103, 0.6379, 0.1429},
                         {3.1065, 0.9244, 0.6215, 0.2275},  {3.1249, 0.9207, 0.6033, 0.2564}};
}

Eigen::MatrixXd moving_knots(const Problem& problem, Random& random) {
  const Eigen::VectorXd start =
      problem.motion->impulse ? problem.motion->theta_0 : problem.theta_r_default;
  Eigen::MatrixXd knots = constant_knots(problem, start);
  for (double& x : knots.reshaped()) x += random.uniform(-0.3, 0.3);
  return knots;
}

std::vector<Instant> instants_by_lib(const Problem& problem, const Eigen::MatrixXd& knots,
                                     int parts) {
  MotionEvaluator motion(problem, make_dense_spline(*problem.motion, parts));
  std::vector<Instant> instants;
  motion.evaluate(all_knots(*problem.motion, knots), instants);
  return instants;
}

void expect_holds(const Narrow& interval, double x, double rounding, const char* what) {
  EXPECT_LE(interval.low - rounding, x) << what;
  EXPECT_GE(interval.high + rounding, x) << what;
}

}  // namespace maxwrench
