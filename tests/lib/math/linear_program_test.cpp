#include "maxwrench/linear_program.h"

#include <gtest/gtest.h>

#include <cmath>

namespace maxwrench {
namespace {

/// max x + y, x + y + s = 4, 0 <= x <= 3, 0 <= y <= 2, s >= 0: 4 with lambda = 1.
LinearProgram triangle() {
  LinearProgram p;
  p.A = Eigen::MatrixXd{{1, 1, 1}}.sparseView();
  p.b = Eigen::VectorXd{{4}};
  p.c = Eigen::VectorXd{{1, 1, 0}};
  p.l = Eigen::VectorXd{{0, 0, 0}};
  p.u = Eigen::VectorXd{{3, 2, kInfinity}};
  return p;
}

LpSolution optimal(Eigen::VectorXd x, Eigen::VectorXd lambda) {
  LpSolution s;
  s.status = Status::kOptimal;
  s.x = std::move(x);
  s.lambda = std::move(lambda);
  return s;
}

TEST(LinearProgram, ResidualsVanishAtAnOptimum) {
  const LpSolution s = optimal(Eigen::VectorXd{{3, 1, 0}}, Eigen::VectorXd{{1}});
  const Residual r = residuals(triangle(), s);
  EXPECT_EQ(r.balance, 0);
  EXPECT_EQ(r.bounds, 0);
  EXPECT_EQ(r.dual, 0);
  EXPECT_EQ(r.gap, 0);
  EXPECT_TRUE(verified(triangle(), s));
}

TEST(LinearProgram, EachResidualSeesItsOwnError) {
  // Row: 3 + 2 - 4 = 1, over 1 + 4.
  EXPECT_DOUBLE_EQ(
      residuals(triangle(), optimal(Eigen::VectorXd{{3, 2, 0}}, Eigen::VectorXd{{1}})).balance,
      0.2);
  // Bound: 3.5 exceeds 3 by 0.5, over 1 + 3.5.
  EXPECT_DOUBLE_EQ(
      residuals(triangle(), optimal(Eigen::VectorXd{{3.5, 0.5, 0}}, Eigen::VectorXd{{1}})).bounds,
      0.5 / 4.5);
  // d = c - A'lambda = (2, 2, 1): the third column has no upper bound; 1 over 1 + 1.
  EXPECT_DOUBLE_EQ(
      residuals(triangle(), optimal(Eigen::VectorXd{{3, 1, 0}}, Eigen::VectorXd{{-1}})).dual, 0.5);
  // Feasible but not optimal: 2 against a bound of 4; the largest term is lambda'b = 4.
  EXPECT_DOUBLE_EQ(
      residuals(triangle(), optimal(Eigen::VectorXd{{1, 1, 2}}, Eigen::VectorXd{{1}})).gap,
      2.0 / 5);
}

TEST(LinearProgram, WrongSizesAndNaNDoNotVerify) {
  EXPECT_FALSE(verified(triangle(), optimal(Eigen::VectorXd{{3, 1}}, Eigen::VectorXd{{1}})));
  EXPECT_FALSE(verified(triangle(), optimal(Eigen::VectorXd{{3, 1, 0}}, Eigen::VectorXd{})));
  EXPECT_FALSE(verified(triangle(), optimal(Eigen::VectorXd{{3, NAN, 0}}, Eigen::VectorXd{{1}})));
  EXPECT_FALSE(verified(triangle(), optimal(Eigen::VectorXd{{3, 1, 0}}, Eigen::VectorXd{{NAN}})));
  LpSolution s = optimal(Eigen::VectorXd{{3, 1, 0}}, Eigen::VectorXd{{1}});
  s.status = Status::kBudgetExhausted;
  EXPECT_FALSE(verified(triangle(), s));
}

TEST(LinearProgram, NotANumberInTheDataIsAnInfiniteResidual) {
  const LpSolution s = optimal(Eigen::VectorXd{{3, 1, 0}}, Eigen::VectorXd{{1}});
  const auto broken = [](auto&& change) {
    LinearProgram p = triangle();
    // A second row that holds, after the one that will not.
    p.A = Eigen::MatrixXd{{1, 1, 1}, {0, 0, 1}}.sparseView();
    p.b = Eigen::VectorXd{{4, 0}};
    change(p);
    return p;
  };
  LpSolution two = s;
  two.lambda = Eigen::VectorXd{{1, 0}};
  EXPECT_TRUE(verified(broken([](auto&) {}), two));
  const auto entry = broken([](auto& p) { p.A.coeffRef(0, 0) = NAN; });
  EXPECT_EQ(residuals(entry, two).balance, kInfinity);
  EXPECT_EQ(residuals(broken([](auto& p) { p.b[0] = NAN; }), two).balance, kInfinity);
  EXPECT_EQ(residuals(broken([](auto& p) { p.l[0] = NAN; }), two).bounds, kInfinity);
  EXPECT_EQ(residuals(broken([](auto& p) { p.u[0] = NAN; }), two).bounds, kInfinity);
  EXPECT_EQ(residuals(broken([](auto& p) { p.c[0] = NAN; }), two).gap, kInfinity);
  EXPECT_FALSE(verified(entry, two));
}

TEST(LinearProgram, RoundingOfAFarkasVectorCountsWithItsBound) {
  // 0.1 x = 1, 0.2 x = 0, -0.3 x = 0: their sum is 0 x = 1 on paper, and in doubles the factor of x
  // is some 1e-17. With x up to 1e19 that may be worth hundreds, more than the margin of 1.
  LinearProgram p;
  p.A = Eigen::MatrixXd{{0.1}, {0.2}, {-0.3}}.sparseView();
  p.b = Eigen::VectorXd{{1, 0, 0}};
  p.c = p.l = Eigen::VectorXd{{0}};
  p.u = Eigen::VectorXd{{1e19}};
  LpSolution s;
  s.status = Status::kInfeasible;
  s.certificate = Eigen::VectorXd{{1, 1, 1}};
  EXPECT_FALSE(verified(p, s));
  p.u[0] = 1e9;  // worth 1e-5 at most
  EXPECT_TRUE(verified(p, s));
}

TEST(LinearProgram, ResidualsReadUncompressedMatrices) {
  LinearProgram p = triangle();
  p.A.reserve(Eigen::VectorXi::Constant(3, 4));
  p.A.coeffRef(0, 0) = 1;
  ASSERT_FALSE(p.A.isCompressed());
  EXPECT_TRUE(verified(p, optimal(Eigen::VectorXd{{3, 1, 0}}, Eigen::VectorXd{{1}})));
}

TEST(LinearProgram, FarkasVectorNeedsAMargin) {
  LinearProgram p = triangle();
  p.u[2] = 1;
  p.b[0] = 7;  // at most 3 + 2 + 1 = 6
  LpSolution s;
  s.status = Status::kInfeasible;
  s.certificate = Eigen::VectorXd{{1e-20}};  // its length does not matter
  EXPECT_TRUE(verified(p, s));
  s.certificate[0] = -1;
  EXPECT_FALSE(verified(p, s));
  s.certificate[0] = 0;
  EXPECT_FALSE(verified(p, s));
  s.certificate[0] = 1;
  p.b[0] = 6;  // feasible
  EXPECT_FALSE(verified(p, s));
  p.b[0] = 6 * (1 + 1e-14);  // only rounding apart
  EXPECT_FALSE(verified(p, s));
}

TEST(LinearProgram, FarkasVectorNeedsSignsWhereBoundsAreInfinite) {
  // 1e-9 x = 1 with x free holds at x = 1e9, though y'A looks like nothing beside y'b.
  LinearProgram p;
  p.A = Eigen::MatrixXd{{1e-9}}.sparseView();
  p.b = Eigen::VectorXd{{1}};
  p.c = Eigen::VectorXd{{0}};
  p.l = Eigen::VectorXd{{-kInfinity}};
  p.u = Eigen::VectorXd{{kInfinity}};
  LpSolution s;
  s.status = Status::kInfeasible;
  s.certificate = Eigen::VectorXd{{1}};
  EXPECT_FALSE(verified(p, s));
}

TEST(LinearProgram, CrossingBoundsProveThemselves) {
  LinearProgram p = triangle();
  p.l[1] = 2.5;
  LpSolution s;
  s.status = Status::kInfeasible;
  s.certificate = Eigen::VectorXd::Zero(1);
  EXPECT_TRUE(verified(p, s));
  EXPECT_FALSE(verified(p, optimal(Eigen::VectorXd{{3, 1, 0}}, Eigen::VectorXd{{1}})));
}

TEST(LinearProgram, RayNeedsAFeasiblePointAndRoom) {
  // max x, x - y = 0, x >= 0, y free.
  LinearProgram p;
  p.A = Eigen::MatrixXd{{1, -1}}.sparseView();
  p.b = Eigen::VectorXd{{0}};
  p.c = Eigen::VectorXd{{1, 0}};
  p.l = Eigen::VectorXd{{0, -kInfinity}};
  p.u = Eigen::VectorXd{{kInfinity, kInfinity}};
  LpSolution s;
  s.status = Status::kUnbounded;
  s.x = Eigen::VectorXd{{1, 1}};
  s.certificate = Eigen::VectorXd{{2, 2}};
  EXPECT_TRUE(verified(p, s));
  s.certificate = Eigen::VectorXd{{2, 1}};  // A r != 0
  EXPECT_FALSE(verified(p, s));
  s.certificate = Eigen::VectorXd{{-1, -1}};  // leaves x >= 0, and loses
  EXPECT_FALSE(verified(p, s));
  s.certificate = Eigen::VectorXd{{2, 2}};
  s.x = Eigen::VectorXd{{-1, -1}};  // infeasible
  EXPECT_FALSE(verified(p, s));
  s.x = Eigen::VectorXd{{1, 1}};
  p.u[1] = 9;  // the ray hits a bound
  EXPECT_FALSE(verified(p, s));
}

TEST(LinearProgram, ValidateNamesWhatIsWrong) {
  EXPECT_NO_THROW(validate(triangle()));
  const auto broken = [](auto&& change) {
    LinearProgram p = triangle();
    change(p);
    return p;
  };
  EXPECT_THROW(validate(broken([](auto& p) { p.b.resize(2); })), std::invalid_argument);
  EXPECT_THROW(validate(broken([](auto& p) { p.c.resize(2); })), std::invalid_argument);
  EXPECT_THROW(validate(broken([](auto& p) { p.l[0] = NAN; })), std::invalid_argument);
  EXPECT_THROW(validate(broken([](auto& p) { p.u[0] = -kInfinity; })), std::invalid_argument);
  EXPECT_THROW(validate(broken([](auto& p) { p.c[0] = kInfinity; })), std::invalid_argument);
  EXPECT_THROW(validate(broken([](auto& p) { p.A.coeffRef(0, 1) = NAN; })), std::invalid_argument);
  EXPECT_THROW(validate(broken([](auto& p) { p.col_names = {"x"}; })), std::invalid_argument);
  EXPECT_NO_THROW(validate(broken([](auto& p) { p.l[0] = 5; })));  // crossing is a verdict
}

}  // namespace
}  // namespace maxwrench
