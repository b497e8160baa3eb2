#include "verify/equations.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/loops.h"
#include "tests/support/support.h"
#include "verify/model.h"

namespace maxwrench {
namespace {

class EquationsOf : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Problems, EquationsOf,
                         testing::ValuesIn(kLoopProblems.begin(),
                                           kLoopProblems.end() - kLoopProblemsWithForces),
                         loop_name);

/// The list of tests is made in each of their processes, so it looks at names alone.
TEST(LoopProblems, AreAllWithoutContactForces) {
  for (auto name = kLoopProblems.begin(); name != kLoopProblems.end(); ++name) {
    const bool forces = kLoopProblems.end() - name <= kLoopProblemsWithForces;
    EXPECT_EQ(loop_problem(*name).contact_columns() > 0, forces) << *name;
  }
}

/// What rounding of the project's kinematics, which have constants in double, may do.
constexpr double kRounding = 1e-13;

Eigen::VectorXd random_x(const LoopCoordinates& coordinates, Random& random) {
  Eigen::VectorXd x = coordinates.lower;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    x[i] = random.uniform(coordinates.lower[i], coordinates.upper[i]);
  }
  return x;
}

TEST_P(EquationsOf, HaveTheCoordinatesOfTheBound) {
  const Problem problem = loop_problem(GetParam());
  const LoopCoordinates expected(problem);
  const PostureCoordinates coordinates(problem);
  ASSERT_EQ(coordinates.count(), expected.chain.count());
  for (int i = 0; i < coordinates.count(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    EXPECT_EQ(coordinates.variables[at].coordinate, expected.chain.index[at]);
    EXPECT_EQ(coordinates.variables[at].turns, expected.chain.turns[at] != 0);
  }
}

/// At any x, also where the equations do not hold, the loads are those of other code.
TEST_P(EquationsOf, LoadsAreThoseOfTheBoundAnywhere) {
  const Problem problem = loop_problem(GetParam());
  const LoopCoordinates coordinates(problem);
  LoopPosture exact(problem, coordinates);
  const FormModel model(problem);
  const std::vector<Form> tau_d = model.tau_d(), a = model.exerted(problem.c);
  Random random(1);
  for (int sample = 0; sample < 10; ++sample) {
    const Eigen::VectorXd x = random_x(coordinates, random);
    exact.set(x.cast<Extended>());
    const Eigen::VectorXd loads = exact.loads().cast<double>();
    for (std::size_t i = 0; i < tau_d.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      const auto value = [&](const Form& form) {
        return BoxForms::at_point(model.shape(), FormRow(form, model.far()), x);
      };
      const Narrow tau = value(tau_d[i]), own = value(a[i]);
      const double size = 1 + std::abs(loads[row]);
      EXPECT_NEAR(tau.low, loads[row], kRounding * size * 1e2) << i;
      EXPECT_NEAR(own.high, loads[problem.robot.velocities() + row], kRounding * 1e2) << i;
      EXPECT_LT(tau.high - tau.low, 1e-11 * size);
    }
  }
}

/// The rows of the equations as other code has them, which the multipliers are for.
ExtendedVector rows_at(const Problem& problem, const LoopPosture& at, int middle) {
  std::vector<Extended> rows;
  const auto add = [&](const ExtendedVector& left, const ExtendedVector& right) {
    for (Eigen::Index i = 0; i < left.size(); ++i) rows.push_back(left[i] - right[i]);
  };
  if (!PostureCoordinates(problem).base_is_dependent) add(at.left(middle), at.right(middle));
  if (problem.contact) add(at.touching(), at.touched());
  return Eigen::Map<const ExtendedVector>(rows.data(), static_cast<Eigen::Index>(rows.size()));
}

int middle_of(const LoopCoordinates& at) {
  return std::clamp((at.yaw.from + at.free.to) / 2 - at.first.from, 0, at.first.count());
}

TEST_P(EquationsOf, AreThoseOfTheBoundAnywhere) {
  const Problem problem = loop_problem(GetParam());
  const LoopCoordinates coordinates(problem);
  LoopPosture exact(problem, coordinates);
  const FormModel model(problem);
  const Equations equations(problem, model);
  EquationsOverBox points(equations);
  Random random(2);
  for (int sample = 0; sample < 10; ++sample) {
    const Eigen::VectorXd x = random_x(coordinates, random);
    exact.set(x.cast<Extended>());
    const ExtendedVector f = rows_at(problem, exact, middle_of(coordinates));
    ASSERT_EQ(f.size(), equations.count());
    EXPECT_NEAR(equations.residual(x), static_cast<double>(f.cwiseAbs().maxCoeff()), 1e-11);
    // A box of one point, of which each row's sign is known.
    ASSERT_TRUE(points.set(x, x));
    for (Eigen::Index i = 0; i < f.size(); ++i) {
      if (std::abs(f[i]) < 1e-9L) continue;
      Eigen::VectorXd nu = Eigen::VectorXd::Zero(f.size());
      nu[i] = f[i] > 0 ? 1 : -1;
      EXPECT_TRUE(points.excluded(nu.data())) << i;
      nu = -nu;
      EXPECT_FALSE(points.excluded(nu.data())) << i;
    }
  }
}

/// Whatever the multiplier, no box with a posture is excluded.
TEST_P(EquationsOf, ExcludeNoPosture) {
  const Problem problem = loop_problem(GetParam());
  PostureSource source(problem, "linf_polytope");
  const FormModel model(problem, CoordinateChoice{source.coordinates().resting.value_or(-1)});
  const Equations equations(problem, model);
  EquationsOverBox points(equations);
  Random random(3);
  int seen = 0;
  for (int sample = 0; sample < 100 && seen < std::max(6, samples(100)); ++sample) {
    const ValuedPosture* const at = source.draw(random);
    if (at == nullptr) continue;
    ++seen;
    EXPECT_LT(equations.residual(at->x), 1e-8);
    for (int i = 0; i < 20; ++i) {
      const double size = std::pow(10, -random.uniform(0, 7));
      Eigen::VectorXd lower = at->x, upper = at->x, nu(equations.count());
      for (double& each : lower) each -= 1e-8 + size * random.uniform(0, 1);
      for (double& each : upper) each += 1e-8 + size * random.uniform(0, 1);
      for (double& each : nu) each = random.normal();
      ASSERT_TRUE(points.set(lower, upper));
      EXPECT_FALSE(points.excluded(nu.data()));
    }
  }
  EXPECT_GT(seen, 5);
}

/// A rotation that is too long by a share, as rounding may make it: no joints at all fulfil the
/// equations, and along the rotation itself, where turns change nothing, they say so. What is less
/// than the rounding of numbers must not exclude the posture.
TEST(Equations, HoldUpToTheRoundingOfNumbers) {
  const auto excludes = [](double share) {
    Problem problem = loop_problem("mobile/push");
    PostureSource source(problem, "linf_polytope");
    Random random(3);
    const ValuedPosture* at = nullptr;
    while (at == nullptr) at = source.draw(random);
    LoopPosture exact(problem, source.coordinates());
    exact.set(at->x.cast<Extended>());
    const auto tip = static_cast<std::size_t>(problem.end_effector);
    problem.robot.end_effectors[tip].placement.R *= 1 + share;
    const FormModel model(problem);
    const Equations equations(problem, model);
    Eigen::VectorXd nu = Eigen::VectorXd::Zero(equations.count());
    nu.head<9>() = -exact.left(middle_of(source.coordinates())).head<9>().cast<double>();
    EquationsOverBox points(equations);
    return points.set(at->x.array() - 1e-9, at->x.array() + 1e-9) && points.excluded(nu.data());
  };
  EXPECT_FALSE(excludes(1e-14));
  EXPECT_TRUE(excludes(1e-11));
}

}  // namespace
}  // namespace maxwrench
