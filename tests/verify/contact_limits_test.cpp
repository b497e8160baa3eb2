#include "verify/contact_limits.h"

#include <gtest/gtest.h>

#include "maxwrench/load.h"
#include "tests/support/contacts.h"
#include "tests/support/loops.h"
#include "tests/support/written_proof.h"
#include "verify/box_forms.h"
#include "verify/incumbent.h"
#include "verify/model.h"

namespace maxwrench {
namespace {

/// The four edges of a pyramid, none of which pulls.
Problem with_friction() {
  Problem problem = load_problem("dual_arm/bar_wall");
  problem.contact->C.setZero(6, 4);
  problem.contact->C.topRows<3>() << 0.4, -0.4, 0, 0, 0, 0, 0.4, -0.4, 1, 1, 1, 1;
  problem.contact->w_min = Eigen::VectorXd::Zero(4);
  problem.contact->w_max = Eigen::VectorXd::Constant(4, kInfinity);
  return problem;
}

Problem problem_of(const std::string& name) {
  return name == "friction" ? with_friction() : load_problem(name);
}

class ContactLimitsOf : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Shipped, ContactLimitsOf, testing::ValuesIn(kContactProblems));
INSTANTIATE_TEST_SUITE_P(Cone, ContactLimitsOf, testing::Values("friction"));

/// Multipliers are for the limits of the bound, so that they prove the same.
TEST_P(ContactLimitsOf, AreThoseOfTheBound) {
  Problem problem = problem_of(GetParam());
  problem.c << 0.48, 0, 0.36, 0, 0, 0.8;
  const LoopCoordinates expected(problem);
  const ContactLimits limits(problem);
  EXPECT_TRUE(limits.grow());
  const auto expect_near = [](const Eigen::VectorXd& own, const Eigen::VectorXd& other) {
    ASSERT_EQ(own.size(), other.size());
    EXPECT_LE((own - other).cwiseAbs().maxCoeff(), 1e-13 * other.cwiseAbs().maxCoeff());
  };
  expect_near(limits.w_min, expected.w_min);
  expect_near(limits.w_max, expected.w_max);
  expect_near(limits.v_min, expected.v_min);
  expect_near(limits.v_max, expected.v_max);
}

/// The linear programs know nothing of these limits.
TEST_P(ContactLimitsOf, HoldForTheBestWrenches) {
  const Problem problem = problem_of(GetParam());
  const ContactLimits limits(problem);
  PostureSource source(problem, "linf_polytope");
  Random random(5);
  int seen = 0;
  for (int sample = 0; sample < samples(2000); ++sample) {
    const ValuedPosture* const at = source.draw(random);
    if (at == nullptr || at->value < 0) continue;
    ++seen;
    const Eigen::ArrayXd w = source.capability().w.tail(limits.w_min.size());
    EXPECT_TRUE((w >= limits.w_min.array() + at->value * limits.v_min.array() - 1e-9).all());
    EXPECT_TRUE((w <= limits.w_max.array() + at->value * limits.v_max.array() + 1e-9).all());
  }
  EXPECT_GT(seen, 3);
}

/// At any x, the load is that of other code: C_2 turns with the surface, and the base with the arm.
TEST(ContactLoad, IsThatOfTheBoundAnywhere) {
  Random random(6);
  std::vector<Problem> problems = {load_problem("dual_arm/bar_wall"),
                                   load_problem("planar/two_arms")};
  problems.push_back(with_pipe(load_problem("dual_arm/bar_wall")));
  problems.push_back(problems[0]);  // a push with a twist
  problems.back().contact->C(5, 0) = 0.3;
  for (const Problem& problem : problems) {
    const LoopCoordinates coordinates(problem);
    LoopPosture exact(problem, coordinates);
    const FormModel model(problem, CoordinateChoice{.contact_shares = true});
    const ContactLimits limits(problem);
    const std::vector<Form> load = model.contact_load(limits.w_min, limits.w_max);
    ASSERT_EQ(model.coordinates().count(), coordinates.chain.count());
    for (int sample = 0; sample < 10; ++sample) {
      Eigen::VectorXd x = coordinates.lower;
      for (Eigen::Index i = 0; i < x.size(); ++i) {
        x[i] = random.uniform(coordinates.lower[i], coordinates.upper[i]);
      }
      exact.set(x.cast<Extended>());
      const Eigen::VectorXd expected = exact.forces().cast<double>();
      for (std::size_t i = 0; i < load.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        const Narrow own = BoxForms::at_point(model.shape(), FormRow(load[i], model.far()), x);
        EXPECT_NEAR(own.low, expected[row], 1e-11 * (1 + std::abs(expected[row]))) << i;
      }
    }
  }
}

/// Two components along one line can be as large as they like, unless both push.
TEST(ContactLimits, NeedAForceOfEachComponent) {
  Problem problem = load_problem("planar/two_arms");
  problem.contact->C.col(1) = problem.contact->C.col(0) * (1 + 1e-9);
  EXPECT_TRUE(ContactLimits(problem).w_max.allFinite());
  problem.contact->w_min[0] = -1;
  EXPECT_THROW(ContactLimits{problem}, std::invalid_argument);
  problem.contact->w_min.setConstant(-2);
  problem.contact->w_max.setConstant(7);
  const ContactLimits limits(problem);
  EXPECT_FALSE(limits.grow());
  EXPECT_EQ(limits.w_max, problem.contact->w_max);
}

/// A base that does not move up bears nothing along it.
TEST(ContactLimits, NeedABaseThatMovesAlongTheForce) {
  Problem problem = load_problem("planar/two_arms");
  problem.contact->frame.R = Eigen::Matrix3d::Identity();  // its z is the world's
  EXPECT_THROW(ContactLimits{problem}, std::invalid_argument);
}

/// Along the wall's normal a push of w weighs w, along an edge of slope 0.4 more. So the limit of
/// the push is that of each edge.
TEST(ContactLimits, OfAConeAreThoseAlongItsMiddle) {
  const ContactLimits push(load_problem("dual_arm/bar_wall")), cone(with_friction());
  for (const double most : cone.w_max) EXPECT_NEAR(most, push.w_max[0], 1e-9 * most);
}

TEST(ContactLimits, OfAConeHaveCertificates) {
  const WrittenProof at(with_friction(), "dual_arm/bar_wall", "linf_polytope", Wrench::kPure, 1e-1);
  EXPECT_EQ(at.rejection(at.proof), "");
  const WrittenProof push("dual_arm/bar_wall", "linf_polytope", Wrench::kPure, 1e-3);
  EXPECT_GT(at.proof.value, push.proof.bound);  // a push that may slide less does more
}

/// A push of at least -5 N, and one of less than that.
TEST(Incumbent, RejectsForcesBeyondTheContactsLimits) {
  Problem problem = load_problem("dual_arm/bar_wall");
  problem.contact->w_min[0] = -5;
  const WrittenProof at(problem, "dual_arm/bar_wall", "linf_polytope", Wrench::kPure, 1e-2);
  ASSERT_EQ(at.rejection(at.proof), "");
  const ContactLimits limits(at.problem);
  ProofCertificate other = at.proof;
  other.x[other.x.size() - 1] = (-5.1 - limits.w_min[0]) / (limits.w_max[0] - limits.w_min[0]);
  EXPECT_NE(at.rejection(other).find("second contact is beyond its limits"), std::string::npos);
  other.x[other.x.size() - 1] = 0.75;
  EXPECT_NE(at.rejection(other).find("do not balance"), std::string::npos);
  other.x.conservativeResize(other.x.size() - 1);  // no base determines the force
  EXPECT_NE(at.rejection(other), "");
}

}  // namespace
}  // namespace maxwrench
