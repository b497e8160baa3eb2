#include "verify/wide_matrix.h"

#include <Eigen/Dense>
#include <stdexcept>

namespace maxwrench {
namespace {

/// Infinity for NaN.
long double largest_row_sum(const WideRows& M) {
  long double most = 0;
  for (const std::vector<Wide>& row : M) {
    Wide sum;
    for (const Wide& x : row) sum += Wide(x.magnitude());
    if (!(sum.high < kInfinity)) return kInfinity;
    most = std::max(most, sum.high);
  }
  return most;
}

}  // namespace

WideRows to_wide(const Eigen::MatrixXd& M) {
  WideRows rows(static_cast<std::size_t>(M.rows()));
  for (Eigen::Index i = 0; i < M.rows(); ++i) {
    for (const double x : M.row(i)) rows[static_cast<std::size_t>(i)].emplace_back(x);
  }
  return rows;
}

WideRows transposed(const WideRows& M) {
  WideRows T(M.front().size(), std::vector<Wide>(M.size()));
  for (std::size_t i = 0; i < M.size(); ++i) {
    for (std::size_t j = 0; j < T.size(); ++j) T[j][i] = M[i][j];
  }
  return T;
}

WideRows operator*(const WideRows& a, const WideRows& b) {
  WideRows product(a.size(), std::vector<Wide>(b.front().size()));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < b.size(); ++k) {
      if (a[i][k].is_zero()) continue;
      for (std::size_t j = 0; j < b.front().size(); ++j) product[i][j] += a[i][k] * b[k][j];
    }
  }
  return product;
}

/// For any X and E = 1 - X M, M^-1 = X + E X + (1 - E)^-1 E E X. In the norm of row sums with e =
/// |E| < 1 the last term, and so each of its entries, is at most e^2/(1 - e) |X|.
WideRows enclose_inverse(const WideRows& M) {
  const auto n = static_cast<Eigen::Index>(M.size());
  MatrixX<long double> middle(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const Wide& x = M[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
      middle(i, j) = (x.low + x.high) / 2;
    }
  }
  const MatrixX<long double> one = MatrixX<long double>::Identity(n, n);
  const WideRows X = to_wide(MatrixX<long double>(middle.ldlt().solve(one)).cast<double>());
  WideRows E = X * M;
  for (std::size_t i = 0; i < E.size(); ++i) {
    for (std::size_t j = 0; j < E.size(); ++j) E[i][j] = Wide(i == j ? 1.0L : 0.0L) - E[i][j];
  }
  const Wide e(largest_row_sum(E));
  if (!(e.high < 0.5L)) {
    throw std::invalid_argument("measure: expected linf_polytope: B is nearly rank-deficient");
  }
  const long double rest = (e * e / (Wide(1.0L) - e) * Wide(largest_row_sum(X))).high;
  WideRows inverse = E * X;
  for (std::size_t i = 0; i < E.size(); ++i) {
    for (std::size_t j = 0; j < E.size(); ++j) inverse[i][j] += X[i][j] + Wide(-rest, rest);
  }
  return inverse;
}

WideRows enclose_pseudoinverse(const Eigen::MatrixXd& B) {
  const WideRows wide = to_wide(B), across = transposed(wide);
  return across * enclose_inverse(wide * across);
}

}  // namespace maxwrench
