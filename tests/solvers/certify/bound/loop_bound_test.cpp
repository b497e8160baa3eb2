#include <gtest/gtest.h>

#include <cmath>

#include "maxwrench/bound.h"
#include "maxwrench/load.h"
#include "tests/support/loops.h"

namespace maxwrench {
namespace {

class LoopBoundOf : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Problems, LoopBoundOf, testing::ValuesIn(kLoopProblems), loop_name);

/// Pairs of a box and a posture in it.
constexpr int kLoopPairs = 200;

struct LoopBoxOf {
  Eigen::VectorXd lower, upper;
};

/// A box of any size about x, now and then with x in its faces.
LoopBoxOf box_about(const Eigen::VectorXd& x, const LoopCoordinates& coordinates, Random& random) {
  LoopBoxOf box{x, x};
  const double size = std::pow(10, -random.uniform(0, 4));
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double own = random.uniform(0, 1) < 0.2 ? size : size * random.uniform(0, 1);
    const double where = random.uniform(0, 1);
    if (where > 0.1) box.lower[i] -= own * random.uniform(0, 1);
    if (where < 0.9) box.upper[i] += own * random.uniform(0, 1);
    box.lower[i] = std::max(box.lower[i], std::min(x[i], coordinates.lower[i] - 1e-12));
    box.upper[i] = std::min(box.upper[i], std::max(x[i], coordinates.upper[i] + 1e-12));
  }
  return box;
}

bool holds(const LoopBoxOf& box, const Eigen::VectorXd& x) {
  constexpr double kRounding = 1e-11;  // of what other code has solved
  return (x.array() >= box.lower.array() - kRounding).all() &&
         (x.array() <= box.upper.array() + kRounding).all();
}

/// At least this share of the boxes must have a finite bound.
void test_pairs(const Problem& problem, const std::string& measure, Wrench wrench = Wrench::kPure,
                double share = 0.5) {
  const auto bound = make_capability_bound(problem, measure, wrench);
  PostureSource source(problem, measure, forces_in_bound(problem, measure), wrench);
  Random random(4);
  BoxProof proof;
  int bounded = 0, finite = 0;
  for (int pair = 0; pair < samples(kLoopPairs); ++pair) {
    const ValuedPosture* at = source.draw(random);
    for (int more = 0; kSanitized && at == nullptr && more < 60; ++more) at = source.draw(random);
    if (at == nullptr) continue;
    LoopBoxOf box = box_about(at->x, source.coordinates(), random);
    for (Eigen::Index i = 0; i < at->x.size(); ++i) {  // room for the rounding of the posture
      box.lower[i] -= 1e-9;
      box.upper[i] += 1e-9;
    }
    ASSERT_TRUE(bound->shrink(box.lower, box.upper, nullptr)) << at->x.transpose();
    ASSERT_TRUE(holds(box, at->x)) << at->x.transpose();
    if (pair % 3 == 0) proof = {};
    const double low =
        pair % 5 == 0 ? -kInfinity : at->value - random.uniform(0, 1) * std::abs(at->value) - 1e-9;
    const double high = pair % 7 == 0 ? kInfinity : 10 + std::abs(at->value) * random.uniform(1, 3);
    bound->evaluate(box.lower, box.upper, low, high, proof);
    EXPECT_NE(proof.kind, BoxProof::Kind::kCollision);
    EXPECT_LE(proof.high, high);
    EXPECT_GE(std::max(low, proof.high), at->value - 1e-7 * (1 + std::abs(at->value)))
        << at->x.transpose();
    BoxProof unlimited;
    bound->evaluate(box.lower, box.upper, low, kInfinity, unlimited);
    EXPECT_NE(unlimited.kind, BoxProof::Kind::kNoPosture) << at->x.transpose();
    EXPECT_GE(std::max(low, unlimited.high), at->value - 1e-7 * (1 + std::abs(at->value)))
        << at->x.transpose();
    ++bounded;
    finite += std::isfinite(proof.high) ? 1 : 0;
  }
  EXPECT_GT(bounded, samples(kLoopPairs) / 20);
  EXPECT_GT(finite, share * bounded);
}

TEST_P(LoopBoundOf, NoPostureIsAboveOrCutOff) {
  test_pairs(loop_problem(GetParam()), "linf_polytope");
}

TEST(LoopBound, SLOW_SupportsOtherMeasures) {
  for (const char* measure : {"l2_polytope", "ellipsoid"}) {
    for (const char* name : {"mobile/push", "fixed/push", "mobile/push_any_height"}) {
      test_pairs(load_problem(name), measure);
    }
  }
}

/// Seven joints and twelve equations: five combinations of these have terms of second and higher
/// order only.
TEST(LoopBound, HoldsForAPublicArm) {
  test_pairs(load_problem("gallery/panda/push"), "linf_polytope");
}

class FreeLoopBoundOf : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Problems, FreeLoopBoundOf,
                         testing::Values("mobile/push", "fixed/push", "mobile/push_any_height",
                                         "gallery/panda/push", "random, fixed", "random, x",
                                         "random, yaw", "random, x y yaw", "random, x y z yaw",
                                         "random, free tool", "random, parked"),
                         loop_name);

/// Nothing limits the other components of the wrench in large boxes, which have no bound.
TEST_P(FreeLoopBoundOf, NoPostureIsAboveOrCutOff) {
  test_pairs(loop_problem(GetParam()), "linf_polytope", Wrench::kAny, 0.1);
}

/// The bound falls to the value of a posture, at a rate that the value's slope explains.
TEST_P(FreeLoopBoundOf, TendsToTheValue) {
  const Problem problem = loop_problem(GetParam());
  const auto bound = make_capability_bound(problem, "linf_polytope", Wrench::kAny);
  PostureSource source(problem, "linf_polytope", ContactForces::kShares, Wrench::kAny);
  Random random(6);
  int seen = 0, close = 0;
  for (int sample = 0; sample < samples(200); ++sample) {
    const ValuedPosture* at = source.draw(random);
    if (at == nullptr) continue;
    const double size = 1 + std::abs(at->value);
    const Eigen::VectorXd lower = at->x.array() - 1e-8, upper = at->x.array() + 1e-8;
    BoxProof proof;
    double high = kInfinity;
    for (int times = 0; times < 3; ++times) {  // each with the last bound as a known one
      bound->evaluate(lower, upper, at->value - 1e-3 * size, high, proof);
      EXPECT_LE(proof.high, high);
      high = proof.high;
    }
    EXPECT_GE(high, at->value - 1e-7 * size);
    ++seen;
    close += high <= at->value + 2e-4 * size ? 1 : 0;
  }
  EXPECT_GT(seen, 0);
  EXPECT_GE(close, 0.95 * seen);  // a few are almost singular
}

/// A vehicle that braces itself: the second arm's contact is in line with c, so it bears what the
/// thrusters do not, and strong joints push with far more than those.
Problem braced() {
  Problem problem = load_problem("dual_arm/bar_wall");
  Contact& contact = *problem.contact;
  const Eigen::Vector3d touched = contact_pose(contact, problem.theta_r_default.data()).p;
  problem.c << (touched - problem.pose.p).normalized(), 0, 0, 0;
  problem.W_any = problem.c;
  contact.C = Matrix6Xd::Identity(6, 3);
  contact.w_min = Eigen::VectorXd::Constant(3, -kInfinity);
  contact.w_max = Eigen::VectorXd::Constant(3, kInfinity);
  for (Joint& joint : problem.robot.joints) joint.effort_max *= 1000;
  complete_actuation(problem.robot);
  return problem;
}

/// A large box can have a multiplier that bounds its values by rounding alone. The parts of the box
/// have bounds of use all the same.
TEST(LoopBound, SurvivesALimitThatIsTooLargeToBeOfUse) {
  for (const char* name : {"gallery/gen3/push", "gallery/gen3/lift", "gallery/ur10/lift"}) {
    const Problem problem = load_problem(name);
    const auto bound = make_capability_bound(problem, "linf_polytope", Wrench::kPure);
    PostureSource source(problem, "linf_polytope");
    Random random(3);
    int seen = 0;
    for (int sample = 0; sample < samples(100); ++sample) {
      const ValuedPosture* const at = source.draw(random);
      if (at == nullptr) continue;
      const double low = at->value, useful = 1e4 * (1 + std::abs(low));
      const auto box = [&](double size, double high, BoxProof& proof) {
        bound->evaluate(at->x.array() - size, at->x.array() + size, low, high, proof);
      };
      BoxProof without, with, parts;
      box(0.3, kInfinity, without);
      box(0.3, 1e19, with);
      for (const double size : {1.2, 0.6, 0.3}) box(size, 1e19, parts);
      if (!(without.high < useful)) continue;
      EXPECT_LT(with.high, useful) << name;
      EXPECT_LT(parts.high, useful) << name;
      ++seen;
    }
    EXPECT_GT(seen, 0) << name;
  }
}

TEST(LoopBound, IsNoCeilingOfWhatBracesItself) {
  const Problem problem = braced();
  test_pairs(problem, "linf_polytope");
  const auto bound = make_capability_bound(problem, "linf_polytope", Wrench::kPure);
  PostureSource source(problem, "linf_polytope");
  Random random(1);
  double thrust = 0, most = -kInfinity;
  for (const Thruster& each : problem.robot.thrusters) {
    thrust += std::max(-each.force_min, each.force_max);
  }
  for (int sample = 0; sample < samples(1000); ++sample) {
    const ValuedPosture* const at = source.draw(random);
    if (at != nullptr) most = std::max(most, at->value);
  }
  EXPECT_GT(most, 2 * thrust);
  EXPECT_GE(bound->ceiling(), most);
}

}  // namespace
}  // namespace maxwrench
