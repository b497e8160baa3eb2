#include <gtest/gtest.h>

#include "lib/robot/chain.h"
#include "maxwrench/load.h"
#include "problems/collision/collision.h"
#include "solvers/certify/bound/bounds.h"
#include "tests/support/boxes.h"
#include "verify/collision_proof.h"

namespace maxwrench {
namespace {

using Kind = Shape::Kind;

/// Some are flat, and some a single point.
Shape random_hull(Random& random, int link) {
  Shape shape;
  shape.kind = Kind::kHull;
  shape.link = link;
  shape.placement = {random_rotation(random), random_vector(random, 0.2)};
  Eigen::Vector3d size = Eigen::Vector3d::Constant(random.uniform(0.05, 0.3));
  const double kind = random.uniform(0, 1);
  if (kind < 0.2) size[2] = 0;
  if (kind < 0.05) size.setZero();
  for (int i = 0; i < 12; ++i) {
    shape.points.emplace_back(random_vector(random).cwiseProduct(size));
  }
  shape.radius = random.uniform(0, 1) < 0.3 ? 0 : random.uniform(0, 0.05);
  return shape;
}

Shape random_shape(Random& random, Kind kind, int link) {
  if (kind == Kind::kHull) return random_hull(random, link);
  Shape shape;
  shape.kind = kind;
  shape.link = link;
  shape.placement = {random_rotation(random), random_vector(random, 0.2)};
  shape.radius = random.uniform(0.02, 0.1);
  shape.half_length = random.uniform(0.05, 0.2);
  shape.half_sizes = Eigen::Vector3d(0.15, 0.1, 0.1) + random_vector(random, 0.05);
  return shape;
}

/// A robot with two bodies, of which one is a hull at least.
class TwoBodies {
 public:
  TwoBodies(Problem& problem, Random& random)
      : problem_(problem), q_(resting_joints(problem.robot)), kinematics_(problem.robot) {
    constexpr std::array kKinds = {Kind::kHull, Kind::kBox, Kind::kCapsule, Kind::kCylinder};
    const Kind other = kKinds[static_cast<std::size_t>(random.uniform(0, 3.999))];
    const int last = static_cast<int>(problem.robot.links.size()) - 1;
    const bool first = random.uniform(0, 1) < 0.5;
    const int on = random.uniform(0, 1) < 0.5 ? 0 : 1;
    const double margin = random.uniform(0, 1) < 0.5 ? 0 : 0.01;
    shapes_ = {random_shape(random, first ? Kind::kHull : other, on),
               random_shape(random, first ? other : Kind::kHull, last - 1)};
    whole_ = other != Kind::kCylinder;
    problem.robot.collision = make_collision_checker(shapes_, {}, margin);
    problem.robot.collision->inner_bodies(0, bodies_);
  }

  const std::vector<Pose<double>>& links(const Eigen::VectorXd& theta_r) {
    const std::vector<int> joints = moved_joints(problem_);
    for (std::size_t i = 0; i < joints.size(); ++i) {
      if (joints[i] >= 0) q_[joints[i]] = theta_r[static_cast<Eigen::Index>(i)];
    }
    kinematics_.set_joints(q_);
    return kinematics_.links();
  }
  bool collide(const Eigen::VectorXd& theta_r) {
    return problem_.robot.collision->collides(links(theta_r));
  }
  /// Whether they are deeper within reach than rounding and the margins of proofs. Not known of
  /// cylinders.
  bool are_deep(const Eigen::VectorXd& theta_r) {
    ClosestPoints near;
    return whole_ && bodies_.reach > 1e-4 &&
           problem_.robot.collision->nearest(links(theta_r), 0, near) && near.clearance < -1e-5;
  }
  const InnerBodyPair& bodies() const { return bodies_; }

 private:
  const Problem& problem_;
  std::vector<Shape> shapes_;
  InnerBodyPair bodies_;
  bool whole_ = false;
  Eigen::VectorXd q_;
  Kinematics<double> kinematics_;
};

bool bound_proves(Bound& bound, const RandomBox& box) {
  BoxProof proof;
  bound.evaluate(box.lower, box.upper, 0, bound.ceiling(), proof);
  return proof.kind == BoxProof::Kind::kCollision;
}

/// Points of a box, corners among them.
Eigen::VectorXd point_of(const RandomBox& box, Random& random) {
  Eigen::VectorXd q = box.lower;
  const bool corner = random.uniform(0, 1) < 0.5;
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const double share = random.uniform(0, 1);
    q[i] = corner ? (share < 0.5 ? box.lower : box.upper)[i]
                  : box.lower[i] + share * (box.upper[i] - box.lower[i]);
  }
  return q;
}

/// What the bound proves, the check proves; and what either proves collides everywhere. Without a
/// reach there is no bound.
TEST(HullCollisionProof, ProvesNothingFalse) {
  Problem problem = load_problem("uvms/valve");
  Random random(11);
  int by_bound = 0, by_check = 0, apart = 0;
  for (int sample = 0; sample < samples(400); ++sample) {
    TwoBodies two(problem, random);
    const auto bound = make_collision_bound(problem);
    EXPECT_EQ(bound == nullptr, two.bodies().reach <= 1e-6);
    const FormModel model(problem);
    CollisionProof check(problem, model);
    for (int each = 0; each < 20; ++each) {
      const RandomBox box = random_box(problem, random);
      const bool bounded = bound && bound_proves(*bound, box);
      const bool checked = check.collides(box.lower, box.upper, 0);
      by_bound += bounded ? 1 : 0;
      by_check += checked ? 1 : 0;
      EXPECT_TRUE(checked || !bounded) << sample;
      for (int point = 0; point < 40; ++point) {
        const bool collide = two.collide(point_of(box, random));
        apart += collide ? 0 : 1;
        if (bounded || checked) ASSERT_TRUE(collide) << sample << " " << bounded << checked;
      }
    }
  }
  EXPECT_GT(by_bound, samples(200));
  EXPECT_GE(by_check, by_bound);
  EXPECT_GT(apart, samples(1000));
}

/// A small box about a collision that is deeper than rounding has a proof.
TEST(HullCollisionProof, ProvesSmallBoxes) {
  Problem problem = load_problem("uvms/valve");
  Random random(12);
  int deep = 0;
  for (int sample = 0; sample < samples(400); ++sample) {
    TwoBodies two(problem, random);
    const auto bound = make_collision_bound(problem);
    const FormModel model(problem);
    CollisionProof check(problem, model);
    for (int each = 0; each < 20; ++each) {
      RandomBox box;
      box.inside = random_theta_r(problem, random);
      if (!two.are_deep(box.inside)) continue;
      ++deep;
      box.lower = box.inside.array() - 1e-7;
      box.upper = box.inside.array() + 1e-7;
      EXPECT_TRUE(bound_proves(*bound, box)) << sample;
      EXPECT_TRUE(check.collides(box.lower, box.upper, 0)) << sample;
    }
  }
  EXPECT_GT(deep, samples(300));
}

/// What an object remembers of one pair says nothing of another one.
TEST(HullCollisionProof, PairsInTurnAreAsAlone) {
  Problem problem = load_problem("uvms/valve");
  Random random(13);
  int yes = 0, no = 0;
  for (int sample = 0; sample < samples(60); ++sample) {
    std::vector<Shape> shapes;
    for (int link = 0; link < 4; ++link) shapes.push_back(random_hull(random, link));
    problem.robot.collision = make_collision_checker(shapes, {}, 0.05);
    const FormModel model(problem);
    CollisionProof in_turn(problem, model);
    for (int each = 0; each < 5; ++each) {
      const RandomBox box = random_box(problem, random);
      for (int pair = 0; pair < problem.robot.collision->pairs(); ++pair) {
        CollisionProof alone(problem, model);
        const bool collide = alone.collides(box.lower, box.upper, pair);
        (collide ? yes : no) += 1;
        EXPECT_EQ(in_turn.collides(box.lower, box.upper, pair), collide) << sample << " " << pair;
      }
    }
  }
  EXPECT_GT(yes, samples(60));
  EXPECT_GT(no, samples(60));
}

/// Points that are no numbers prove nothing.
TEST(HullCollisionProof, ProvesNothingOfNoNumbers) {
  class NoNumbers : public CollisionChecker {
   public:
    int colliding_pair(const std::vector<Pose<double>>&) const override { return -1; }
    int pairs() const override { return 1; }
    bool nearest(const std::vector<Pose<double>>&, int, ClosestPoints&) const override {
      return false;
    }
    std::string pair_name(int) const override { return "no numbers"; }
    bool inner_bodies(int, InnerBodyPair& pair) const override {
      const double none = std::nan("");
      pair.a.link = 1;
      pair.a.points = {{none, 0, 0}, {0, none, 0}, {0, 0, none}};
      pair.b.points = {{none, none, none}};
      pair.reach = 1;
      return true;
    }
  };
  Problem problem = load_problem("uvms/valve");
  problem.robot.collision = std::make_shared<NoNumbers>();
  const auto bound = make_collision_bound(problem);
  const FormModel model(problem);
  CollisionProof check(problem, model);
  RandomBox box;
  box.lower = box.upper = problem.theta_r_default;
  EXPECT_FALSE(bound_proves(*bound, box));
  EXPECT_FALSE(check.collides(box.lower, box.upper, 0));
}

}  // namespace
}  // namespace maxwrench
