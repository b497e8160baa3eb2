#include "verify/nearest_means.h"

namespace maxwrench {
namespace {

constexpr int kMostPasses = 100;
/// A mean is closest if no difference of points is nearer to zero by this share of its square.
constexpr double kSharePast = 1e-14;

/// A difference of a point of each list.
struct Difference {
  Eigen::Vector3d x;
  std::size_t a, b;
};

/// Up to four differences, and their mean that is nearest to zero.
struct Differences {
  std::array<Difference, 4> each;
  std::array<double, 4> weight{};
  std::size_t size = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
};

std::size_t farthest_along(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& d) {
  std::size_t found = 0;
  double most = -kInfinity;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double along = d.dot(points[i]);
    if (!(along > most)) continue;
    most = along;
    found = i;
  }
  return found;
}

/// The affine mean of some differences that is nearest to zero, if all its weights are positive.
bool take_mean(const Differences& of, unsigned members, Differences& result) {
  result.size = 0;
  for (std::size_t i = 0; i < of.size; ++i) {
    if ((members >> i & 1U) != 0) result.each[result.size++] = of.each[i];
  }
  const Eigen::Vector3d& first = result.each[0].x;
  result.weight = {1, 0, 0, 0};
  result.mean = first;
  if (result.size == 1) return true;
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> edges(
      3, static_cast<Eigen::Index>(result.size - 1));
  for (std::size_t i = 1; i < result.size; ++i) {
    edges.col(static_cast<Eigen::Index>(i - 1)) = result.each[i].x - first;
  }
  const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> t =
      edges.colPivHouseholderQr().solve(-first);
  result.mean = first + edges * t;
  for (std::size_t i = 1; i < result.size; ++i) {
    result.weight[i] = t[static_cast<Eigen::Index>(i - 1)];
    result.weight[0] -= result.weight[i];
  }
  for (std::size_t i = 0; i < result.size; ++i) {
    if (!(result.weight[i] > 0)) return false;
  }
  return true;
}

/// Sets the best mean that has the last difference in it. False if there is none better.
bool improve(Differences& best) {
  const Differences all = best;
  double least = all.size > 1 ? all.mean.squaredNorm() : kInfinity;
  bool better = false;
  for (unsigned members = 1U << (all.size - 1); members < 1U << all.size; ++members) {
    Differences some;
    if (!take_mean(all, members, some) || !(some.mean.squaredNorm() < least)) continue;
    least = some.mean.squaredNorm();
    best = some;
    better = true;
  }
  return better;
}

}  // namespace

Eigen::Vector3d WeightedMean::of(const std::vector<Eigen::Vector3d>& points) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weights = 0;
  for (std::size_t i = 0; i < size; ++i) {
    sum += weight[i] * points[index[i]];
    weights += weight[i];
  }
  return sum / weights;
}

/// The algorithm of Gilbert, Johnson and Keerthi: the difference that is farthest towards zero
/// joins those of the last mean, until there is none.
NearestMeans nearest_means(const std::vector<Eigen::Vector3d>& a,
                           const std::vector<Eigen::Vector3d>& b) {
  Differences best;
  best.mean = a[0] - b[0];
  for (int pass = 0; pass < kMostPasses; ++pass) {
    const std::size_t i = farthest_along(a, -best.mean), j = farthest_along(b, best.mean);
    const Eigen::Vector3d x = a[i] - b[j];
    const double squared = best.mean.squaredNorm();
    const bool closest = squared - best.mean.dot(x) <= kSharePast * squared;
    if (best.size > 0 && (best.size == 4 || closest)) break;
    const Differences before = best;
    best.each[best.size++] = {x, i, j};
    if (improve(best)) continue;
    best = before;
    break;
  }
  NearestMeans result;
  for (std::size_t i = 0; i < best.size; ++i) {
    const Difference& each = best.each[i];
    for (const auto& [to, index] : {std::pair(&result.a, each.a), std::pair(&result.b, each.b)}) {
      to->index[to->size] = index;
      to->weight[to->size++] = best.weight[i];
    }
  }
  return result;
}

}  // namespace maxwrench
