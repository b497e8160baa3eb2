#pragma once

#include <algorithm>
#include <array>

#include "maxwrench/types.h"
#include "verify/interval.h"

namespace maxwrench {

/// Taylor coefficients y^(k)(t)/k!, k = 0 .. N, of a function y of time. Each interval contains the
/// coefficient at every t of some interval of time, which may be a single instant.
template <int N>
struct Jet {
  static_assert(N >= 0);
  std::array<Narrow, N + 1> c = {};

  Jet() = default;
  Jet(const Narrow& constant) { c[0] = constant; }  // NOLINT: a number is a constant function
  Jet(double constant) { c[0] = constant; }         // NOLINT
};

namespace jets {
template <class Function>
constexpr void up_to(int last, Function&& at) {
  for (int k = 0; k <= last; ++k) at(static_cast<std::size_t>(k));
}
}  // namespace jets

/// The first coefficients of a jet of higher order.
template <int N, int M>
Jet<N> shortened(const Jet<M>& x) {
  static_assert(N <= M);
  Jet<N> y;
  std::copy_n(x.c.begin(), N + 1, y.c.begin());
  return y;
}

template <int N>
Jet<N - 1> derivative(const Jet<N>& x) {
  Jet<N - 1> y;
  jets::up_to(N - 1, [&](std::size_t k) { y.c[k] = static_cast<double>(k + 1) * x.c[k + 1]; });
  return y;
}

template <int N>
Jet<N> operator-(Jet<N> x) {
  for (Narrow& c : x.c) c = -c;
  return x;
}
template <int N>
Jet<N> operator+(Jet<N> x, const Jet<N>& y) {
  jets::up_to(N, [&](std::size_t k) {
    if (!y.c[k].is_zero()) x.c[k] = x.c[k].is_zero() ? y.c[k] : x.c[k] + y.c[k];
  });
  return x;
}
template <int N>
Jet<N> operator-(const Jet<N>& x, const Jet<N>& y) {
  return x + -y;
}

/// Cauchy's product. Coefficients that are exactly zero cost nothing and widen nothing.
template <int N>
Jet<N> operator*(const Jet<N>& x, const Jet<N>& y) {
  Jet<N> product;
  jets::up_to(N, [&](std::size_t i) {
    if (x.c[i].is_zero()) return;
    for (std::size_t j = 0; i + j <= N; ++j) {
      if (y.c[j].is_zero()) continue;
      const Narrow term = x.c[i] * y.c[j];
      Narrow& sum = product.c[i + j];
      sum = sum.is_zero() ? term : sum + term;
    }
  });
  return product;
}
template <int N>
Jet<N> operator*(const Narrow& a, Jet<N> x) {
  for (Narrow& c : x.c) {
    if (!c.is_zero()) c = a.is_zero() ? Narrow() : a * c;
  }
  return x;
}

/// cos x and sin x for all x of an interval.
CosSin<double> enclose(const Narrow& x);

/// The cosine and the sine of a jet: k s_k = sum_j j x_j c_(k-j), k c_k = -sum_j j x_j s_(k-j).
template <int N>
std::array<Jet<N>, 2> cos_sin(const Jet<N>& x) {
  const CosSin<double> at = enclose(x.c[0]);
  Jet<N> c(at.c), s(at.s);
  for (std::size_t k = 1; k <= N; ++k) {
    Narrow sum_s, sum_c;
    for (std::size_t j = 1; j <= k; ++j) {
      if (x.c[j].is_zero()) continue;
      const Narrow rate = static_cast<double>(j) * x.c[j];
      sum_s += rate * c.c[k - j];
      sum_c += rate * s.c[k - j];
    }
    const Narrow share = Narrow(1.0) / Narrow(static_cast<double>(k));
    if (!sum_s.is_zero()) s.c[k] = share * sum_s;
    if (!sum_c.is_zero()) c.c[k] = -(share * sum_c);
  }
  return {c, s};
}

/// |x| x, whose second derivative jumps where x changes its sign but is bounded: up to order two,
/// |x| x, 2 |x| x_1 and 2 |x| x_2 + sgn(x) x_1^2. sgn is all of [-1, 1] where x changes its sign.
template <int N>
Jet<N> signed_square(const Jet<N>& x) {
  static_assert(N <= 2);
  const Narrow& at = x.c[0];
  const double least = at.low > 0 ? at.low : at.high < 0 ? -at.high : 0;
  const Narrow size(least, at.magnitude());
  Jet<N> y(
      Narrow(Narrow::below(at.low * std::abs(at.low)), Narrow::above(at.high * std::abs(at.high))));
  const Narrow twice = 2.0 * size;
  if constexpr (N >= 1) y.c[1] = twice * x.c[1];
  if constexpr (N >= 2) {
    const double far = x.c[1].magnitude();
    const double near = x.c[1].low > 0 ? x.c[1].low : x.c[1].high < 0 ? -x.c[1].high : 0;
    const Narrow square(std::max(0.0, Narrow::below(near * near)), Narrow::above(far * far));
    const Narrow sign(at.low > 0 ? 1 : -1, at.high < 0 ? -1 : 1);
    y.c[2] = twice * x.c[2] + sign * square;
  }
  return y;
}

template <int N>
using JetVector = std::array<Jet<N>, 3>;
template <int N>
using JetMatrix = std::array<JetVector<N>, 3>;  ///< rows

template <int N>
JetVector<N> constant_jets(const Eigen::Vector3d& x) {
  return {Jet<N>(x[0]), Jet<N>(x[1]), Jet<N>(x[2])};
}
template <int N>
JetMatrix<N> constant_jets(const Eigen::Matrix3d& R) {
  JetMatrix<N> M;
  for (std::size_t i = 0; i < 3; ++i) {
    M[i] = constant_jets<N>(Eigen::Vector3d(R.row(static_cast<Eigen::Index>(i)).transpose()));
  }
  return M;
}

template <int N>
JetVector<N> operator+(const JetVector<N>& a, const JetVector<N>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <int N>
JetVector<N> operator-(const JetVector<N>& a, const JetVector<N>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <int N>
JetVector<N> operator*(const Jet<N>& a, const JetVector<N>& b) {
  return {a * b[0], a * b[1], a * b[2]};
}
template <int N>
Jet<N> dot(const JetVector<N>& a, const JetVector<N>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <int N>
JetVector<N> cross(const JetVector<N>& a, const JetVector<N>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <int N>
JetVector<N> operator*(const JetMatrix<N>& M, const JetVector<N>& x) {
  return {dot(M[0], x), dot(M[1], x), dot(M[2], x)};
}
template <int N>
JetMatrix<N> transposed(const JetMatrix<N>& M) {
  JetMatrix<N> T;
  for (std::size_t i = 0; i < 3; ++i) T[i] = {M[0][i], M[1][i], M[2][i]};
  return T;
}
template <int N>
JetMatrix<N> operator*(const JetMatrix<N>& a, const JetMatrix<N>& b) {
  const JetMatrix<N> across = transposed(b);
  JetMatrix<N> product;
  for (std::size_t i = 0; i < 3; ++i) product[i] = across * a[i];
  return product;
}
template <int N, int M>
JetVector<N> shortened(const JetVector<M>& x) {
  return {shortened<N>(x[0]), shortened<N>(x[1]), shortened<N>(x[2])};
}
template <int N, int M>
JetMatrix<N> shortened(const JetMatrix<M>& x) {
  return {shortened<N>(x[0]), shortened<N>(x[1]), shortened<N>(x[2])};
}
template <int N>
JetVector<N - 1> derivative(const JetVector<N>& x) {
  return {derivative(x[0]), derivative(x[1]), derivative(x[2])};
}
template <int N>
JetMatrix<N - 1> derivative(const JetMatrix<N>& x) {
  return {derivative(x[0]), derivative(x[1]), derivative(x[2])};
}

}  // namespace maxwrench
