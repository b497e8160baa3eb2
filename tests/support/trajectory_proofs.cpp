#include "tests/support/trajectory_proofs.h"

#include <gtest/gtest.h>

#include <fstream>

#include "maxwrench/load.h"
#include "maxwrench/trajectory_proof.h"
#include "tests/support/support.h"

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

}  // namespace maxwrench
