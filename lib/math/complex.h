#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace maxwrench {

/// A complex number with the plain formulas for its operations. The operators of std::complex check
/// for NaN after each product.
struct Complex {
  double re = 0, im = 0;

  Complex() = default;
  Complex(double real) : re(real) {}  // NOLINT(google-explicit-constructor): a real is complex
  Complex(double real, double imaginary) : re(real), im(imaginary) {}

  Complex operator-() const { return {-re, -im}; }
  Complex& operator+=(const Complex& o) {
    re += o.re;
    im += o.im;
    return *this;
  }
  Complex& operator-=(const Complex& o) {
    re -= o.re;
    im -= o.im;
    return *this;
  }
  friend Complex operator+(Complex a, const Complex& b) { return a += b; }
  friend Complex operator-(Complex a, const Complex& b) { return a -= b; }
  friend Complex operator*(const Complex& a, const Complex& b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
  friend Complex operator*(double a, const Complex& b) { return {a * b.re, a * b.im}; }
  friend Complex operator*(const Complex& a, double b) { return b * a; }
  friend Complex operator/(const Complex& a, const Complex& b) {
    const double scale = 1 / (b.re * b.re + b.im * b.im);
    return {scale * (a.re * b.re + a.im * b.im), scale * (a.im * b.re - a.re * b.im)};
  }
  Complex& operator*=(const Complex& o) { return *this = *this * o; }
  Complex& operator/=(const Complex& o) { return *this = *this / o; }
  friend bool operator==(const Complex& a, const Complex& b) = default;

  friend Complex sin(const Complex& a) {
    return {std::sin(a.re) * std::cosh(a.im), std::cos(a.re) * std::sinh(a.im)};
  }
  friend Complex cos(const Complex& a) {
    return {std::cos(a.re) * std::cosh(a.im), -std::sin(a.re) * std::sinh(a.im)};
  }
};

/// The larger of |real part| and |imaginary part|.
inline double magnitude(double a) { return std::abs(a); }
inline double magnitude(const Complex& a) { return std::max(std::abs(a.re), std::abs(a.im)); }

inline double real_part(double a) { return a; }
inline double real_part(const Complex& a) { return a.re; }
inline double imaginary_part(double /*a*/) { return 0; }
inline double imaginary_part(const Complex& a) { return a.im; }

}  // namespace maxwrench

namespace Eigen {

/// Eigen sees a number without a conjugate, so that products of vectors are analytic functions.
template <>
struct NumTraits<maxwrench::Complex> : NumTraits<double> {
  using Real = maxwrench::Complex;
  using NonInteger = maxwrench::Complex;
  using Nested = maxwrench::Complex;
  enum { IsComplex = 0, RequireInitialization = 1, ReadCost = 2, AddCost = 2, MulCost = 6 };
};

template <class BinaryOp>
struct ScalarBinaryOpTraits<maxwrench::Complex, double, BinaryOp> {
  using ReturnType = maxwrench::Complex;
};
template <class BinaryOp>
struct ScalarBinaryOpTraits<double, maxwrench::Complex, BinaryOp> {
  using ReturnType = maxwrench::Complex;
};

}  // namespace Eigen
