#include "verify/free_wrench_limits.h"

#include <gtest/gtest.h>

#include "tests/support/support.h"

namespace maxwrench {
namespace {

/// Rows near given ones, with a z that some efforts within their limits balance.
struct Balance {
  Eigen::VectorXd tau;
  Eigen::MatrixXd A;
  Eigen::VectorXd u, z;
};

/// Seven rows of a base with two coupled thrusters and five joints, and three numbers of z.
class FreeWrenchLimitsOf : public testing::Test {
 protected:
  static constexpr Eigen::Index kRows = 7, kNumbers = 3;

  void draw(double size) {
    set_.B = Eigen::MatrixXd::Identity(kRows, kRows + 1);
    set_.B(0, kRows) = 0.5;
    set_.B(1, kRows) = -0.8;
    set_.u_max = Eigen::VectorXd::NullaryExpr(kRows + 1, [&] { return random_.uniform(1, 9); });
    set_.u_min = -0.7 * set_.u_max;
    const auto uniform = [&] { return random_.uniform(-1, 1); };
    A_ = Eigen::MatrixXd::NullaryExpr(kRows, kNumbers, uniform);
    tau_ = Eigen::VectorXd::NullaryExpr(kRows, uniform);
    off_ = size *
           Eigen::MatrixXd::NullaryExpr(kRows, 1 + kNumbers, [&] { return random_.uniform(0, 1); });
  }

  /// Any efforts and the z that they balance; tau takes up what is left, if its range allows.
  bool balance(Balance& at) {
    at.A = A_ + off_.rightCols(kNumbers).cwiseProduct(Eigen::MatrixXd::NullaryExpr(
                    kRows, kNumbers, [&] { return random_.uniform(-1, 1); }));
    const Eigen::VectorXd shares = Eigen::VectorXd::NullaryExpr(kRows + 1, [&] {
      return random_.uniform(0, 1) < 0.7 ? std::round(random_.uniform(0, 1))
                                         : random_.uniform(0, 1);
    });
    at.u = set_.u_min + shares.cwiseProduct(set_.u_max - set_.u_min);
    at.z = at.A.colPivHouseholderQr().solve(set_.B * at.u - tau_);
    // Efforts move into the rows that z balances.
    at.u = set_.B.completeOrthogonalDecomposition().solve(tau_ + at.A * at.z);
    at.tau = set_.B * at.u - at.A * at.z;
    return ((at.tau - tau_).cwiseAbs() - off_.col(0)).maxCoeff() <= 1e-12 &&
           (at.u - set_.u_max).maxCoeff() <= 0 && (set_.u_min - at.u).maxCoeff() <= 0;
  }

  Random random_{11};
  Zonotope set_;
  Eigen::VectorXd tau_;
  Eigen::MatrixXd A_, off_;
};

/// No balance has larger numbers, nor is it off the law by more than its rest.
TEST_F(FreeWrenchLimitsOf, HoldForAllBalances) {
  int found = 0, seen = 0;
  double nearest = 0;
  for (int i = 0; i < 400; ++i) {
    draw(std::pow(10, random_.uniform(-4, -0.5)));
    const FreeWrenchLimits limits(set_, tau_, A_, off_);
    const Eigen::VectorXd Z = limits.find(kInfinity);
    if (Z.size() == 0) continue;
    ++found;
    const Eigen::VectorXd lambda =
        Eigen::VectorXd::NullaryExpr(kRows, [&] { return random_.uniform(-1, 1); });
    const FreeWrenchLimits::Law law = limits.law(lambda, Z);
    for (int j = 0; j < 20; ++j) {
      Balance at;
      if (!balance(at)) continue;
      ++seen;
      EXPECT_LE((at.z.cwiseAbs() - Z).maxCoeff(), 1e-9);
      const Eigen::VectorXd rho = at.z.tail(kNumbers - 1) - (law.M * at.u - law.p);
      EXPECT_LE((rho.cwiseAbs() - law.R).maxCoeff(), 1e-9);
      nearest = std::max(nearest, rho.cwiseAbs().cwiseQuotient(law.R).maxCoeff());
    }
  }
  EXPECT_GT(found, 50);
  EXPECT_GT(seen, 500);
  EXPECT_GT(nearest, 0.02);
}

/// A limit of t helps where the balance alone limits nothing.
TEST_F(FreeWrenchLimitsOf, TakeAKnownLimitOfTheValue) {
  draw(1e-6);
  A_.col(0) *= 1e-3;  // it may be zero, so that nothing limits t
  off_.col(1).setConstant(1e-2);
  const FreeWrenchLimits limits(set_, tau_, A_, off_);
  EXPECT_EQ(limits.find(kInfinity).size(), 0);
  const Eigen::VectorXd Z = limits.find(3);
  ASSERT_EQ(Z.size(), kNumbers);
  EXPECT_EQ(Z[0], 3);
  EXPECT_GT(Z[1], 0);
}

/// Two components of one direction.
TEST_F(FreeWrenchLimitsOf, AreNoneWhereTheColumnsLoseRank) {
  draw(1e-6);
  A_.col(2) = A_.col(1);
  EXPECT_EQ(FreeWrenchLimits(set_, tau_, A_, off_).find(3).size(), 0);
}

}  // namespace
}  // namespace maxwrench
