#include "solvers/certify/bound/loop_model.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "maxwrench/load.h"
#include "tests/support/loops.h"

namespace maxwrench {
namespace {

class LoopModelOf : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Problems, LoopModelOf, testing::ValuesIn(kLoopProblems), loop_name);

/// The equations of the base, at the middle of the chain, and of the contact.
Eigen::VectorXd all_equations(const Problem& problem, const LoopPosture& loop,
                              const LoopModel& model) {
  const LoopCoordinates& all = model.coordinates;
  const int k = std::clamp((all.yaw.from + all.free.to) / 2 - all.first.from, 0, all.first.count());
  Eigen::VectorXd base, contact;
  if (!all.base_is_dependent) base = (loop.left(k) - loop.right(k)).cast<double>();
  if (problem.contact) contact = (loop.touching() - loop.touched()).cast<double>();
  Eigen::VectorXd both(base.size() + contact.size());
  both << base, contact;
  return both;
}

/// The sum of the parts is the model, wherever x is.
TEST_P(LoopModelOf, IsASumOfMultiAffineParts) {
  const Problem problem = loop_problem(GetParam());
  const LoopModel model(problem);
  LoopPosture loop(problem, model.coordinates);
  Random random(2);
  for (int sample = 0; sample < 20; ++sample) {
    const Eigen::VectorXd x = Eigen::VectorXd::NullaryExpr(model.coordinates.lower.size(),
                                                           [&] { return random.uniform(-2, 2); });
    Eigen::VectorXd loads = Eigen::VectorXd::Zero(2 * model.n), f = Eigen::VectorXd::Zero(model.m);
    for (const LoopPart& part : model.parts) {
      const Eigen::VectorXd values = part.f.evaluate(x);
      const auto count = static_cast<Eigen::Index>(part.rows.size());
      if (part.kind == LoopPart::Kind::kEquations) {
        f(part.rows) += values;
        continue;
      }
      loads.head(model.n)(part.rows) += values.head(count);
      if (part.kind == LoopPart::Kind::kLoads) {
        loads.tail(model.n)(part.rows) += values.tail(count);
      }
    }
    loop.set(x.cast<Extended>());
    Eigen::VectorXd expected = loop.loads().cast<double>();
    if (problem.contact_columns() > 0) {
      expected.head(model.n) += loop.forces().cast<double>();
      expected.tail(model.n) += loop.forces_by_t().cast<double>();
    }
    EXPECT_LT((loads - expected).cwiseAbs().maxCoeff(),
              1e-9 * (1 + expected.cwiseAbs().maxCoeff()));
    const Eigen::VectorXd gap = all_equations(problem, loop, model);
    ASSERT_EQ(f.size(), gap.size());
    EXPECT_LT((f - gap).cwiseAbs().maxCoeff(), 1e-9);
  }
}

/// Without the base's linear rows, the force of the contact is what these rows leave.
TEST(LoopModel, LeavesOutTheForcesThatTheBaseDetermines) {
  Problem problem = load_problem("dual_arm/two_arms");
  problem.c << 0.6, 0, 0, 0, 0.8, 0;  // with a force, which loads the second arm as well
  ASSERT_TRUE(base_determines_forces(problem));
  const LoopModel model(problem, ContactForces::kOfBase);
  const LoopModel with_shares(problem);
  const Eigen::Index count = model.coordinates.lower.size(), others = model.n - 3;
  EXPECT_EQ(with_shares.coordinates.lower.size(), count + 3);
  EXPECT_EQ(with_shares.m, model.m);
  LoopPosture loop(problem, model.coordinates);
  Random random(2);
  for (int sample = 0; sample < 20; ++sample) {
    const Eigen::VectorXd x =
        Eigen::VectorXd::NullaryExpr(count, [&] { return random.uniform(-2, 2); });
    Eigen::VectorXd tau = Eigen::VectorXd::Zero(model.n), a = tau;
    for (const LoopPart& part : model.parts) {
      if (part.kind == LoopPart::Kind::kEquations) continue;
      const Eigen::VectorXd values = part.f.evaluate(x);
      const auto rows = static_cast<Eigen::Index>(part.rows.size());
      tau(part.rows) += values.head(rows);
      a(part.rows) += values.tail(rows);
    }
    loop.set(x.cast<Extended>());
    // The thrusters' force on the base is F, so the contact bears F less the other loads.
    const Eigen::Vector3d F = random_vector(random);
    const double t = random.uniform(-2, 2);
    const Eigen::VectorXd loads =
        (loop.loads().head(model.n) + t * loop.loads().tail(model.n)).cast<double>();
    const Eigen::MatrixXd A = loop.levers().cast<double>();
    const Eigen::VectorXd expected = loads + A * (F - loads.head<3>());
    const Eigen::VectorXd found = tau + t * a + model.levers->evaluate(x).reshaped(model.n, 3) * F;
    EXPECT_LT((expected.head<3>() - F).norm(), 1e-12);
    EXPECT_LT((found - expected).tail(others).cwiseAbs().maxCoeff(),
              1e-9 * (1 + expected.cwiseAbs().maxCoeff()));
  }
}

}  // namespace
}  // namespace maxwrench
