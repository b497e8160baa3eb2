#include <algorithm>
#include <cmath>

#include "maxwrench/batch.h"
#include "solvers/search/makers.h"
#include "solvers/search/probe.h"

namespace maxwrench {
namespace {

/// Equally spaced points in the unit cube, both ends included. A coordinate with only one point has
/// it in the middle. The first coordinate changes slowest.
class Lattice {
 public:
  /// Uses the largest N with N^d <= budget in all d dimensions. If even 2^d points are too many,
  /// the first dimensions have two points, as many dimensions as the budget allows, and the others
  /// one.
  Lattice(int d, long budget) : points_(d, 1) {
    if (d == 0) return;
    const auto share = static_cast<double>(budget);
    auto fits = [&](double N) { return std::pow(N, d) <= share; };
    long N = std::lround(std::pow(share, 1.0 / d)) + 1;
    while (N > 1 && !fits(static_cast<double>(N))) --N;
    points_.assign(d, N);
    if (N > 1) return;
    for (int j = 0; j < d && 2 * size() <= budget; ++j) points_[j] = 2;
  }

  long size() const {
    long product = 1;
    for (const long n : points_) product *= n;
    return product;
  }
  int dimension() const { return static_cast<int>(points_.size()); }

  Eigen::VectorXd point(long index) const {
    Eigen::VectorXd x(dimension());
    for (int j = dimension() - 1; j >= 0; --j) {
      const long N = points_[j];
      x[j] = N == 1 ? 0.5 : static_cast<double>(index % N) / static_cast<double>(N - 1);
      index /= N;
    }
    return x;
  }

  /// Whether none of the 3^d - 1 neighbours is better; of equal neighbours, the first is better.
  bool is_peak(const std::vector<double>& values, long index) const {
    if (values[index] == -kInfinity) return false;
    return !has_better(values, index, index, 0, size());
  }

 private:
  bool has_better(const std::vector<double>& values, long centre, long index, int j,
                  long block) const {
    if (j == dimension())
      return values[index] > values[centre] || (values[index] == values[centre] && index < centre);
    const long stride = block / points_[j];
    const long k = centre / stride % points_[j];
    for (long i = std::max(0L, k - 1); i <= std::min(points_[j] - 1, k + 1); ++i)
      if (has_better(values, centre, index + (i - k) * stride, j + 1, stride)) return true;
    return false;
  }

  std::vector<long> points_;
};

/// A regular grid over the bounds: N = floor(budget^(1/d)) points in each of the d dimensions, the
/// bounds included. Dimensions with lower = upper are ignored. The seed has no effect. A later
/// search gets its peaks, the points without a better neighbour.
class Grid final : public Search {
 public:
  SearchResult maximize(Objective& objective, const SearchOptions& options) override {
    check(options, objective);
    const Box box(objective);
    const Lattice lattice(box.free(), options.budget);
    SearchRun run(options);
    auto point = [&](long i) { return box.theta_r(lattice.point(i)); };
    std::vector<double> values =
        evaluate_all(objective, lattice.size(), point, options.threads, run);
    Part found;
    add(values, point, found);
    for (long i = 0; options.starts_wanted > 0 && i < lattice.size(); ++i) {
      if (lattice.is_peak(values, i)) found.starts.push_back({point(i), values[i]});
    }
    return make_result(std::move(found), box, options, run);
  }
};

}  // namespace

std::unique_ptr<Search> make_grid() { return std::make_unique<Grid>(); }

}  // namespace maxwrench
