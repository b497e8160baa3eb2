#include "solvers/certify/bound/multi_affine.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace maxwrench {
namespace {

using ExtendedMatrix = MatrixX<Extended>;

/// The sample places: 0, pi/2 and pi of a turning coordinate, 0 and 1 of a sliding one.
Extended place(bool turns, int i) {
  return turns ? std::numbers::pi_v<Extended> / 2 * i : Extended(i);
}

/// Converts values at the sample places into coefficients, along one axis.
void read_off(const Coordinates& coordinates, int axis, ExtendedMatrix& F) {
  const Eigen::Index step = coordinates.points(axis + 1);
  const int n = coordinates.terms(axis);
  for (Eigen::Index first = 0; first < F.cols(); ++first) {
    if (first / step % n != 0) continue;
    const ExtendedVector at_0 = F.col(first), at_1 = F.col(first + step);
    if (n == 2) {
      F.col(first + step) = at_1 - at_0;
    } else {
      const ExtendedVector at_2 = F.col(first + 2 * step);
      F.col(first) = (at_0 + at_2) / 2;
      F.col(first + step) = (at_0 - at_2) / 2;
      F.col(first + 2 * step) = at_1 - F.col(first);
    }
  }
}

/// prod_i e_i of all combinations of terms, e_i those of an axis.
template <class Terms>
Eigen::VectorXd products(const Coordinates& coordinates, const Terms& terms_of) {
  Eigen::VectorXd all = Eigen::VectorXd::Ones(1);
  for (int i = coordinates.count(); i-- > 0;) {  // the last one changes fastest
    const std::array<double, 3> e = terms_of(i);
    const Eigen::VectorXd behind = all;
    const Eigen::Index step = behind.size();
    all.resize(step * coordinates.terms(i));
    for (int k = 0; k < coordinates.terms(i); ++k) {
      all.segment(k * step, step) = e[static_cast<std::size_t>(k)] * behind;
    }
  }
  return all;
}

}  // namespace

Eigen::Index Coordinates::points(int from) const {
  Eigen::Index product = 1;
  for (int i = from; i < count(); ++i) product *= terms(i);
  return product;
}

void require_few_control_points(const std::string& task, const Coordinates& coordinates) {
  double points = 1;
  for (int i = 0; i < coordinates.count(); ++i) points *= coordinates.terms(i);
  if (points <= kMostControlPoints) return;
  throw std::invalid_argument(task + ": got " + std::to_string(coordinates.count()) +
                              " coordinates of a posture, expected at most 9 that turn, for a "
                              "proof: a bound uses 3 points for each, multiplied");
}

MultiAffine::MultiAffine(Coordinates coordinates, const Eigen::VectorXd& theta_r,
                         const Sample& sample)
    : coordinates_(std::move(coordinates)) {
  const Eigen::Index size = coordinates_.points();
  ExtendedVector at = theta_r.cast<Extended>();
  ExtendedMatrix F;
  for (Eigen::Index a = 0; a < size; ++a) {
    for (int i = 0; i < coordinates_.count(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      const auto digit = a / coordinates_.points(i + 1) % coordinates_.terms(i);
      at[coordinates_.index[k]] = place(coordinates_.turns[k] != 0, static_cast<int>(digit));
    }
    const ExtendedVector values = sample(at);
    if (a == 0) F.resize(values.size(), size);
    F.col(a) = values;
  }
  for (int i = 0; i < coordinates_.count(); ++i) read_off(coordinates_, i, F);
  F_ = F.cast<double>();
}

Eigen::VectorXd MultiAffine::magnitudes(const Eigen::VectorXd& lower,
                                        const Eigen::VectorXd& upper) const {
  return F_.cwiseAbs() * products(coordinates_, [&](int i) -> std::array<double, 3> {
           const int at = coordinates_.index[static_cast<std::size_t>(i)];
           if (coordinates_.terms(i) == 3) return {1, 1, 1};
           return {1, std::max(std::abs(lower[at]), std::abs(upper[at])), 0};
         });
}

Eigen::VectorXd MultiAffine::evaluate(const Eigen::VectorXd& theta_r) const {
  return F_ * products(coordinates_, [&](int i) -> std::array<double, 3> {
           const double q = theta_r[coordinates_.index[static_cast<std::size_t>(i)]];
           if (coordinates_.terms(i) == 3) return {1, std::cos(q), std::sin(q)};
           return {1, q, 0};
         });
}

double spread(const Coordinates& coordinates, const Eigen::VectorXd& lower,
              const Eigen::VectorXd& upper) {
  double factor = 1;
  for (std::size_t i = 0; i < coordinates.index.size(); ++i) {
    if (!coordinates.turns[i]) continue;
    const double r = (upper[coordinates.index[i]] - lower[coordinates.index[i]]) / 2;
    if (!(r < std::numbers::pi / 2)) return kInfinity;
    factor /= std::cos(r);
  }
  return factor;
}

ControlPoints::ControlPoints(const MultiAffine& f) : f_(f) {
  const int axes = f.coordinates().count();
  levels_.assign(static_cast<std::size_t>(axes) + 1, f.coefficients());
  lower_ = upper_ = Eigen::VectorXd::Constant(axes, std::numeric_limits<double>::quiet_NaN());
}

const Eigen::MatrixXd& ControlPoints::over(const Eigen::VectorXd& lower,
                                           const Eigen::VectorXd& upper) {
  bool changed = false;
  for (int axis = 0; axis < f_.coordinates().count(); ++axis) {
    const int at = f_.coordinates().index[static_cast<std::size_t>(axis)];
    changed |= !(lower_[axis] == lower[at] && upper_[axis] == upper[at]);
    if (changed) advance(axis, lower_[axis] = lower[at], upper_[axis] = upper[at]);
  }
  return levels_.back();
}

/// Converts coefficients into control points, along one axis.
void ControlPoints::advance(int axis, double lower, double upper) {
  const int n = f_.coordinates().terms(axis);
  const Eigen::Index length = f_.coordinates().points(axis + 1) * f_.rows();
  const Eigen::Index total = f_.coefficients().size();
  std::array<double, 3> c{}, s{};
  if (n == 3) {
    const double m = (lower + upper) / 2, stretch = 1 / std::cos((upper - lower) / 2);
    c = {std::cos(lower), stretch * std::cos(m), std::cos(upper)};
    s = {std::sin(lower), stretch * std::sin(m), std::sin(upper)};
  }
  const double* from = levels_[static_cast<std::size_t>(axis)].data();
  double* to = levels_[static_cast<std::size_t>(axis) + 1].data();
  for (Eigen::Index first = 0; first < total; first += n * length) {
    using Part = Eigen::Map<Eigen::ArrayXd>;
    using ConstPart = Eigen::Map<const Eigen::ArrayXd>;
    const ConstPart f0(from + first, length), f1(from + first + length, length);
    if (n == 2) {
      Part(to + first, length) = f0 + lower * f1;
      Part(to + first + length, length) = f0 + upper * f1;
      continue;
    }
    const ConstPart f2(from + first + 2 * length, length);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const auto at = first + static_cast<Eigen::Index>(corner) * length;
      Part(to + at, length) = f0 + c[corner] * f1 + s[corner] * f2;
    }
  }
}

}  // namespace maxwrench
