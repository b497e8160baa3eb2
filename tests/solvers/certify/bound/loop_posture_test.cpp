#include "solvers/certify/bound/loop_posture.h"

#include <gtest/gtest.h>

#include "tests/support/loops.h"

namespace maxwrench {
namespace {

class LoopPostureOf : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Problems, LoopPostureOf, testing::ValuesIn(kLoopProblems), loop_name);

/// At postures, which other code finds, the equations hold and the loads are those of the posture.
TEST_P(LoopPostureOf, IsThePosture) {
  const Problem problem = loop_problem(GetParam());
  PostureSource source(problem, "linf_polytope");
  LoopPosture loop(problem, source.coordinates());
  const Eigen::Index n = problem.robot.velocities();
  // A base that turns in place of a joint has loads along its own axes.
  const auto base = static_cast<Eigen::Index>(problem.robot.base_axes.size());
  const Eigen::Index known = source.coordinates().resting ? n - base : n;
  Random random(1);
  int seen = 0;
  for (int sample = 0; sample < 400; ++sample) {
    const ValuedPosture* const at = source.draw(random);
    if (at == nullptr) continue;
    ++seen;
    loop.set(at->x.cast<Extended>());
    Eigen::VectorXd tau = loop.loads().head(n).cast<double>();
    const Eigen::VectorXd a = loop.loads().tail(n).cast<double>();
    const WrenchProgram& program = source.program();
    Eigen::VectorXd expected = program.tau_d;
    const Eigen::Index l = problem.contact_columns();
    if (l > 0) {
      tau += (loop.forces() + at->value * loop.forces_by_t()).cast<double>();
      expected += program.JtW.rightCols(l) * source.capability().w.tail(l);
    }
    const double size = 1 + expected.cwiseAbs().maxCoeff();
    EXPECT_LT((tau - expected).tail(known).cwiseAbs().maxCoeff(), 1e-8 * size);
    EXPECT_LT((a - program.JtW.col(0)).tail(known).cwiseAbs().maxCoeff(), 1e-8);
    if (!source.coordinates().base_is_dependent) {
      for (const int k : {0, 2}) {
        EXPECT_LT((loop.left(k) - loop.right(k)).cwiseAbs().maxCoeff(), 1e-8);
      }
    }
    if (!problem.contact) continue;
    if (l > 0 && problem.robot.base_axes.size() == 6) {  // the base bears the contact's force
      const ExtendedVector forces = loop.forces();
      EXPECT_LT((loop.levers() * forces.head<3>() - forces).cwiseAbs().maxCoeff(), 1e-12 * size);
    }
    EXPECT_LT((loop.touching() - loop.touched()).cwiseAbs().maxCoeff(), 1e-8);
  }
  EXPECT_GT(seen, 10);
}

}  // namespace
}  // namespace maxwrench
