#include "lib/trajectory/clearance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "maxwrench/load.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
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

/// The slope of a pair's clearance by a coordinate of a knot.
double slope_of(const NearPair& pair, Eigen::Index knot, Eigen::Index coordinate) {
  const double at_knot = pair.knot == knot ? 1 : 0;
  const double share = pair.weights.size() > 0 ? pair.weights[knot] : at_knot;
  return share * pair.gradient[coordinate];
}

/// Compares the slopes of all pairs by all knots with differences. Returns the number of pairs.
std::size_t expect_slopes_of_trajectories(const Problem& problem) {
  TrajectoryEvaluator evaluator(problem, Wrench::kPure, trajectory_solvers().front().make);
  Eigen::VectorXd x = problem.theta_r_default.replicate(problem.motion->k, 1);
  Random random(6);
  for (double& q : x) q += random.uniform(-0.2, 0.2);
  const auto near = [&](const Eigen::VectorXd& at) {
    return evaluator.near_pairs(unstacked(at, knots_of(problem)), kInfinity);
  };
  const auto pairs = near(x);
  const double h = 1e-6;
  const Eigen::Index r = problem.redundancy();
  int compared = 0;
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const auto after = near(x + h * Eigen::VectorXd::Unit(x.size(), j));
    const auto before = near(x - h * Eigen::VectorXd::Unit(x.size(), j));
    EXPECT_EQ(after.size(), pairs.size());
    EXPECT_EQ(before.size(), pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const double right = (after[i].clearance - pairs[i].clearance) / h;
      const double left = (pairs[i].clearance - before[i].clearance) / h;
      if (std::abs(right - left) > 1e-3) continue;  // another feature becomes the nearest
      const double slope = slope_of(pairs[i], j / r, j % r);
      EXPECT_NEAR(slope, (right + left) / 2, 1e-5);
      compared += std::abs(slope) > 1e-3;
    }
  }
  EXPECT_GT(compared, 20);
  return pairs.size();
}

/// Of trajectories, also with dependent joints, and with a start that is given.
TEST(Clearance, GradientIsThatOfKnotsAndInstants) {
  for (const char* name : {"mobile/trajectory", "uvms/lift_impulse"}) {
    Problem problem = load_problem(name);
    const std::size_t at_knots = expect_slopes_of_trajectories(problem);
    problem.motion->clear_at_instants = true;
    EXPECT_GT(expect_slopes_of_trajectories(problem), 2 * at_knots) << name;
  }
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

TrajectoryEvaluator evaluator_of(const Problem& problem, bool check_collision = true) {
  return {problem, Wrench::kPure, trajectory_solvers().front().make, check_collision};
}

/// The clamped cubic spline through the rows of a table one apart, by its slopes m at them:
/// m_i-1 + 4 m_i + m_i+1 = 3 (y_i+1 - y_i-1), none at the ends.
class ClampedSpline {
 public:
  explicit ClampedSpline(const Eigen::MatrixXd& y) : y_(y) {
    const Eigen::Index k = y.rows();
    Eigen::MatrixXd A = Eigen::MatrixXd::Identity(k, k);
    Eigen::MatrixXd b = Eigen::MatrixXd::Zero(k, y.cols());
    for (Eigen::Index i = 1; i < k - 1; ++i) {
      A.row(i).segment(i - 1, 3) << 1, 4, 1;
      b.row(i) = 3 * (y.row(i + 1) - y.row(i - 1));
    }
    m_ = A.lu().solve(b);
  }
  Eigen::VectorXd operator()(double s) const {
    const auto i = std::min(static_cast<Eigen::Index>(s), y_.rows() - 2);
    const double x = s - static_cast<double>(i), z = 1 - x;
    return z * z * ((1 + 2 * x) * y_.row(i) + x * m_.row(i)) +
           x * x * ((1 + 2 * z) * y_.row(i + 1) - z * m_.row(i + 1));
  }

 private:
  Eigen::MatrixXd y_, m_;
};

/// What a curve comes to at instants much denser than those of `value_between_knots`.
struct Dense {
  double least = kInfinity, swept = 0;  ///< m, rad: of all joints in half an interval of those
  bool collides = false;
};

Dense dense_least(const Problem& problem, const ClampedSpline& curve, int intervals) {
  constexpr int kSteps = 400, kHalf = kSteps / 50;
  Kinematics<double> kinematics(problem.robot);
  Dense dense;
  std::vector<NearPair> near;
  Eigen::VectorXd before = curve(0);
  for (int i = 0; i <= intervals * kSteps; ++i) {
    const Eigen::VectorXd q = curve(static_cast<double>(i) / kSteps);
    dense.swept = std::max(dense.swept, kHalf * (q - before).lpNorm<1>());
    before = q;
    kinematics.set_joints(q);
    dense.collides |= problem.robot.collision->collides(kinematics.links());
    near.clear();
    find_near_pairs(problem, kinematics, 0, dense.least, near);
    for (const NearPair& pair : near) dense.least = std::min(dense.least, pair.clearance);
  }
  return dense;
}

TEST(LeastClearance, SLOW_IsThatOfAMuchDenserCurve) {
  const Problem problem = load_problem("uvms/valve_trajectory");
  const int k = problem.motion->k;
  TrajectoryEvaluator evaluator = evaluator_of(problem);
  Random random(5);
  const int count = std::max(20, samples(60));
  int clear = 0, between = 0;
  for (int sample = 0; sample < count; ++sample) {
    Eigen::MatrixXd knots = problem.theta_r_default.transpose().replicate(k, 1);
    knots.col(2).array() += 0.25;  // away from where the forearm meets the base
    for (double& q : knots.reshaped()) q += random.uniform(-0.3, 0.3);
    const bool knot_collides = !evaluator.evaluate(knots).collision.empty();
    const auto found = evaluator.least_clearance();
    ASSERT_TRUE(found);
    const Dense dense = dense_least(problem, ClampedSpline(knots), k - 1);
    // It contains the instants of `value_between_knots`. No body is 1 m from the axis of a joint,
    // so two come nearer by less than 1 m for each radian that the joints turn by.
    EXPECT_LE(dense.least, found->least + 1e-9);
    EXPECT_GE(dense.least, found->least - dense.swept);
    EXPECT_EQ(dense.collides, dense.least < 0);
    EXPECT_TRUE(found->least < 0 || !knot_collides);
    clear += found->least > 0;
    between += found->least < 0 && !knot_collides;
    Kinematics<double> kinematics(problem.robot);
    kinematics.set_joints(ClampedSpline(knots)(found->t / problem.motion->T * (k - 1)));
    std::vector<NearPair> near;
    find_near_pairs(problem, kinematics, 0, found->least + 1e-9, near);
    ASSERT_EQ(near.size(), 1U);
    EXPECT_NEAR(near[0].clearance, found->least, 1e-9);
  }
  EXPECT_GT(clear, 0);
  EXPECT_GT(between, 0);  // a collision that no knot shows
}

/// Two knots on either side of a collision: it counts only where instants do.
TEST(Clearance, CollidesBetweenKnotsWhereInstantsCount) {
  Problem problem = load_problem("uvms/valve_trajectory");
  const int k = problem.motion->k;
  Random random(5);
  int between = 0;
  for (int sample = 0; sample < 60; ++sample) {
    Eigen::MatrixXd knots = problem.theta_r_default.transpose().replicate(k, 1);
    knots.col(2).array() += 0.25;  // away from where the forearm meets the base
    for (double& q : knots.reshaped()) q += random.uniform(-0.3, 0.3);
    problem.motion->clear_at_instants = false;
    TrajectoryEvaluator of_knots = evaluator_of(problem);
    if (!of_knots.evaluate(knots).collision.empty()) continue;
    problem.motion->clear_at_instants = true;
    TrajectoryEvaluator of_instants = evaluator_of(problem);
    const std::string collision = of_instants.evaluate(knots).collision.str();
    const auto least = [&](TrajectoryEvaluator& evaluator) {
      double found = kInfinity;
      for (const NearPair& pair : evaluator.near_pairs(knots, 1)) {
        found = std::min(found, pair.clearance);
      }
      return found;
    };
    EXPECT_GT(least(of_knots), 0);
    EXPECT_EQ(least(of_instants) < 0, !collision.empty());
    if (collision.empty()) continue;
    ++between;
    EXPECT_NE(collision.find("at t = "), std::string::npos) << collision;
    EXPECT_EQ(of_instants.evaluate_elastic(knots, nullptr), -kInfinity);
  }
  EXPECT_GT(between, 0);
}

/// Collides at one posture only.
class CollidesAt final : public CollisionChecker {
 public:
  explicit CollidesAt(std::vector<Pose<double>> links) : links_(std::move(links)) {}
  int colliding_pair(const std::vector<Pose<double>>& links) const override {
    return (links.back().p - links_.back().p).norm() < 1e-9 ? 0 : -1;
  }
  int pairs() const override { return 1; }
  bool nearest(const std::vector<Pose<double>>&, int, ClosestPoints&) const override {
    return false;
  }
  std::string pair_name(int) const override { return "one and other"; }

 private:
  std::vector<Pose<double>> links_;
};

/// No knot moves the start of an impulse, so a collision there is not theirs.
TEST(Clearance, LeavesOutAStartThatIsGiven) {
  Problem problem = load_problem("uvms/lift_impulse");
  Kinematics<double> kinematics(problem.robot);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem.robot.joints.size()));
  for (std::size_t k = 0; k < problem.redundant.size(); ++k) {
    q[problem.redundant[k]] = problem.motion->theta_0[static_cast<Eigen::Index>(k)];
  }
  kinematics.set_joints(q);
  problem.robot.collision = std::make_shared<CollidesAt>(kinematics.links());
  const Eigen::MatrixXd still = problem.motion->theta_0.transpose().replicate(problem.motion->k, 1);
  Eigen::MatrixXd moved = still;
  moved.col(2).array() += 0.1;
  for (const bool at_instants : {false, true}) {
    problem.motion->clear_at_instants = at_instants;
    TrajectoryEvaluator evaluator = evaluator_of(problem);
    EXPECT_EQ(evaluator.evaluate(moved).collision.str(), "");
    EXPECT_NE(evaluator.evaluate(still).collision.str(), "");
  }
}

TEST(LeastClearance, NamesTheCollisionOfAKnot) {
  const Problem problem = load_problem("uvms/valve_trajectory");
  Eigen::VectorXd folded = problem.theta_r_default;
  folded[2] = problem.theta_r_min[2];  // onto the base
  const Eigen::MatrixXd knots = folded.transpose().replicate(problem.motion->k, 1);
  TrajectoryEvaluator evaluator = evaluator_of(problem);
  EXPECT_FALSE(evaluator.evaluate(knots).collision.empty());
  const auto found = evaluator.least_clearance();
  ASSERT_TRUE(found);
  EXPECT_LT(found->least, 0);
  EXPECT_EQ(found->t, 0);  // nothing moves
  EXPECT_NE(found->pair.find(" and "), std::string::npos);
  TrajectoryEvaluator blind = evaluator_of(problem, false);
  blind.evaluate(knots);
  EXPECT_FALSE(blind.least_clearance());
}

TEST(LeastClearance, OfOneKnotIsThatOfItsPosture) {
  const Problem problem = load_problem("uvms/valve");
  TrajectoryEvaluator evaluator = evaluator_of(problem);
  evaluator.evaluate(problem.theta_r_default.transpose());
  Kinematics<double> kinematics(problem.robot);
  kinematics.set_joints(problem.theta_r_default);
  std::vector<NearPair> near;
  find_near_pairs(problem, kinematics, 0, kInfinity, near);
  double least = kInfinity;
  for (const NearPair& pair : near) least = std::min(least, pair.clearance);
  const auto found = evaluator.least_clearance();
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->least, least, 1e-9);
  EXPECT_EQ(found->t, 0);
}

/// One pair of which only a test is known.
class TestOnly final : public CollisionChecker {
 public:
  explicit TestOnly(bool collides) : collides_(collides) {}
  int colliding_pair(const std::vector<Pose<double>>& /*links*/) const override {
    return collides_ ? 0 : -1;
  }
  int pairs() const override { return 1; }
  bool nearest(const std::vector<Pose<double>>& /*links*/, int /*pair*/,
               ClosestPoints& /*result*/) const override {
    return false;
  }
  std::string pair_name(int /*pair*/) const override { return "hull and cylinder"; }

 private:
  bool collides_;
};

TEST(LeastClearance, IsZeroWhereOnlyATestSaysThatBodiesCollide) {
  Problem problem = load_problem("uvms/valve_trajectory");
  for (const bool collides : {true, false}) {
    problem.robot.collision = std::make_shared<TestOnly>(collides);
    TrajectoryEvaluator evaluator = evaluator_of(problem);
    evaluator.evaluate(problem.theta_r_default.transpose().replicate(problem.motion->k, 1));
    const auto found = evaluator.least_clearance();
    ASSERT_EQ(found.has_value(), collides);
    if (!collides) continue;
    EXPECT_EQ(found->least, 0);
    EXPECT_EQ(found->pair, "hull and cylinder");
  }
}

}  // namespace
}  // namespace maxwrench
