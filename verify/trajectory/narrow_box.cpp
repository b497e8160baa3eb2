#include "verify/trajectory/narrow_box.h"

#include <Eigen/LU>
#include <algorithm>

namespace maxwrench {
namespace {

constexpr int kRefinements = 3;
/// Products of numbers up to this one do not overflow.
constexpr double kMostSolution = 1e20;

}  // namespace

double middle_of(const Narrow& x) { return (x.low + x.high) / 2; }

Eigen::VectorXd middles(const NarrowBox& box) {
  Eigen::VectorXd q(static_cast<Eigen::Index>(box.size()));
  for (std::size_t i = 0; i < box.size(); ++i) q[static_cast<Eigen::Index>(i)] = middle_of(box[i]);
  return q;
}

double width_of(const NarrowBox& box) {
  double width = 0;
  for (const Narrow& x : box) width = std::max(width, x.high - x.low);
  return width;
}

bool lies_in(const NarrowBox& inner, const NarrowBox& outer) {
  for (std::size_t i = 0; i < inner.size(); ++i) {
    if (!(inner[i].low > outer[i].low && inner[i].high < outer[i].high)) return false;
  }
  return true;
}

Eigen::MatrixXd inverse_of_middles(const std::vector<NarrowBox>& M) {
  const auto n = static_cast<Eigen::Index>(M.size());
  Eigen::MatrixXd middle(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    middle.row(i) = middles(M[static_cast<std::size_t>(i)]).transpose();
  }
  Eigen::MatrixXd inverse = middle.inverse();
  if (!inverse.allFinite()) return {};
  return inverse;
}

NarrowBox product(const Eigen::MatrixXd& Y, const NarrowBox& x) {
  NarrowBox y(x.size());
  for (std::size_t i = 0; i < y.size(); ++i) {
    for (std::size_t j = 0; j < x.size(); ++j) {
      y[i] += Y(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) * x[j];
    }
  }
  return y;
}

std::vector<NarrowBox> deviation(const Eigen::MatrixXd& Y, const std::vector<NarrowBox>& A) {
  const std::size_t n = A.size();
  std::vector<NarrowBox> off(n, NarrowBox(n));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      Narrow sum(i == j ? 1.0 : 0.0);
      for (std::size_t k = 0; k < n; ++k) {
        sum -= Y(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) * A[k][j];
      }
      off[i][j] = sum;
    }
  }
  return off;
}

NarrowBox affine(const NarrowBox& b, const std::vector<NarrowBox>& off, const NarrowBox& x) {
  NarrowBox y = b;
  for (std::size_t i = 0; i < y.size(); ++i) {
    for (std::size_t j = 0; j < x.size(); ++j) y[i] += off[i][j] * x[j];
  }
  return y;
}

NarrowBox solve_near_one(const NarrowBox& b, const std::vector<NarrowBox>& off) {
  double norm = 0, size = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    Narrow sum;
    for (const Narrow& entry : off[i]) sum += Narrow(entry.magnitude());
    if (!(sum.high < 0.9) || !(b[i].magnitude() < kMostSolution)) return {};
    norm = std::max(norm, sum.high);
    size = std::max(size, b[i].magnitude());
  }
  const double most = (Narrow(size) / (Narrow(1.0) - Narrow(norm))).high;
  NarrowBox x(b.size(), Narrow(-most, most));
  for (int i = 0; i < kRefinements; ++i) x = affine(b, off, x);
  return x;
}

}  // namespace maxwrench
