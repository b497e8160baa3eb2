#include "tests/support/landscapes.h"

#include <algorithm>
#include <cmath>

namespace maxwrench {
namespace {

// A sharp ridge along x1 = 0.6 x0 + 0.1, curved along itself: coordinate steps stall on it.
double ridge(const Eigen::VectorXd& x) {
  return 1 - 5 * std::abs(x[1] - 0.6 * x[0] - 0.1) - std::pow(x[0] - 0.5, 2);
}

// The smallest of four planes: a pyramid with its top at (0.2, -0.4), skewed and steep.
double pyramid(const Eigen::VectorXd& x) {
  const double a = x[0] - 0.2, b = x[1] + 0.4;
  return 3 - std::max({a + 4 * b, -2 * a + b, a - 3 * b, -a - b});
}

// Lower of two smooth functions: the maximum lies on their curved crease.
// On the circle x0^2 + x1^2 = 1 both are equal, to x0 + x1, largest at x0 = x1 = 1/sqrt(2).
double crease(const Eigen::VectorXd& x) { return x[0] + x[1] - 4 * std::abs(x.squaredNorm() - 1); }

// Peaks at the integers of both coordinates; the quadratic picks (1, -1), whose value is 0.
double peaks(const Eigen::VectorXd& x) {
  const Eigen::Vector2d d = x - Eigen::Vector2d(1, -1);
  return -0.3 * d.squaredNorm() + (2 * M_PI * d.array()).cos().sum() - 2;
}

// No value outside the annulus 0.5 <= |x| <= 1; inside the value is x0, whose maximum (1, 0) lies
// on its edge.
double annulus(const Eigen::VectorXd& x) {
  const double r = x.norm();
  return r < 0.5 || r > 1 ? -kInfinity : x[0];
}

}  // namespace

double smooth(const Eigen::VectorXd& x) {
  return 2 - std::pow(x[0] - 0.3, 2) - 2 * std::pow(x[1] + 0.7, 2);
}

double bowl(const Eigen::VectorXd& x) {
  double value = 0;
  for (int i = 0; i < x.size(); ++i) value -= (i + 1) * std::pow(x[i] - 0.1 * i, 2);
  return value;
}

std::vector<Landscape> landscapes() {
  const auto constant = [](int d, double value) {
    return Eigen::VectorXd::Constant(d, value).eval();
  };
  const Eigen::VectorXd one = constant(2, 1), two = constant(2, 2);
  const auto V = [](double a, double b) { return Eigen::VectorXd(Eigen::Vector2d(a, b)); };
  const double s = std::sqrt(0.5);
  const auto kink = [](const Eigen::VectorXd& x) { return -std::abs(x[0] - 0.123); };
  const auto corner = [](const Eigen::VectorXd& x) { return x[0] - 2 * x[1]; };
  Eigen::Vector4d quarter(0, 0.1, 0.2, 0.3);
  return {
      {"smooth", {smooth, -two, two}, V(0.3, -0.7), 2, 1e-9},
      {"ridge", {ridge, -two, two}, V(0.5, 0.4), 1, 1e-6},
      {"pyramid", {pyramid, -two, two}, V(0.2, -0.4), 3, 1e-6},
      {"crease", {crease, -two, two}, V(s, s), 2 * s, 1e-6},
      {"starts_wanted", {peaks, -3 * one, 3 * one}, V(1, -1), 0, 1e-6},
      {"annulus", {annulus, -two, two}, V(1, 0), 1, 1e-5},
      {"corner", {corner, -one, 3 * one}, V(3, -1), 5, 0},
      {"one dimension", {kink, constant(1, -1), constant(1, 2)}, constant(1, 0.123), 0, 1e-8},
      {"four dimensions", {bowl, constant(4, -1), constant(4, 1)}, quarter, 0, 1e-6},
      {"fixed coordinate", {smooth, V(-2, 0.5), V(2, 0.5)}, V(0.3, 0.5), -0.88, 1e-9},
      {"one point", {smooth, V(0.3, -0.7), V(0.3, -0.7)}, V(0.3, -0.7), 2, 1e-15},
  };
}

}  // namespace maxwrench
