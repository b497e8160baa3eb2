#include "lib/posture/ik/path_tracker.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace maxwrench {
namespace {

/// [rad or m] A solution whose imaginary part is below this may be real.
constexpr double kAlmostReal = 1e-6;
/// [rad or m] Two ends closer than this may be the same solution reached twice.
constexpr double kTwice = 1e-7;

/// A solution is almost infinite if rounding magnifies by more than this. It would be real only
/// within as small a distance of a singular posture.
constexpr double kAlmostInfinite = 1e5;

double largest_imaginary(const Six<Complex>& y) {
  double most = 0;
  for (const Complex& y_i : y) most = std::max(most, std::abs(y_i.im));
  return most;
}

/// The sign differs between a solution and its conjugate. The weights are such that no symmetry of
/// a robot makes the sum cancel.
double side(const Six<Complex>& y) {
  static constexpr Six<double> kWeights = {1, 0.62, 0.37, 0.83, 0.29, 0.51};
  double sum = 0;
  for (std::size_t i = 0; i < 6; ++i) sum += kWeights[i] * y[i].im;
  return sum;
}

template <class T>
bool has_twins(const ToolChain& chain, const std::vector<Six<T>>& list) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (apart(chain, list[i], list[j]) < kTwice) return true;
    }
  }
  return false;
}

}  // namespace

PathTracker::PathTracker(const ToolChain& chain, const Pose<double>& pose)
    : chain_(chain), real_(chain), complex_(chain) {
  line_.pose = pose;
  line_.bend.setZero(chain.parameters());
  path_.pose = complex_of(pose);
  path_.bend.resize(chain.parameters());
}

void PathTracker::begin() {
  ends_.clear();
  carried_ = lost_ = 0;
}

void PathTracker::carry(const Six<Complex>& y) {
  Six<Complex> end = y;
  ++carried_;
  if (complex_.track(path_, end)) {
    ends_.push_back(end);
  } else if (complex_.is_far(y, kAlmostInfinite) && complex_.is_far(end, kAlmostInfinite)) {
    ++lost_;
  }
}

void PathTracker::finish(IkSolutionSet& node) {
  node.real.clear();
  node.pairs.clear();
  seen_.clear();
  int unpaired = 0;
  for (Six<Complex> end : ends_) {
    wrap(chain_, end);
    if (contains(chain_, seen_, end)) continue;
    seen_.push_back(end);
    Six<double> y{};
    for (std::size_t i = 0; i < 6; ++i) y[i] = end[i].re;
    if (largest_imaginary(end) < kAlmostReal && real_.correct(node.theta_r, line_.pose, y)) {
      wrap(chain_, y);
      node.real.push_back(y);
      continue;
    }
    const bool above = side(end) > 0;
    if (above) node.pairs.push_back(end);
    if (!complex_.is_far(end, kAlmostInfinite)) unpaired += above ? 1 : -1;
  }
  const int found = static_cast<int>(seen_.size());
  node.full = found == carried_ && unpaired == 0;
  node.complete = found + lost_ == carried_ && unpaired == 0;
}

bool PathTracker::track_straight(const Eigen::VectorXd& from, IkSolutionSet& node) {
  line_.from = from;
  line_.to = node.theta_r;
  for (Six<double>& y : node.real) {
    if (!real_.track(line_, y)) return false;
    wrap(chain_, y);
  }
  assign(from, path_.from);
  assign(node.theta_r, path_.to);
  path_.bend.setConstant(Complex(0.0));
  for (Six<Complex>& y : node.pairs) {
    if (!complex_.track(path_, y) || largest_imaginary(y) < kTwice) return false;
    wrap(chain_, y);
  }
  return !has_twins(chain_, node.real) && !has_twins(chain_, node.pairs);
}

void assign(const Eigen::VectorXd& from, VectorX<Complex>& to) {
  to.resize(from.size());
  for (Eigen::Index k = 0; k < from.size(); ++k) to[k] = from[k];
}

Six<Complex> complex_of(const Six<double>& y) {
  Six<Complex> result;
  std::copy(y.begin(), y.end(), result.begin());
  return result;
}

Pose<Complex> complex_of(const Pose<double>& pose) {
  Pose<Complex> result;
  for (int i = 0; i < 3; ++i) {
    result.p[i] = pose.p[i];
    for (int j = 0; j < 3; ++j) result.R(i, j) = pose.R(i, j);
  }
  return result;
}

template <class T>
double apart(const ToolChain& chain, const Six<T>& a, const Six<T>& b) {
  double most = 0;
  for (int i = 0; i < chain.unknowns(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    double real = real_part(a[k]) - real_part(b[k]);
    if (chain.turns(i)) real = std::remainder(real, 2 * std::numbers::pi);
    most = std::max({most, std::abs(real), std::abs(imaginary_part(a[k]) - imaginary_part(b[k]))});
  }
  return most;
}

template <class T>
bool contains(const ToolChain& chain, const std::vector<Six<T>>& list, const Six<T>& y,
              double same) {
  return std::any_of(list.begin(), list.end(),
                     [&](const Six<T>& each) { return apart(chain, each, y) < same; });
}

template <class T>
void wrap(const ToolChain& chain, Six<T>& y) {
  for (int i = 0; i < chain.unknowns(); ++i) {
    if (!chain.turns(i)) continue;
    T& angle = y[static_cast<std::size_t>(i)];
    const double turned = std::remainder(real_part(angle), 2 * std::numbers::pi);
    angle += T(turned - real_part(angle));
  }
}

template double apart(const ToolChain&, const Six<double>&, const Six<double>&);
template double apart(const ToolChain&, const Six<Complex>&, const Six<Complex>&);
template bool contains(const ToolChain&, const std::vector<Six<double>>&, const Six<double>&,
                       double);
template bool contains(const ToolChain&, const std::vector<Six<Complex>>&, const Six<Complex>&,
                       double);
template void wrap(const ToolChain&, Six<double>&);
template void wrap(const ToolChain&, Six<Complex>&);

}  // namespace maxwrench
