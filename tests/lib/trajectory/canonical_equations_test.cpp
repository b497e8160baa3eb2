#include "lib/trajectory/canonical_equations.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "lib/math/random.h"
#include "maxwrench/load.h"
#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

constexpr const char* kLift = MAXWRENCH_SOURCE_DIR "/examples/tasks/two_link/lift.toml";
constexpr double kCanonicalStep = 1e-6;

/// A random point of the state space, often beyond the limits of speeds, at which some efforts are
/// at their limits and others are not.
Eigen::VectorXd random_state(Random& random) {
  Eigen::VectorXd z(9);
  z << random.uniform(-1, 1), random.uniform(-2, 2), random.uniform(-5, 5), random.uniform(-6, 6),
      random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-0.05, 0.05),
      random.uniform(-0.02, 0.02), 0;
  return z;
}

/// Hamilton's equations: p' = -dH/dq, lambda' = -dH/dv and nu' = -dH/dm at the efforts that
/// maximise H, whose own change does not count.
TEST(CanonicalEquations, CostatesFallWithTheDerivativesOfH) {
  const Problem problem = load_problem(kLift);
  CanonicalEquations equations(problem), other(problem);
  const TransferIndex index{0.3, 2};
  equations.set_index(index);
  other.set_index(index);
  Random random(1);
  for (int sample = 0; sample < 50; ++sample) {
    const Eigen::VectorXd z = random_state(random);
    const double m = random.uniform(0, 8);
    Eigen::VectorXd rates;
    ASSERT_TRUE(equations.rates(z, m, rates));
    const Eigen::VectorXd u = equations.efforts();
    for (int i = 0; i < 4; ++i) {
      Eigen::VectorXd up = z, down = z;
      up[i] += kCanonicalStep;
      down[i] -= kCanonicalStep;
      const double slope =
          (other.hamiltonian(up, m, u) - other.hamiltonian(down, m, u)) / (2 * kCanonicalStep);
      EXPECT_NEAR(rates[4 + i], -slope, 1e-6 * (1 + std::abs(slope))) << sample << ' ' << i;
    }
    const double by_m = (other.hamiltonian(z, m + kCanonicalStep, u) -
                         other.hamiltonian(z, m - kCanonicalStep, u)) /
                        (2 * kCanonicalStep);
    EXPECT_NEAR(rates[8], -by_m, 1e-6 * (1 + std::abs(by_m)));
    // The states follow the derivatives of H by the costates.
    for (int i = 0; i < 4; ++i) {
      Eigen::VectorXd up = z, down = z;
      up[4 + i] += kCanonicalStep;
      down[4 + i] -= kCanonicalStep;
      const double slope =
          (other.hamiltonian(up, m, u) - other.hamiltonian(down, m, u)) / (2 * kCanonicalStep);
      EXPECT_NEAR(rates[i], slope, 1e-6 * (1 + std::abs(slope)));
    }
  }
}

TEST(CanonicalEquations, NoOtherEffortsHaveALargerH) {
  const Problem problem = load_problem(kLift);
  CanonicalEquations equations(problem);
  equations.set_index({0.3, 0});
  Random random(2);
  int at_limits = 0, inside = 0;
  for (int sample = 0; sample < 50; ++sample) {
    const Eigen::VectorXd z = random_state(random);
    Eigen::VectorXd rates;
    ASSERT_TRUE(equations.rates(z, 2, rates));
    const Eigen::Vector2d u = equations.efforts(), limits(60, 25);
    const double largest = equations.hamiltonian();
    for (int i = 0; i < 2; ++i) ++(std::abs(u[i]) < limits[i] ? inside : at_limits);
    for (int trial = 0; trial < 20; ++trial) {
      const Eigen::Vector2d another(random.uniform(-60, 60), random.uniform(-25, 25));
      EXPECT_LE(equations.hamiltonian(z, 2, another), largest + 1e-9 * (1 + std::abs(largest)));
    }
  }
  EXPECT_GT(at_limits, 5);
  EXPECT_GT(inside, 5);
}

TEST(CanonicalEquations, LinearisationEqualsCentralDifferences) {
  const Problem problem = load_problem(kLift);
  CanonicalEquations equations(problem), other(problem);
  const TransferIndex index{0.3, 2};
  equations.set_index(index);
  other.set_index(index);
  Random random(3);
  for (int sample = 0; sample < 10; ++sample) {
    const Eigen::VectorXd z = random_state(random);
    const double m = random.uniform(0, 8);
    Eigen::VectorXd rates, by_m, up, down;
    Eigen::MatrixXd by_z;
    ASSERT_TRUE(equations.linearize(z, m, rates, by_z, by_m));
    for (int i = 0; i <= 9; ++i) {
      Eigen::VectorXd more = z, less = z;
      if (i < 9) {
        more[i] += kCanonicalStep;
        less[i] -= kCanonicalStep;
      }
      ASSERT_TRUE(other.rates(more, i < 9 ? m : m + kCanonicalStep, up));
      ASSERT_TRUE(other.rates(less, i < 9 ? m : m - kCanonicalStep, down));
      const Eigen::VectorXd slope = (up - down) / (2 * kCanonicalStep);
      const Eigen::VectorXd found = i < 9 ? Eigen::VectorXd(by_z.col(i)) : by_m;
      EXPECT_LT((found - slope).norm(), 1e-5 * (1 + slope.norm())) << sample << ' ' << i;
    }
  }
}

TEST(CanonicalEquations, RejectsWhatIsNoTransferAndEffortsWithoutLimits) {
  const Problem turn = load_problem("uvms/valve_trajectory");
  EXPECT_THROW(CanonicalEquations{turn}, std::invalid_argument);
  Problem strong = load_problem(kLift);
  strong.robot.actuation.u_max[1] = kInfinity;
  EXPECT_THROW(CanonicalEquations{strong}, std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
