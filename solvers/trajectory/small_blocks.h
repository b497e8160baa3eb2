#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/math/simd_pack.h"
#include "solvers/trajectory/blocks.h"

// Algebra on the blocks of stages. Their size D is a compile-time number or Eigen::Dynamic.

namespace maxwrench {

template <int D>
using StageBlock = Eigen::Map<Eigen::Matrix<double, D, D>>;
template <int D>
using ConstStageBlock = Eigen::Map<const Eigen::Matrix<double, D, D>>;

template <int D>
using StageColumn = Eigen::Map<Eigen::Matrix<double, D, 1>>;
template <int D>
using ConstStageColumn = Eigen::Map<const Eigen::Matrix<double, D, 1>>;

/// The numbers of a stage in a long column. If their count is a compile-time constant, they are in
/// registers until `store`.
template <int D>
class StageVector {
 public:
  StageVector(const double* at, int) : StageVector(at, Places()) {}
  void store(double* at) const { store(at, Places()); }
  double& operator[](Eigen::Index r) { return values_[r]; }
  double operator[](Eigen::Index r) const { return values_[r]; }
  static constexpr int size() { return D; }

 private:
  // One by one, because a block copy goes through memory.
  using Places = std::make_index_sequence<D>;
  template <std::size_t... r>
  StageVector(const double* at, std::index_sequence<r...>) : values_{at[r]...} {}
  template <std::size_t... r>
  void store(double* at, std::index_sequence<r...>) const {
    ((at[r] = values_[r]), ...);
  }
  double values_[D];
};
template <>
class StageVector<Eigen::Dynamic> {
 public:
  StageVector(double* at, int d) : values_(at), size_(d) {}
  void store(double*) const {}
  double& operator[](Eigen::Index r) { return values_[r]; }
  double operator[](Eigen::Index r) const { return values_[r]; }
  int size() const { return size_; }

 private:
  double* values_;
  int size_;
};

/// out -= S x and x -= S'in with S of Rows (or `rows`) rows.
template <int Rows, class X>
EIGEN_STRONG_INLINE void subtract_product(const double* S, int rows, const X& x, double* out) {
  Eigen::Map<Eigen::Matrix<double, Rows, 1>> to(out, rows);
  for (int c = 0; c < x.size(); ++c) {
    to -= x[c] * Eigen::Map<const Eigen::Matrix<double, Rows, 1>>(S + c * rows, rows);
  }
}
template <int Rows, class X>
EIGEN_STRONG_INLINE void subtract_transposed(const double* S, int rows, const double* in, X& x) {
  const Eigen::Map<const Eigen::Matrix<double, Rows, 1>> from(in, rows);
  for (int c = 0; c < x.size(); ++c) {
    x[c] -= from.dot(Eigen::Map<const Eigen::Matrix<double, Rows, 1>>(S + c * rows, rows));
  }
}

/// The R×C block at (r, c) of sign A' diag(weight) B. The columns of A, B and out have lengths `a`,
/// `b` and `d`.
template <int R, int C>
EIGEN_STRONG_INLINE void product_block(const double* A, Eigen::Index a, const double* B,
                                       Eigen::Index b, const double* weight, Eigen::Index count,
                                       double sign, double* out, Eigen::Index d) {
  PackSum<2> sums[R][C];
  for_packs<2>(count, [&]<int L>(Eigen::Index i) {
    const auto w = pack<L>(weight + i);
    for (int c = 0; c < C; ++c) {
      const SimdPack<L> weighted = w * pack<L>(B + c * b + i);
      for (int r = 0; r < R; ++r) sums[r][c].add(pack<L>(A + r * a + i) * weighted);
    }
  });
  for (int c = 0; c < C; ++c) {
    for (int r = 0; r < R; ++r) out[c * d + r] = sign * sums[r][c].value();
  }
}

/// out = sign A' diag(weight) B; if A = B, only blocks that reach the lower triangle. One block at
/// a time, because all blocks together need more sums than there are registers.
template <int D>
void product(const double* A, Eigen::Index a, const double* B, Eigen::Index b, const double* weight,
             Eigen::Index count, double sign, double* out) {
  constexpr int R = D % 4 == 0 ? 4 : D, C = D % 2 == 0 ? 2 : D;
  for (int c = 0; c < D; c += C) {
    for (int r = A == B ? c / R * R : 0; r < D; r += R) {
      product_block<R, C>(A + r * a, a, B + c * b, b, weight, count, sign, out + c * D + r, D);
    }
  }
}

/// Replaces the lower triangle of A by L with A = L L', with the inverse of L's diagonal on the
/// diagonal. A pivot below the share `least` of its diagonal counts as zero; its inverse becomes
/// zero.
template <class Matrix>
EIGEN_STRONG_INLINE void cholesky(Matrix& A, double least) {
  const Eigen::Index d = A.rows();
  for (Eigen::Index c = 0; c < d; ++c) {
    const double diagonal = A(c, c);
    double pivot = diagonal;
    for (Eigen::Index l = 0; l < c; ++l) pivot -= A(c, l) * A(c, l);
    const double inverse = pivot > least * diagonal ? 1 / std::sqrt(pivot) : 0;
    A(c, c) = inverse;
    for (Eigen::Index r = c + 1; r < d; ++r) {
      double sum = A(r, c);
      for (Eigen::Index l = 0; l < c; ++l) sum -= A(r, l) * A(c, l);
      A(r, c) = sum * inverse;
    }
  }
}

/// x = L^-1 x and x = L^-T x.
template <class Matrix, class Vector>
EIGEN_STRONG_INLINE void solve_lower(const Matrix& L, Vector&& x) {
  for (Eigen::Index c = 0; c < L.rows(); ++c) {
    x[c] *= L(c, c);
    for (Eigen::Index r = c + 1; r < L.rows(); ++r) x[r] -= L(r, c) * x[c];
  }
}
template <class Matrix, class Vector>
EIGEN_STRONG_INLINE void solve_upper(const Matrix& L, Vector&& x) {
  for (Eigen::Index c = L.rows() - 1; c >= 0; --c) {
    for (Eigen::Index r = c + 1; r < L.rows(); ++r) x[c] -= L(r, c) * x[r];
    x[c] *= L(c, c);
  }
}

/// phi = F x of a stage, and x += F'g.
template <int d>
EIGEN_STRONG_INLINE void map_stage(const Eigen::Map<const Eigen::MatrixXd>& F, const double* x,
                                   double* phi) {
  const Eigen::Index count = F.rows();
  if constexpr (d == Eigen::Dynamic) {
    Eigen::Map<Eigen::VectorXd>(phi, count) =
        F.lazyProduct(Eigen::Map<const Eigen::VectorXd>(x, F.cols()));
  } else {
    const double* const data = F.data();
    for_packs<2>(count, [&]<int L>(Eigen::Index i) {
      SimdPack<L> sum = pack<L>(data + i) * x[0];
      for (int c = 1; c < d; ++c) sum += pack<L>(data + c * count + i) * x[c];
      pack<L>(phi + i) = sum;
    });
  }
}
template <int d>
EIGEN_STRONG_INLINE void add_transposed_stage(const Eigen::Map<const Eigen::MatrixXd>& F,
                                              const double* g, double* x) {
  const Eigen::Index count = F.rows();
  if constexpr (d == Eigen::Dynamic) {
    Eigen::Map<Eigen::VectorXd>(x, F.cols()) +=
        F.transpose().lazyProduct(Eigen::Map<const Eigen::VectorXd>(g, count));
  } else {
    PackSum<2> sums[d];
    const double* const data = F.data();
    for_packs<2>(count, [&]<int L>(Eigen::Index i) {
      const SimdPack<L> g_i = pack<L>(g + i);
      for (int c = 0; c < d; ++c) sums[c].add(pack<L>(data + c * count + i) * g_i);
    });
    for (int c = 0; c < d; ++c) x[c] += sums[c].value();
  }
}

}  // namespace maxwrench
