#include "solvers/certify/bound/free_points.h"

#include <gtest/gtest.h>

#include "lib/math/decompositions.h"
#include "tests/support/loops.h"

namespace maxwrench {
namespace {

class FreePointsOf : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Problems, FreePointsOf,
                         testing::Values("mobile/push", "fixed/push", "mobile/push_any_height",
                                         "random, fixed", "random, x", "random, x y yaw",
                                         "random, free tool", "random, parked"),
                         loop_name);

/// J'W of the free components at postures, from the evaluation, and the largest share of efforts
/// and free components in a box about one: that of the best wrench is no larger.
TEST_P(FreePointsOf, AreThoseOfPostures) {
  const Problem problem = loop_problem(GetParam());
  const LoopModel model(problem);
  const auto columns = std::make_shared<const FreeColumns>(problem, model);
  const auto set = std::make_shared<const Zonotope>(problem.robot.actuation);
  const Eigen::MatrixXd S = split(problem.W_any.transpose() * problem.c).complement;
  ASSERT_EQ(columns->k, S.cols());
  FreePoints points(columns, model, set);
  LoopBox box(model);
  PostureSource source(problem, "linf_polytope", ContactForces::kShares, Wrench::kAny);
  Random random(5);
  int seen = 0, limited = 0;
  for (int sample = 0; sample < 100 && seen < samples(100); ++sample) {
    const ValuedPosture* const at = source.draw(random);
    if (at == nullptr) continue;
    ++seen;
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(model.n, columns->k);
    for (const FreeColumns::Part& part : columns->parts) {
      const auto count = static_cast<Eigen::Index>(part.rows.size());
      A(part.rows, Eigen::all) += part.f.evaluate(at->x).reshaped(count, columns->k);
    }
    const Eigen::MatrixXd expected = source.program().JtW * S;
    EXPECT_LT((A - expected).cwiseAbs().maxCoeff(), 1e-8 * (1 + expected.cwiseAbs().maxCoeff()));

    const Eigen::VectorXd lower = at->x.array() - 1e-9, upper = at->x.array() + 1e-9;
    ASSERT_TRUE(box.set(lower, upper));
    if (!points.set(box, lower, upper, -kInfinity, kInfinity)) continue;
    ++limited;
    EXPECT_LE(std::abs(at->value), points.most_t() * (1 + 1e-9));
    EXPECT_LT((points.N().transpose() * A).cwiseAbs().maxCoeff(), 1e-7);
    const Capability& best = source.capability();
    const Eigen::VectorXd h = S.transpose() * best.w;
    for (int times = 0; times < 5; ++times) {
      const Eigen::VectorXd lambda =
          Eigen::VectorXd::NullaryExpr(model.n, [&] { return random.uniform(-1, 1); });
      Eigen::VectorXd g = Eigen::VectorXd::Zero(model.size);
      points.weigh(lambda, g);
      const double own = lambda.dot(set->B * best.u) - lambda.dot(A * h);
      EXPECT_GE(-g.minCoeff(), own - 1e-6 * (1 + std::abs(own)));
      // The pattern of a point has this largest share.
      const Eigen::Index v = model.size / 2;
      Eigen::VectorXd load = Eigen::VectorXd::Zero(model.n), u(set->actuators());
      const int pattern = points.pattern(v);
      points.add(v, pattern, load);
      for (Eigen::Index i = 0; i < u.size(); ++i) {
        u[i] = pattern >> i & 1 ? set->u_max[i] : set->u_min[i];
      }
      const double share = lambda.dot(set->B * u) - lambda.dot(load);
      EXPECT_NEAR(share, -g[v], 1e-6 * (1 + lambda.cwiseAbs().dot(points.sizes())));
    }
  }
  EXPECT_GT(seen, 0);
  EXPECT_GT(limited, seen / 2);
}

}  // namespace
}  // namespace maxwrench
