#include "lib/path/clearance.h"

#include <gtest/gtest.h>

#include "maxwrench/load.h"
#include "maxwrench/problem.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

TEST(Clearance, GradientIsThatOfCentralDifferences) {
  const Problem problem = load_problem("uvms/valve");
  Kinematics<double> kinematics(problem.robot);
  const auto near = [&](const Eigen::VectorXd& q) {
    std::vector<NearPair> pairs;
    kinematics.set_joints(q);
    find_near_pairs(problem, kinematics, 0, kInfinity, pairs);
    return pairs;
  };
  Random random(2);
  const double h = 1e-6;
  int compared = 0;
  for (int sample = 0; sample < 20; ++sample) {
    const Eigen::VectorXd q = random_theta_r(problem, random);
    const auto pairs = near(q);
    for (Eigen::Index j = 0; j < q.size(); ++j) {
      const auto after = near(q + h * Eigen::VectorXd::Unit(4, j));
      const auto before = near(q - h * Eigen::VectorXd::Unit(4, j));
      if (after.size() != pairs.size() || before.size() != pairs.size()) continue;
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        const double right = (after[i].clearance - pairs[i].clearance) / h;
        const double left = (pairs[i].clearance - before[i].clearance) / h;
        if (std::abs(right - left) > 1e-3) continue;  // another feature becomes the nearest
        ++compared;
        EXPECT_NEAR(pairs[i].gradient[j], (right + left) / 2, 1e-5);
      }
    }
  }
  EXPECT_GT(compared, 500);
}

TEST(Clearance, IsNegativeWhereBodiesCollide) {
  const Problem problem = load_problem("uvms/valve");
  Kinematics<double> kinematics(problem.robot);
  Random random(4);
  int colliding = 0;
  for (int sample = 0; sample < 500; ++sample) {
    kinematics.set_joints(random_theta_r(problem, random));
    std::vector<NearPair> pairs;
    find_near_pairs(problem, kinematics, 0, 0, pairs);
    const bool collides = problem.robot.collision->collides(kinematics.links());
    // Bodies that share a point have no nearest ones; all others of this robot have.
    EXPECT_TRUE(collides || pairs.empty());
    colliding += collides;
  }
  EXPECT_GT(colliding, 20);
}

}  // namespace
}  // namespace maxwrench
