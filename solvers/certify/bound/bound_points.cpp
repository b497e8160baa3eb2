#include "solvers/certify/bound/bound_points.h"

#include <algorithm>
#include <cmath>

#include "solvers/certify/bound/bounds.h"
#include "solvers/certify/bound/multiplier_program.h"

namespace maxwrench {
namespace {

constexpr std::size_t kMostAdded = 8;
/// Without a limit, the program considers values up to this times the scale of those known.
constexpr double kWide = 1e3;
/// The scale of values of which none is known.
constexpr double kUnknown = 1e3;
/// A limit of the values is of use if it is at most this times their scale.
constexpr double kMostUseful = 1e6;

}  // namespace

void PointValues::set_ends(double low, double high) {
  low_ = low;
  scale_ = std::isfinite(low) ? std::max(1.0, std::abs(low)) : kUnknown;
  most_is_limit_ = std::isfinite(high) && is_useful(high);
  most_t_ = most_is_limit_ ? high : kWide * scale_;
  const double reach = most_is_limit_ ? 2 * std::abs(high) : 0;
  least_t_ = std::isfinite(low) ? low : -std::max(kUnknown, reach);
}

bool PointValues::is_useful(double limit) const { return limit <= kMostUseful * scale_; }

double PointValues::bound(double s, const Eigen::VectorXd& g, const Eigen::VectorXd& h, double off,
                          double off_a) {
  const double T = std::max(std::abs(least_t_), std::abs(most_t_));
  const Eigen::Index size = g.size();
  at_.resize(2 * size);
  at_.head(size) = least_t_ * (1 - h.array()) - g.array();
  at_.tail(size) = most_t_ * (1 - h.array()) - g.array();
  double U = kInfinity;
  if (std::isfinite(low_) && most_is_limit_) {
    U = s + at_.maxCoeff() + off + T * (off_a + kBoundRounding);
  }
  // t <= (s - g)/h by convexity, where h > 0 at all points.
  if (U > low_ && h.minCoeff() > 2 * off_a) {
    const double ratio =
        ((s + off - g.array()) / (h.array() - (s + off - g.array()).sign() * off_a)).maxCoeff();
    U = std::min(U, ratio + 1e-14 * std::abs(ratio));
  }
  return U;
}

std::vector<int> ProgramPoints::begin(const std::vector<int>& basis, int first) {
  clear();
  std::vector<int> columns = basis;
  for (int& column : columns) {
    if (column < first) continue;
    add(column - first);
    column = first + static_cast<int>(count()) - 1;
  }
  return columns;
}

std::vector<int> ProgramPoints::numbered(std::vector<int> columns, int first) const {
  for (int& column : columns) {
    if (column >= first) column = first + ids_[static_cast<std::size_t>(column - first)];
  }
  return columns;
}

void ProgramPoints::add_corners(const Coordinates& chain, Eigen::Index size) {
  for (Eigen::Index v = 0; v < size && count() + 2 <= kMost / 2; ++v) {
    Eigen::Index rest = v;
    bool corner = true;
    for (int i = chain.count(); i-- > 0;) {
      corner = corner && (chain.terms(i) == 2 || rest % 3 != 1);
      rest /= chain.terms(i);
    }
    if (!corner) continue;
    ids_.push_back(static_cast<int>(v));
    ids_.push_back(static_cast<int>(v + size));
  }
}

bool ProgramPoints::add_largest(const Eigen::VectorXd& values, double above,
                                const std::function<int(int)>& number) {
  list_largest(values, above, kMostAdded, order_);
  const std::size_t before = ids_.size();
  for (const int at : order_) {
    const int id = number ? number(at) : at;
    if (std::find(ids_.begin(), ids_.end(), id) == ids_.end()) ids_.push_back(id);
  }
  if (ids_.size() == before || count() > kMost) {
    ids_.resize(before);
    return false;
  }
  return true;
}

}  // namespace maxwrench
