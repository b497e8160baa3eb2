#include <gtest/gtest.h>

#include <cmath>

#include "maxwrench/certify.h"
#include "maxwrench/load.h"
#include "solvers/certify/bound/loop_posture.h"
#include "solvers/certify/proof.h"
#include "solvers/certify/proof_recorder.h"
#include "tests/support/loops.h"
#include "verify/equations.h"
#include "verify/model.h"
#include "verify/verify.h"

namespace maxwrench {
namespace {

Problem on_parked_base() {
  Random random(5);
  return parked_problem(random);
}

TEST(VerifyYawJoint, IsThatOfTheBound) {
  const Problem problem = on_parked_base();
  EXPECT_EQ(joint_about_yaw(problem), problem.redundant[0]);
  for (const char* name : {"fixed/push", "uvms/valve", "dual_arm/bar_wall"}) {
    EXPECT_EQ(joint_about_yaw(load_problem(name)), -1) << name;
  }
}

TEST(VerifyYawJoint, IsBetweenTheBaseAndItsLinks) {
  const Robot robot = on_parked_base().robot;
  EXPECT_TRUE(is_between(robot, 0, 0, 1));
  EXPECT_TRUE(is_between(robot, 0, 5, 0));
  EXPECT_FALSE(is_between(robot, 0, 1, 5));
  EXPECT_TRUE(is_between(robot, 3, 2, 4));
  EXPECT_FALSE(is_between(robot, 3, 2, 3));
}

/// At any x of the coordinates that are left, the loads of the chain's joints are those of the
/// bound's model, which is other code.
TEST(VerifyYawJoint, LoadsAreThoseOfTheBoundAnywhere) {
  const Problem problem = on_parked_base();
  const LoopCoordinates coordinates(problem, ContactForces::kShares, 0);
  LoopPosture exact(problem, coordinates);
  const FormModel model(problem, joint_about_yaw(problem));
  EXPECT_EQ(model.coordinates().count(), coordinates.chain.count());
  const std::vector<Form> tau_d = model.tau_d(), a = model.exerted(problem.c);
  const Eigen::Index n = problem.robot.velocities();
  Random random(1);
  for (int sample = 0; sample < 10; ++sample) {
    Eigen::VectorXd x = coordinates.lower;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      x[i] = random.uniform(coordinates.lower[i], coordinates.upper[i] + 1e-300);
    }
    exact.set(x.cast<Extended>());
    for (Eigen::Index row = 3; row < n; ++row) {
      const auto at = [&](const std::vector<Form>& forms) {
        return BoxForms::at_point(model.shape(),
                                  FormRow(forms[static_cast<std::size_t>(row)], model.far()), x)
            .low;
      };
      const auto expected = [&](Eigen::Index i) { return static_cast<double>(exact.loads()[i]); };
      EXPECT_NEAR(at(tau_d), expected(row), 1e-11 * (1 + std::abs(expected(row))));
      EXPECT_NEAR(at(a), expected(n + row), 1e-11 * (1 + std::abs(expected(n + row))));
    }
  }
}

class YawJointProof : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    problem_ = new Problem(on_parked_base());
    Options options;
    options.budget = 2000;
    options.threads = 1;
    ProofRecorder recorder;
    ProofOptions how;
    how.gap = 1e-2;
    const Proof proof = certify(*problem_, options, how, &recorder);
    ASSERT_EQ(proof.status, Status::kProven) << proof.reason.c_str();
    certificate_ = new ProofCertificate(recorder.certificate(proof.answer, proof.bound, how.gap));
  }
  static void TearDownTestSuite() {
    delete certificate_;
    delete problem_;
  }
  static std::string rejection(const ProofCertificate& proof) {
    return verify(*problem_, proof, 1).rejection;
  }

  static Problem* problem_;
  static ProofCertificate* certificate_;
};
Problem* YawJointProof::problem_ = nullptr;
ProofCertificate* YawJointProof::certificate_ = nullptr;

TEST_F(YawJointProof, IsVerified) {
  EXPECT_TRUE(certificate_->without_yaw_joint);
  EXPECT_EQ(rejection(*certificate_), "");
}

TEST_F(YawJointProof, NoPostureIsAbove) {
  PostureSource source(*problem_, "linf_polytope");
  Random random(2);
  int values = 0;
  for (int sample = 0; sample < samples(4000); ++sample) {
    const ValuedPosture* const at = source.draw(random);
    if (at == nullptr) continue;
    EXPECT_LE(at->value, certificate_->bound);
    ++values;
  }
  EXPECT_GT(values, samples(4000) / 20);
}

TEST_F(YawJointProof, IsRejectedWithTheJoint) {
  ProofCertificate proof = *certificate_;
  proof.without_yaw_joint = false;  // its boxes have one position of the joint
  EXPECT_NE(rejection(proof), "");
}

/// The rows of the base depend on its own yaw.
TEST_F(YawJointProof, IsRejectedWithMultipliersOfTheBase) {
  for (int row = 0; row < 3; ++row) {
    ProofCertificate proof = *certificate_;
    for (const CertificateTree::Node& node : proof.tree.nodes) {
      if (node.reason != CertificateTree::Reason::kMultiplier) continue;
      proof.tree.multipliers[node.multiplier + static_cast<std::size_t>(row)] = 1e-300;
    }
    EXPECT_NE(rejection(proof), "") << row;
  }
}

TEST_F(YawJointProof, IsRejectedOfOtherTasksAndMeasures) {
  const std::string expected = "it leaves out a joint that the base cannot replace";
  ProofCertificate proof = *certificate_;
  proof.measure = "ellipsoid";
  EXPECT_EQ(rejection(proof), expected);
  const Problem other = load_problem("fixed/push");
  proof = *certificate_;
  proof.digest = digest(other);
  EXPECT_EQ(verify(other, proof, 1).rejection, expected);
}

TEST_F(YawJointProof, IsRejectedWithoutAPartOfTheYaw) {
  ProofCertificate proof = *certificate_;
  const FormModel model(*problem_);
  const auto at = static_cast<std::size_t>(model.coordinates().yaw);
  const int yaw = model.coordinates().variables[at].coordinate;
  proof.upper[yaw] = proof.lower[yaw] + 6;
  EXPECT_EQ(rejection(proof), "its box does not contain the limits");
}

}  // namespace
}  // namespace maxwrench
