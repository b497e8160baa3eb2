#include <gtest/gtest.h>

#include <cmath>

#include "lib/robot/kinematics.h"
#include "maxwrench/certify.h"
#include "maxwrench/load.h"
#include "problems/collision/collision.h"
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

/// At any x of the coordinates that are left, the loads of the chain's joints are those of the
/// bound's model, which is other code.
TEST(VerifyYawJoint, LoadsAreThoseOfTheBoundAnywhere) {
  const Problem problem = on_parked_base();
  const LoopCoordinates coordinates(problem, ContactForces::kShares, 0);
  LoopPosture exact(problem, coordinates);
  const FormModel model(problem, CoordinateChoice{joint_about_yaw(problem)});
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

ProofCertificate proof_of(const Problem& problem) {
  Options options;
  options.budget = 2000;
  options.threads = 1;
  ProofRecorder recorder;
  ProofOptions how;
  how.gap = 1e-2;
  const Proof proof = certify(problem, options, how, &recorder);
  EXPECT_EQ(proof.status, Status::kProven) << proof.reason.c_str();
  return recorder.certificate(proof.answer, proof.bound, how.gap);
}

/// The origin of the last link at the posture of a certificate, in base axes.
Eigen::Vector3d hand_of(const Problem& problem, const ProofCertificate& proof) {
  const PostureCoordinates coordinates(problem);
  Eigen::VectorXd q(static_cast<Eigen::Index>(problem.robot.joints.size()));
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const auto variable =
        static_cast<std::size_t>(coordinates.of_joint[static_cast<std::size_t>(i)]);
    q[i] = proof.x[coordinates.variables[variable].coordinate];
  }
  Kinematics<double> kinematics(problem.robot);
  kinematics.set_joints(q);
  return kinematics.links().back().p;
}

/// With a ball on the base and a small one at the last link, which collide with each other.
Problem with_balls(Problem problem, const Eigen::Vector3d& at, double radius) {
  Shape ball;
  ball.placement.p = at;
  ball.radius = radius;
  Shape hand;
  hand.link = static_cast<int>(problem.robot.links.size()) - 1;
  hand.radius = 0.01;
  problem.robot.collision = make_collision_checker({ball, hand}, {}, 0);
  return problem;
}

class YawJointProof : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    problem_ = new Problem(on_parked_base());
    certificate_ = new ProofCertificate(proof_of(*problem_));
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
  proof.without_yaw_joint = false;  // its boxes are too wide for bounds with the joint
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
  const Problem other = load_problem("fixed/push");
  EXPECT_EQ(verify(other, proof, 1).rejection, "it is for another robot or task");
  proof.digest = digest(other);
  EXPECT_EQ(verify(other, proof, 1).rejection, expected);
  proof = *certificate_;
  proof.measure = "ellipsoid";
  EXPECT_EQ(rejection(proof), expected);
}

TEST_F(YawJointProof, IsRejectedWithoutAPartOfTheJoint) {
  ProofCertificate proof = *certificate_;
  proof.upper[0] -= 0.1;  // what collides there may not collide elsewhere
  EXPECT_EQ(rejection(proof), "its box does not contain the limits");
}

TEST_F(YawJointProof, IsRejectedWithoutAPartOfTheYaw) {
  ProofCertificate proof = *certificate_;
  const FormModel model(*problem_);
  const auto at = static_cast<std::size_t>(model.coordinates().yaw);
  const int yaw = model.coordinates().variables[at].coordinate;
  proof.upper[yaw] = proof.lower[yaw] + 6;
  EXPECT_EQ(rejection(proof), "its box does not contain the limits");
}

/// A ball about the joint's axis is in the hand's way wherever the base stands. Its collisions are
/// proven for parts of the joint's range.
TEST_F(YawJointProof, KnowsWhatCollidesWhereverTheBaseStands) {
  const Eigen::Vector3d hand = hand_of(*problem_, *certificate_);
  const Eigen::Vector3d axis = problem_->robot.joints[0].placement.p;
  const Eigen::Vector3d centre(axis[0], axis[1], hand[2]);
  const Problem hidden = with_balls(*problem_, centre, (hand - centre).norm() + 0.05);
  const ProofCertificate proof = proof_of(hidden);
  EXPECT_LT(proof.bound, certificate_->value);
  const Verification result = verify(hidden, proof, 1);
  EXPECT_EQ(result.rejection, "");
  EXPECT_GT(result.by_collision, 0);
}

/// A ball that is in the hand's way from one side costs nothing: the base stands elsewhere.
TEST_F(YawJointProof, KnowsThatTheBaseMayStandElsewhere) {
  const Eigen::Vector3d hand = hand_of(*problem_, *certificate_);
  const Problem hidden = with_balls(*problem_, hand, 0.05);
  const ProofCertificate proof = proof_of(hidden);
  EXPECT_NEAR(proof.value, certificate_->value, 0.01 * certificate_->value);
  EXPECT_EQ(verify(hidden, proof, 1).rejection, "");
}

}  // namespace
}  // namespace maxwrench
