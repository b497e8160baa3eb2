#include "lib/posture/ik/continuation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/math/complex.h"
#include "lib/math/rotated.h"

namespace maxwrench {
namespace {

/// [rad or m] The first correction after a step: its upper limit, and the size at which the step
/// controller aims.
constexpr double kLongestCorrection = 0.1;
constexpr double kGoodCorrection = 0.02;
/// Each further correction must be at most this share of the one before.
constexpr double kContraction = 0.25;
/// Newton's method ends at corrections below the first value along the path and below the second at
/// its end.
constexpr double kCloseEnough = 1e-4;
constexpr double kLastCorrection = 1e-13;
/// Near a singular posture corrections may stop shrinking. They must then be below this.
constexpr double kSmallCorrection = 1e-6;
/// [rad, m] The error of an answer, as a share of the largest of 1, J_d and the distance of the
/// pose.
constexpr double kLeastError = 1e-12;
/// The same as a share of the largest rounded product.
constexpr double kProductRounding = 1e-14;
constexpr int kMostCorrections = 8;
/// A path fails if a step would be shorter than this share of its remaining length, or after
/// `kMostWaySteps` steps. The limit is relative to the remaining length, so that a singularity just
/// beyond the end does not stop the tracker, such as a fold where a pair of postures vanishes.
constexpr double kShortestShare = 1e-5;
constexpr int kMostWaySteps = 2000;
/// A step that ends closer to 1 than this ends at 1.
constexpr double kEnd = 1e-9;
constexpr double kLongestShare = 0.5;
/// [rad or m] The largest change of each y along the tangent in the first step.
constexpr double kFirstStep = 0.1;
/// A solution counts as infinite beyond these values: the imaginary part of an angle [rad], whose
/// sinh is then too large to use, and a distance [m].
constexpr double kInfiniteAngle = 20;
constexpr double kInfinitePlace = 1e6;

}  // namespace

template <class T>
double largest(const Six<T>& y, int d) {
  double most = 0;
  for (int i = 0; i < d; ++i) {
    const double size = magnitude(y[static_cast<std::size_t>(i)]);
    if (std::isnan(size)) return size;
    most = std::max(most, size);
  }
  return most;
}

template <class T>
void PivotedLu<T>::factor(const Six<Vector6<T>>& J_d, int d) {
  d_ = d;
  for (int i = 0; i < 6; ++i) {
    from_[i] = i;
    for (int j = 0; j < d; ++j) rows_[i][j] = J_d[j][i];
  }
  for (int k = 0; k < d; ++k) {
    int best = k;
    for (int i = k + 1; i < 6; ++i) {
      if (magnitude(rows_[i][k]) > magnitude(rows_[best][k])) best = i;
    }
    std::swap(rows_[k], rows_[best]);
    std::swap(from_[k], from_[best]);
    inverse_pivots_[k] = T(1.0) / rows_[k][k];
    for (int i = k + 1; i < 6; ++i) {
      const T factor = rows_[i][k] * inverse_pivots_[k];
      rows_[i][k] = factor;
      for (int j = k + 1; j < d; ++j) rows_[i][j] -= factor * rows_[k][j];
    }
  }
}

template <class T>
bool PivotedLu<T>::is_singular(const Six<Vector6<T>>& J_d, double threshold) const {
  double least = kInfinity, most = 0;
  for (int k = 0; k < d_; ++k) {
    double longest = 0;
    for (const T& entry : J_d[k]) longest = std::max(longest, magnitude(entry));
    const double share = magnitude(rows_[k][k]) / longest;
    if (!(share > 0)) return true;
    least = std::min(least, share);
    most = std::max(most, share);
  }
  return !(least > threshold * most);
}

template <class T>
Six<T> PivotedLu<T>::solve(const Vector6<T>& b) const {
  Six<T> y{};
  for (int i = 0; i < d_; ++i) {
    T sum = b[from_[i]];
    for (int j = 0; j < i; ++j) sum -= rows_[i][j] * y[j];
    y[i] = sum;
  }
  for (int i = d_ - 1; i >= 0; --i) {
    for (int j = i + 1; j < d_; ++j) y[i] -= rows_[i][j] * y[j];
    y[i] *= inverse_pivots_[i];
  }
  return y;
}

template <class T>
Continuation<T>::Continuation(const ToolChain& chain)
    : chain_(chain), d_(chain.unknowns()), r_(chain.parameters()), theta_r_(r_), rate_(r_) {}

/// Sets theta_r, X and their rates at s.
template <class T>
void Continuation<T>::place(const HomotopyPath<T>& path, double s) {
  for (int k = 0; k < r_; ++k) {
    const T length = path.to[k] - path.from[k];
    theta_r_[k] = path.from[k] + length * s + path.bend[k] * (s * (1 - s));
    rate_[k] = length + path.bend[k] * (1 - 2 * s);
    if (s == 1) theta_r_[k] = path.to[k];
  }
  if (!path.moves_pose) {
    if (path.twist.isZero(0)) return;
    const Vector6d moved = s * path.twist;
    pose_.p = path.pose.p + moved.head<3>();
    pose_.R = rotation_by(moved.tail<3>()) * path.pose.R;
    return;
  }
  Six<T> y{}, y_rate{};
  for (int i = 0; i < d_; ++i) {
    y_rate[i] = path.y_to[i] - path.y_from[i];
    y[i] = s == 1 ? path.y_to[i] : path.y_from[i] + y_rate[i] * s;
  }
  chain_.evaluate(theta_r_.data(), y.data(), rate_.data(), y_rate.data(), reference_);
  pose_ = reference_.pose;
  twist_ = reference_.twist;
}

/// Fills state_, error_ and J_d_ at y. Returns the largest entry of the error.
template <class T>
double Continuation<T>::linearise(const Six<T>& y) {
  chain_.evaluate(theta_r_.data(), y.data(), rate_.data(), static_cast<const T*>(nullptr), state_);
  error_.template head<3>() = pose_.p - state_.pose.p;
  Vector3<T> turn;
  turn.setConstant(T(0.0));
  for (int k = 0; k < 3; ++k) turn += state_.pose.R.col(k).cross(pose_.R.col(k));
  error_.template tail<3>() = turn * 0.5;
  J_d_.factor(state_.J, d_);
  Six<T> error;
  std::copy(error_.begin(), error_.end(), error.begin());
  return largest(error, 6);
}

/// The error that rounding allows. Cosines of complex angles are unbounded. The product of the
/// turns up to y_j is as large as the square root of its axis; the next ones magnify its rounding
/// by the cosines of their halves, although they may bring the product itself back to order 1.
template <class T>
double Continuation<T>::least_error(const Six<T>& y) const {
  double far = 1, rounding = 0, growth = 1;
  for (int i = 0; i < 3; ++i) far = std::max(far, magnitude(pose_.p[i]));
  for (int j = d_ - 1; j >= 0; --j) {
    double axis = 0;
    for (const T& entry : state_.J[static_cast<std::size_t>(j)]) {
      axis = std::max(axis, magnitude(entry));
    }
    far = std::max(far, axis);
    if (chain_.turns(j)) growth *= std::cosh(imaginary_part(y[static_cast<std::size_t>(j)]) / 2);
    rounding = std::max(rounding, std::sqrt(axis) * growth);
  }
  return std::max(kLeastError * far, kProductRounding * rounding);
}

/// Newton's method from y. `first` is the length of its first correction.
template <class T>
bool Continuation<T>::contract(Six<T>& y, bool exact, double& first) {
  double last = kInfinity;
  for (int i = 0; i < kMostCorrections; ++i) {
    linearise(y);
    const Six<T> dy = J_d_.solve(error_);
    const double length = largest(dy, d_);
    if (i == 0) first = length;
    if (!(length <= kLongestCorrection)) return false;
    if (i > 0 && length > std::max(kContraction * last, kLastCorrection)) {
      // At the level of rounding nothing contracts any more.
      return exact && last <= kSmallCorrection && linearise(y) <= least_error(y);
    }
    for (int j = 0; j < d_; ++j) y[j] += dy[j];
    last = length;
    if (!exact && length <= kCloseEnough) return true;
    if (length <= kLastCorrection) return linearise(y) <= least_error(y);
  }
  return false;
}

/// dy/ds at the y of the last `linearise`.
template <class T>
Six<T> Continuation<T>::tangent() {
  return J_d_.solve(twist_ - state_.twist);
}

template <class T>
bool Continuation<T>::is_finite(const Six<T>& y) const {
  for (int i = 0; i < d_; ++i) {
    const bool inside = chain_.turns(i) ? std::abs(imaginary_part(y[i])) < kInfiniteAngle
                                        : magnitude(y[i]) < kInfinitePlace;
    if (!inside) return false;
  }
  return true;
}

template <class T>
bool Continuation<T>::is_far(const Six<T>& y, double most) const {
  double growth = 1;
  for (int i = 0; i < d_; ++i) {
    if (chain_.turns(i)) growth *= std::cosh(imaginary_part(y[i]) / 2);
  }
  return growth > most;
}

template <class T>
bool Continuation<T>::track(const HomotopyPath<T>& path, Six<T>& y) {
  twist_ = path.twist.template cast<T>();
  pose_ = path.pose;
  place(path, 0);
  linearise(y);
  Six<T> slope = tangent(), before{};
  double s = 0, step = std::min(1.0, kFirstStep / largest(slope, d_)), last_step = 0;
  for (int i = 0; i < kMostWaySteps; ++i) {
    const double next = s + step > 1 - kEnd ? 1 : s + step;
    const double h = next - s;
    const double curve = last_step > 0 ? h / (2 * last_step) : 0;
    Six<T> trial{};
    for (int j = 0; j < d_; ++j) {
      trial[j] = y[j] + (slope[j] + (slope[j] - before[j]) * curve) * h;
    }
    place(path, next);
    double first = kInfinity;
    const bool arrived = contract(trial, next == 1, first) && is_finite(trial);
    if (!arrived) {
      step = h / 4;
      if (step < kShortestShare * (1 - s) || (next == 1 && h <= kEnd)) return false;
      continue;
    }
    y = trial;
    if (next == 1) return true;
    before = slope;
    slope = tangent();
    s = next;
    last_step = h;
    const double growth = std::cbrt(kGoodCorrection / std::max(first, 1e-9));
    step = std::min(kLongestShare, h * std::clamp(growth, 0.5, 3.0));
  }
  return false;
}

template <class T>
bool Continuation<T>::correct(const VectorX<T>& theta_r, const Pose<T>& pose, Six<T>& y) {
  theta_r_ = theta_r;
  rate_.setConstant(T(0.0));
  pose_ = pose;
  double first = 0;
  return contract(y, true, first);
}

template <class T>
bool Continuation<T>::seek(const VectorX<T>& theta_r, const Pose<T>& pose, Six<T>& y) {
  constexpr int kMostSeekSteps = 50;
  constexpr double kLongest = 0.5;
  theta_r_ = theta_r;
  rate_.setConstant(T(0.0));
  pose_ = pose;
  for (int i = 0; i < kMostSeekSteps && is_finite(y); ++i) {
    linearise(y);
    const Six<T> dy = J_d_.solve(error_);
    const double length = largest(dy, d_);
    const double share = length > kLongest ? kLongest / length : 1;
    for (int j = 0; j < d_; ++j) y[j] += dy[j] * share;
    if (length < kCloseEnough) return correct(theta_r, pose, y);
  }
  return false;
}

template class PivotedLu<double>;
template class PivotedLu<Complex>;
template class Continuation<double>;
template class Continuation<Complex>;
template double largest(const Six<double>&, int);
template double largest(const Six<Complex>&, int);

}  // namespace maxwrench
