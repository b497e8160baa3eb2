#include "solvers/certify/bound/loop_model.h"

#include <gtest/gtest.h>

#include <algorithm>

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

}  // namespace
}  // namespace maxwrench
