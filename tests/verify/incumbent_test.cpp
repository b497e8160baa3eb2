#include "verify/incumbent.h"

#include <gtest/gtest.h>

#include "maxwrench/load.h"
#include "tests/support/support.h"
#include "tests/support/written_proof.h"

namespace maxwrench {
namespace {

/// A thousand times heavier, the arm alone takes more than the ellipsoid holds, whatever a contact
/// force would do for it.
TEST(Incumbent, RejectsPosturesWithoutAValue) {
  WrittenProof at("uvms/lift", "ellipsoid", Wrench::kPure, 1, 10);
  at.problem.robot.gravity *= 1000;
  at.proof.digest = digest(at.problem);
  EXPECT_NE(at.rejection(at.proof).find("has no value"), std::string::npos);
}

/// Joints that do not reach the pose, by more than rounding.
TEST(Incumbent, RejectsPosturesThatDoNotGetThere) {
  const WrittenProof at("mobile/push", "linf_polytope", Wrench::kPure, 1e-1);
  for (Eigen::Index i = at.problem.redundancy(); i < at.proof.x.size(); ++i) {
    ProofCertificate moved = at.proof;
    moved.x[i] += 1e-6;
    EXPECT_NE(at.rejection(moved).find("do not reach the pose"), std::string::npos) << i;
  }
}

/// Gains below the contact's threshold are of no valid posture.
TEST(Incumbent, RejectsSingularPostures) {
  WrittenProof at("dual_arm/bar_alone", "linf_polytope", Wrench::kPure, 1e-1);
  ASSERT_EQ(at.rejection(at.proof), "");
  at.problem.contact->sigma_min = 10;
  EXPECT_NE(at.rejection(at.proof).find("another robot or task"), std::string::npos);
  at.proof.digest = digest(at.problem);
  EXPECT_NE(at.rejection(at.proof).find("singular"), std::string::npos);
}

/// A vehicle that stays in its plane does not get to a pose above it, or to one that is tilted by a
/// second of arc, whatever its arm does.
TEST(Incumbent, RejectsABaseOffItsFreeAxes) {
  WrittenProof at("planar/force", "linf_polytope", Wrench::kPure, 1e-1);
  const auto expect_rejected = [&at](const Pose<double>& pose) {
    at.problem.pose = pose;
    at.proof.digest = digest(at.problem);
    EXPECT_NE(at.rejection(at.proof).find("off its free axes"), std::string::npos);
  };
  const Pose<double> level = at.problem.pose;
  Pose<double> above = level, tilted = level;
  above.p.z() += 0.5;
  tilted.R = Eigen::AngleAxisd(5e-6, Eigen::Vector3d::UnitX()) * level.R;
  expect_rejected(above);
  expect_rejected(tilted);
}

}  // namespace
}  // namespace maxwrench
