#include "solvers/certify/trajectory/quadratic_loads.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace maxwrench {
namespace {

constexpr auto kAtOnce = static_cast<Eigen::Index>(NarrowDual::kDirections);

/// All numbers from low to high, from place `from` on.
VectorX<Narrow> narrow_between(const Eigen::VectorXd& low, const Eigen::VectorXd& high,
                               Eigen::Index from, Eigen::Index count) {
  return VectorX<Narrow>::NullaryExpr(
      count, [&](Eigen::Index i) { return Narrow(low[from + i], high[from + i]); });
}

}  // namespace

QuadraticLoads::QuadraticLoads(const PlanInstant& at)
    : at_(at), plain_(at.task, at.x), dual_(at.task, at.x) {
  const Eigen::Index n = at.task.robot.velocities(), r = at.task.redundancy();
  constant_ = low_ = high_ = sizes_ = Eigen::VectorXd::Zero(n);
  reach_ = Eigen::VectorXd::Zero(r);
  G_ = Eigen::MatrixXd::Zero(n, 2 * r);
}

void QuadraticLoads::enclose(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  const Eigen::Index n = low_.size(), r = reach_.size();
  const Eigen::VectorXd middle = (lower + upper) / 2;
  const VectorX<Narrow> none = VectorX<Narrow>::Constant(r, Narrow());
  const auto value = [&](const Eigen::VectorXd& low, const Eigen::VectorXd& high,
                         VectorX<Narrow>& result) {
    plain_.set(narrow_between(low, high, 0, r));
    plain_.evaluate({true, false, true}, narrow_between(low, high, r, r), none, result);
  };
  value(lower, upper, whole_);
  value(middle, middle, centre_);
  // Intervals from the middle to the sides, with room for the rounding of the middle.
  const auto beside = [&](Eigen::Index j) {
    return (Narrow(lower[j], upper[j]) - Narrow(middle[j])).magnitude();
  };
  std::vector<Narrow> rest(static_cast<std::size_t>(n));
  for (Eigen::Index j = 0; j < r; ++j) {
    const bool turns =
        at_.task.robot
            .joints[static_cast<std::size_t>(at_.task.redundant[static_cast<std::size_t>(j)])]
            .type == JointType::kRevolute;
    const double w = beside(j);
    reach_[j] = !turns ? w : w < std::numbers::pi / 2 ? std::sin(w) : 1;
  }
  const VectorX<NarrowDual> unbent = none.cast<NarrowDual>();
  VectorX<NarrowDual> q(r), rates(r);
  for (Eigen::Index first = 0; first < 2 * r; first += kAtOnce) {
    for (Eigen::Index j = 0; j < 2 * r; ++j) {
      NarrowDual x(Narrow(lower[j], upper[j]));
      if (j >= first && j < first + kAtOnce) {
        x.varies = true;
        x.d[static_cast<std::size_t>(j - first)] = 1.0;
      }
      (j < r ? q[j] : rates[j - r]) = x;
    }
    dual_.set(q);
    dual_.evaluate({true, false, true}, rates, unbent, slopes_);
    for (Eigen::Index j = first; j < std::min(first + kAtOnce, 2 * r); ++j) {
      const double w = beside(j);
      for (Eigen::Index i = 0; i < n; ++i) {
        const Narrow slope = slopes_[i].d[static_cast<std::size_t>(j - first)];
        const double G = (slope.low + slope.high) / 2;
        G_(i, j) = G;
        Narrow& sum = rest[static_cast<std::size_t>(i)];
        sum += (slope - Narrow(G)) * Narrow(-w, w);
        if (j < r && reach_[j] != w) {  // |x - sin x| <= |x|^3/6
          const double more = Narrow::above(w * w * w / 6 * (1 + 1e-12));
          sum += Narrow(std::abs(G)) * Narrow(-more, more);
        }
      }
    }
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    const Narrow& all = whole_[i];
    Narrow mean = rest[static_cast<std::size_t>(i)];
    if (!(mean.high - mean.low < all.high - all.low)) {
      constant_[i] = (all.low + all.high) / 2;
      G_.row(i).setZero();
      mean = all - Narrow(constant_[i]);
    } else {
      constant_[i] = (centre_[i].low + centre_[i].high) / 2;
      mean += centre_[i] - Narrow(constant_[i]);
      // The rates enter as they are, not less their middle.
      Narrow shift(constant_[i]);
      for (Eigen::Index j = r; j < 2 * r; ++j) shift -= Narrow(G_(i, j)) * Narrow(middle[j]);
      constant_[i] = (shift.low + shift.high) / 2;
      mean += shift - Narrow(constant_[i]);
    }
    low_[i] = mean.low;
    high_[i] = mean.high;
    sizes_[i] = std::abs(constant_[i]) + mean.magnitude();
    for (Eigen::Index j = 0; j < 2 * r; ++j) {
      sizes_[i] += std::abs(G_(i, j)) * (j < r ? reach_[j] : std::abs(middle[j]) + beside(j));
    }
  }
}

}  // namespace maxwrench
