#include "lib/math/decompositions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/math/random.h"

namespace maxwrench {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// rows×cols of a rank that is at most this.
MatrixXd of_rank(Random& random, int rows, int cols, int rank) {
  const auto noise = [&](Eigen::Index, Eigen::Index) { return random.normal(); };
  if (rank >= std::min(rows, cols)) return MatrixXd::NullaryExpr(rows, cols, noise);
  const MatrixXd left = MatrixXd::NullaryExpr(rows, rank, noise);
  return left * MatrixXd::NullaryExpr(rank, cols, noise);
}

/// Calls `check(A, rank)` for every shape up to 6×6, of full rank and of lower rank.
template <class Check>
void at_every_shape(Check&& check) {
  Random random(61);
  for (int rows = 1; rows <= 6; ++rows) {
    for (int cols = 1; cols <= 6; ++cols) {
      const int full = std::min(rows, cols);
      for (const int rank : {full, std::max(1, full - 2)}) {
        check(random, of_rank(random, rows, cols, rank), rank);
      }
    }
  }
}

/// The four conditions of Penrose.
TEST(Decompositions, PseudoInverse) {
  at_every_shape([](Random&, const MatrixXd& A, int) {
    const MatrixXd X = pseudo_inverse(A);
    const double scale = 1e-12 * (1 + X.norm()) * (1 + X.norm());
    EXPECT_LT((A * X * A - A).norm(), scale);
    EXPECT_LT((X * A * X - X).norm(), scale);
    EXPECT_LT((A * X - (A * X).transpose()).norm(), scale);
    EXPECT_LT((X * A - (X * A).transpose()).norm(), scale);
  });
}

TEST(Decompositions, LeastSquaresIsThePseudoInverse) {
  at_every_shape([](Random& random, const MatrixXd& A, int rank) {
    const MatrixXd X = pseudo_inverse(A);
    const VectorXd b = of_rank(random, static_cast<int>(A.rows()), 1, 1);
    const VectorXd c = of_rank(random, static_cast<int>(A.cols()), 1, 1);
    const LeastSquares6 qr(A);
    const double scale = 1e-12 * (1 + X.norm()) * (1 + X.norm());
    EXPECT_LT((qr.solve(b) - X * b).norm(), scale);
    EXPECT_LT((qr.solve_transposed(c) - X.transpose() * c).norm(), scale);
    EXPECT_EQ(qr.is_singular(1e-12), rank < std::min(A.rows(), A.cols()));
  });
}

/// It minimises |A x - b|^2 + damping |x|^2.
TEST(Decompositions, DampedStepHasNoSlope) {
  at_every_shape([](Random& random, const MatrixXd& A, int) {
    const VectorXd b = of_rank(random, static_cast<int>(A.rows()), 1, 1);
    const VectorXd x = damped_step(A, b, 0.01);
    EXPECT_LT((A.transpose() * (A * x - b) + 0.01 * x).norm(), 1e-12 * (1 + A.squaredNorm()));
  });
}

TEST(Decompositions, SplitIsOrthonormalAndSpansTheColumns) {
  at_every_shape([](Random&, const MatrixXd& A, int rank) {
    const auto [range, complement] = split(A, 1e-10);
    EXPECT_EQ(range.cols(), rank);
    MatrixXd Q(A.rows(), A.rows());
    Q << range, complement;
    EXPECT_LT((Q.transpose() * Q - MatrixXd::Identity(A.rows(), A.rows())).norm(), 1e-13);
    EXPECT_LT((complement.transpose() * A).norm(), 1e-13 * (1 + A.norm()));
  });
  EXPECT_EQ(split(MatrixXd(3, 0)).complement, MatrixXd::Identity(3, 3));
  EXPECT_EQ(split(MatrixXd::Zero(3, 2)).range.cols(), 0);
}

TEST(Decompositions, SingularValuesAreTheRootsOfTheGramsEigenvalues) {
  at_every_shape([](Random&, const MatrixXd& A, int) {
    const SymmetricEigen gram = symmetric_eigen(A * A.transpose());
    EXPECT_LT((gram.V * gram.values.asDiagonal() * gram.V.transpose() - A * A.transpose()).norm(),
              1e-13 * (1 + A.squaredNorm()));
    const VectorXd sigma = singular_values(A);
    for (Eigen::Index i = 0; i < sigma.size(); ++i) {
      EXPECT_NEAR(sigma[i] * sigma[i], gram.values[A.rows() - 1 - i],
                  1e-12 * (1 + A.squaredNorm()));
    }
  });
}

TEST(Decompositions, SvdIsOrthogonalAndMultipliesToTheMatrix) {
  at_every_shape([](Random&, const MatrixXd& A, int rank) {
    const Svd parts = svd(A);
    EXPECT_EQ(parts.rank(1e-10), rank);
    MatrixXd S = MatrixXd::Zero(A.rows(), A.cols());
    S.diagonal() = parts.values;
    EXPECT_LT((parts.U * S * parts.V.transpose() - A).norm(), 1e-13 * (1 + A.norm()));
    for (const MatrixXd& Q : {parts.U, parts.V}) {
      EXPECT_LT((Q.transpose() * Q - MatrixXd::Identity(Q.rows(), Q.rows())).norm(), 1e-13);
    }
  });
  EXPECT_EQ(svd(MatrixXd::Zero(3, 2)).rank(1e-10), 0);
}

}  // namespace
}  // namespace maxwrench
