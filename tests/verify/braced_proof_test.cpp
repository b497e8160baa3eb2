#include <gtest/gtest.h>

#include "maxwrench/bound.h"
#include "maxwrench/load.h"
#include "tests/support/loops.h"
#include "verify/equations.h"
#include "verify/model.h"
#include "verify/value_proof.h"

namespace maxwrench {
namespace {

/// Two arms, with a wrench that has a force as well.
Problem pushing_and_turning() {
  Problem problem = load_problem("dual_arm/two_arms");
  problem.c << 0.48, 0, 0.36, 0, 0, 0.8;
  problem.W_any = problem.c;
  return problem;
}

/// At valid postures the efforts that other code found balance the rows that are left.
TEST(BracedRows, AreTheBalanceWithoutTheContactsForce) {
  const Problem problem = pushing_and_turning();
  const FormModel model(problem);
  const BracedRows rows = braced_rows(model, problem.c);
  PostureSource source(problem, "linf_polytope", ContactForces::kOfBase);
  const Zonotope& set = problem.robot.actuation;
  const auto thrusters = static_cast<Eigen::Index>(problem.robot.thrusters.size());
  Random random(1);
  int seen = 0;
  for (int sample = 0; sample < 400; ++sample) {
    const ValuedPosture* const at = source.draw(random);
    if (at == nullptr) continue;
    ++seen;
    const Eigen::VectorXd& u = source.capability().u;
    const Eigen::Vector3d force = set.B.topLeftCorner(3, thrusters) * u.head(thrusters);
    const Eigen::VectorXd efforts = set.B * u;
    const auto value_of = [&](const Form& form) {
      return BoxForms::at_point(model.shape(), FormRow(form, model.far()), at->x).low;
    };
    for (Eigen::Index i = 3; i < efforts.size(); ++i) {
      const auto row = static_cast<std::size_t>(i);
      double load = value_of(rows.tau[row]) + at->value * value_of(rows.a[row]);
      for (Eigen::Index k = 0; k < 3; ++k) {
        load += value_of(rows.levers[row][static_cast<std::size_t>(k)]) * force[k];
      }
      EXPECT_NEAR(load, efforts[i], 1e-7 * (1 + std::abs(at->value))) << i;
    }
  }
  EXPECT_GT(seen, 5);
}

/// The bounds of other measures, of any wrenches and of lists know no force of a second contact
/// without shares, so a certificate that claims one of these is no proof.
TEST(BracedProof, IsTheOnlyOneWithoutSharesOfForces) {
  Problem problem = pushing_and_turning();
  const FormModel model(problem);
  const Equations equations(problem, model);
  const auto make = [&](const char* measure, Wrench wrench) {
    return make_value_proof(problem, model, equations, measure, wrench);
  };
  EXPECT_NO_THROW(make("linf_polytope", Wrench::kPure));
  EXPECT_THROW(make("linf_polytope", Wrench::kAny), std::invalid_argument);
  EXPECT_THROW(make("l2_polytope", Wrench::kPure), std::invalid_argument);
  Problem limited = problem;
  limited.contact->w_max[1] = 100;  // no longer any force
  const FormModel other(limited);
  const Equations same(limited, other);
  EXPECT_THROW(make_value_proof(limited, other, same, "linf_polytope", Wrench::kPure),
               std::invalid_argument);
  EXPECT_THROW(make("ellipsoid", Wrench::kPure), std::invalid_argument);
  problem.scenarios.wrenches = {{"one", problem.c}, {"other", -problem.c}};
  EXPECT_THROW(make("linf_polytope", Wrench::kPure), std::invalid_argument);
}

/// No multiplier puts a posture's value above what it proves of a box about the posture.
TEST(BracedProof, NoPostureIsAbove) {
  const Problem problem = pushing_and_turning();
  const FormModel model(problem);
  const Equations equations(problem, model);
  const auto proof = make_braced_proof(problem, model, equations);
  const auto bound = make_capability_bound(problem, "linf_polytope", Wrench::kPure);
  ASSERT_EQ(proof->width(), problem.robot.velocities() + equations.count());
  PostureSource source(problem, "linf_polytope", ContactForces::kOfBase);
  Random random(2);
  int seen = 0, useful = 0;
  for (int sample = 0; sample < samples(600); ++sample) {
    const ValuedPosture* const at = source.draw(random);
    if (at == nullptr) continue;
    ++seen;
    const double size = std::pow(10, -random.uniform(1, 4));
    const Eigen::VectorXd lower = at->x.array() - size, upper = at->x.array() + size;
    const double low = at->value * (1 - 1e-6), high = 2 * at->value + 1;
    BoxProof found;
    bound->evaluate(lower, upper, low, high, found);
    if (found.multiplier.size() != proof->width()) continue;
    for (const double by : {1.0, 0.9, -1.0}) {
      const Eigen::VectorXd multiplier = by * found.multiplier;
      const double most = proof->most(lower, upper, multiplier.data(), 1, low, high);
      EXPECT_GE(std::max(low, most), at->value * (1 - 1e-8));
      // The other code's margins for rounding are wider than intervals.
      if (by == 1) EXPECT_LE(most, std::max(low, found.high) * (1 + 1e-9) + 1e-9);
      useful += by == 1 && most < 1.01 * at->value ? 1 : 0;
    }
  }
  EXPECT_GT(seen, samples(600) / 100);
  EXPECT_GT(useful, 0);
}

}  // namespace
}  // namespace maxwrench
