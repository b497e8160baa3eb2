#include "solvers/certify/bound/multi_affine.h"

#include <gtest/gtest.h>

#include <cmath>

#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "tests/support/boxes.h"

namespace maxwrench {
namespace {

Problem with_slides() {
  Random random(3);
  return random_problem(random, 4);
}

/// [tau_d; J'c] as the model that searches use says, in double.
Eigen::VectorXd model_rows(PostureEvaluator& model, const Problem& problem,
                           const Eigen::VectorXd& theta_r) {
  const Posture& posture = model.evaluate(theta_r);
  Eigen::VectorXd rows(2 * posture.tau_d.size());
  rows << posture.tau_d, posture.J.transpose() * problem.c;
  return rows;
}

/// The rows are multi-affine indeed, though they are read off a few postures only.
TEST(MultiAffine, IsTheModel) {
  for (const Problem& problem :
       {load_problem("planar/force"), load_problem("uvms/valve"), with_slides()}) {
    const MultiAffine f = pure_rows(problem);
    PostureEvaluator model(problem, false);
    const Eigen::VectorXd S = f.magnitudes(problem.theta_r_min, problem.theta_r_max);
    Random random(1);
    for (int sample = 0; sample < 200; ++sample) {
      const Eigen::VectorXd theta_r = random_theta_r(problem, random);
      const Eigen::VectorXd expected = model_rows(model, problem, theta_r);
      const Eigen::VectorXd off = f.evaluate(theta_r) - expected;
      EXPECT_LT(off.lpNorm<Eigen::Infinity>(), 1e-13 * S.maxCoeff());
      EXPECT_TRUE((expected.cwiseAbs().array() <= S.array() + 1e-13).all());
    }
  }
}

/// A product of two cosines and a length, by hand.
TEST(MultiAffine, ReadsCoefficientsOff) {
  const Coordinates coordinates{{0, 2}, {1, 0}};
  const auto f = [](const ExtendedVector& q) {
    ExtendedVector rows(2);
    rows << 5 + 2 * std::cos(q[0]) * q[2], 3 * std::sin(q[0]) - q[2];
    return rows;
  };
  const MultiAffine fitted(coordinates, Eigen::Vector3d(0.1, 0.2, 0.3), f);
  Eigen::MatrixXd expected(2, 6);  // 1, q_2, cos q_0, cos q_0 q_2, sin q_0, sin q_0 q_2
  expected << 5, 0, 0, 2, 0, 0,    //
      0, -1, 0, 0, 3, 0;
  EXPECT_TRUE(fitted.coefficients().isApprox(expected, 1e-15)) << fitted.coefficients();
  const Eigen::Vector3d lower(-1, -1, -2), upper(1, 1, 0.5);
  EXPECT_TRUE(fitted.magnitudes(lower, upper).isApprox(Eigen::Vector2d(9, 5), 1e-15));
}

struct SampledBox {
  Eigen::VectorXd lower, upper;
};

SampledBox box_around(const Problem& problem, double half, Random& random) {
  const Eigen::VectorXd centre = random_theta_r(problem, random);
  SampledBox box{centre.array() - half, centre.array() + half};
  return box;
}

/// In every direction no posture of a box is beyond all control points, and its corners are among
/// them.
TEST(ControlPoints, Enclose) {
  for (const Problem& problem : {load_problem("uvms/valve"), with_slides()}) {
    const MultiAffine f = pure_rows(problem);
    ControlPoints corners(f);
    Random random(2);
    for (int sample = 0; sample < samples(200); ++sample) {
      const SampledBox box = box_around(problem, std::pow(10, -random.uniform(0, 2)), random);
      const Eigen::MatrixXd P = corners.over(box.lower, box.upper);
      EXPECT_TRUE(P.col(0).isApprox(f.evaluate(box.lower), 1e-12));
      EXPECT_TRUE(P.col(P.cols() - 1).isApprox(f.evaluate(box.upper), 1e-12));
      for (int inside = 0; inside < 20; ++inside) {
        Eigen::VectorXd q = box.lower;
        for (Eigen::Index i = 0; i < q.size(); ++i)
          q[i] = random.uniform(box.lower[i], box.upper[i]);
        Eigen::VectorXd direction(f.rows());
        for (double& x : direction) x = random.uniform(-1, 1);
        const double most = (direction.transpose() * P).maxCoeff();
        EXPECT_LE(direction.dot(f.evaluate(q)), most + 1e-10);
      }
    }
  }
}

/// What a box shares with the one before is not computed again, to the same end.
TEST(ControlPoints, DoNotDependOnTheBoxBefore) {
  const Problem problem = load_problem("uvms/lift");
  const MultiAffine f = pure_rows(problem);
  ControlPoints used(f);
  Random random(4);
  SampledBox box = box_around(problem, 0.5, random);
  for (int sample = 0; sample < 50; ++sample) {
    const int axis = sample % 4;
    (sample % 3 == 0 ? box.lower : box.upper)[axis] = random.uniform(-1, 1) + sample % 3;
    if (spread(f.coordinates(), box.lower, box.upper) == kInfinity) continue;
    EXPECT_EQ(used.over(box.lower, box.upper), ControlPoints(f).over(box.lower, box.upper));
  }
}

/// Halving a box quarters how far control points are beyond the postures, here over half a circle:
/// at the tangents' meeting point 1/cos r - 1 = r^2/2 + ...
TEST(ControlPoints, ConvergeWithTheSquare) {
  const MultiAffine circle({{0}, {1}}, Eigen::VectorXd::Zero(1), [](const ExtendedVector& q) {
    return ExtendedVector(ExtendedVector::Constant(1, std::cos(q[0])));
  });
  ControlPoints corners(circle);
  for (const double r : {0.4, 0.2, 0.1}) {
    const Eigen::VectorXd end = Eigen::VectorXd::Constant(1, r);
    EXPECT_NEAR(corners.over(-end, end).maxCoeff() - 1, 1 / std::cos(r) - 1, 1e-15);
    EXPECT_NEAR(spread(circle.coordinates(), -end, end), 1 / std::cos(r), 1e-15);
  }
  const Eigen::VectorXd quarter = Eigen::VectorXd::Constant(1, 1.5708);
  EXPECT_EQ(spread(circle.coordinates(), -quarter, quarter), kInfinity);
}

}  // namespace
}  // namespace maxwrench
