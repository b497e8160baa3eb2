#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

namespace maxwrench {

/// A number v + d'e with N infinitesimals e. Arithmetic carries first derivatives exactly (forward
/// mode).
template <int N>
struct Dual {
  /// The derivatives come first, so that a copy reads the pairs of numbers that arithmetic wrote.
  /// In the other order the processor waits for every store.
  std::array<double, N> d{};
  double v = 0;

  Dual() = default;
  Dual(double value) : v(value) {}  // NOLINT(google-explicit-constructor): a constant is a number

  /// The variable with index i: its derivative i is one.
  static Dual variable(double value, int i) {
    Dual x(value);
    x.d[i] = 1;
    return x;
  }

  /// Chain rule: f(v) with f'(v) = slope.
  Dual chain(double value, double slope) const {
    Dual r(value);
    for (int i = 0; i < N; ++i) r.d[i] = slope * d[i];
    return r;
  }

  Dual operator-() const { return chain(-v, -1); }
  Dual& operator+=(const Dual& o) {
    v += o.v;
    for (int i = 0; i < N; ++i) d[i] += o.d[i];
    return *this;
  }
  Dual& operator-=(const Dual& o) {
    v -= o.v;
    for (int i = 0; i < N; ++i) d[i] -= o.d[i];
    return *this;
  }
  Dual& operator*=(const Dual& o) {
    for (int i = 0; i < N; ++i) d[i] = d[i] * o.v + v * o.d[i];
    v *= o.v;
    return *this;
  }
  Dual& operator/=(const Dual& o) { return *this *= o.chain(1 / o.v, -1 / (o.v * o.v)); }
  Dual& operator*=(double o) {
    v *= o;
    for (int i = 0; i < N; ++i) d[i] *= o;
    return *this;
  }

  friend Dual operator+(Dual a, const Dual& b) { return a += b; }
  friend Dual operator-(Dual a, const Dual& b) { return a -= b; }
  friend Dual operator*(Dual a, const Dual& b) { return a *= b; }
  friend Dual operator/(Dual a, const Dual& b) { return a /= b; }
  friend Dual operator*(Dual a, double b) { return a *= b; }
  friend Dual operator*(double a, Dual b) { return b *= a; }
  friend bool operator==(const Dual& a, const Dual& b) { return a.v == b.v && a.d == b.d; }
};

template <int N>
Dual<N> sin(const Dual<N>& x) {
  return x.chain(std::sin(x.v), std::cos(x.v));
}
template <int N>
Dual<N> cos(const Dual<N>& x) {
  return x.chain(std::cos(x.v), -std::sin(x.v));
}
template <int N>
Dual<N> sqrt(const Dual<N>& x) {
  const double root = std::sqrt(x.v);
  return x.chain(root, 0.5 / root);
}
/// The derivative at zero is that from above.
template <int N>
Dual<N> abs(const Dual<N>& x) {
  return x.chain(std::abs(x.v), x.v < 0 ? -1 : 1);
}

}  // namespace maxwrench

namespace Eigen {

template <int N>
struct NumTraits<maxwrench::Dual<N>> : NumTraits<double> {
  using Real = maxwrench::Dual<N>;
  using NonInteger = maxwrench::Dual<N>;
  using Nested = maxwrench::Dual<N>;
  enum { RequireInitialization = 1, ReadCost = N + 1, AddCost = N + 1, MulCost = 2 * N + 1 };
};

// Products of plain and dual matrices cost less than products of two dual ones.
template <int N, class Op>
struct ScalarBinaryOpTraits<maxwrench::Dual<N>, double, Op> {
  using ReturnType = maxwrench::Dual<N>;
};
template <int N, class Op>
struct ScalarBinaryOpTraits<double, maxwrench::Dual<N>, Op> {
  using ReturnType = maxwrench::Dual<N>;
};

}  // namespace Eigen
