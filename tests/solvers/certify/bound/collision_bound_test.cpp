#include <gtest/gtest.h>

#include "maxwrench/bound.h"
#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "tests/support/boxes.h"

namespace maxwrench {
namespace {

/// Whether a half of a box collides throughout.
bool half_collides(Bound& bound, const RandomBox& box, int axis) {
  for (const bool second : {false, true}) {
    RandomBox half = box;
    (second ? half.lower : half.upper)[axis] = (box.lower[axis] + box.upper[axis]) / 2;
    BoxProof proof;
    bound.evaluate(half.lower, half.upper, 0, bound.ceiling(), proof);
    if (proof.kind == BoxProof::Kind::kCollision) return true;
  }
  return false;
}

/// All of a box that is turned down collides, and there are such boxes; of others, half of it where
/// it says so.
TEST(CollisionBound, TurnsDownNothingValid) {
  const Problem problem = load_problem("uvms/valve");
  const auto bound = make_capability_bound(problem, "ellipsoid", Wrench::kPure);
  PostureEvaluator model(problem);
  Random random(6);
  int turned_down = 0, cuts = 0;
  for (int sample = 0; sample < samples(3000); ++sample) {
    RandomBox box = random_box(problem, random);
    BoxProof proof;
    bound->evaluate(box.lower, box.upper, 0, bound->ceiling(), proof);
    if (proof.kind != BoxProof::Kind::kCollision) {
      EXPECT_TRUE(proof.axis < 0 || half_collides(*bound, box, proof.axis));
      cuts += proof.axis >= 0 ? 1 : 0;
      continue;
    }
    ++turned_down;
    EXPECT_EQ(proof.high, -kInfinity);
    EXPECT_FALSE(problem.robot.collision->pair_name(proof.pair).empty());
    for (int point = 0; point < 20; ++point) {
      Eigen::VectorXd q = box.lower;
      for (Eigen::Index i = 0; i < q.size(); ++i) q[i] = random.uniform(box.lower[i], box.upper[i]);
      EXPECT_EQ(model.evaluate(q).violation, Violation::kCollision);
    }
  }
  EXPECT_GT(turned_down, samples(300));
  EXPECT_GT(cuts, samples(20));
}

}  // namespace
}  // namespace maxwrench
