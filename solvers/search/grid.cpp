#include <algorithm>
#include <cmath>

#include "maxwrench/batch.h"
#include "solvers/search/makers.h"
#include "solvers/search/refine.h"

namespace maxwrench {
namespace {

/// Equally spaced points in the unit cube, both ends included; a coordinate with one point only
/// stands in the middle. The first coordinate runs slowest.
class Lattice {
 public:
  /// The largest N with N^d <= 0.9 budget, the same in all d dimensions. Where even 2^d is too
  /// many, the first dimensions get two points, as many as the budget allows, and the others one.
  Lattice(int d, long budget) : points_(d, 1) {
    if (d == 0) return;
    const double share = 0.9 * static_cast<double>(budget);
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
  /// The distance between neighbours along the finest coordinate.
  double spacing() const {
    const long N = points_.empty() ? 1 : points_[0];
    return N == 1 ? 0.5 : 1 / static_cast<double>(N - 1);
  }

  Eigen::VectorXd point(long index) const {
    Eigen::VectorXd x(dimension());
    for (int j = dimension() - 1; j >= 0; --j) {
      const long N = points_[j];
      x[j] = N == 1 ? 0.5 : static_cast<double>(index % N) / static_cast<double>(N - 1);
      index /= N;
    }
    return x;
  }

  /// Whether no neighbour (3^d - 1 of them) is better; of equal neighbours the first counts.
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

/// A grid over the bounds, refined around its best peaks.
///
/// Schedule: N = floor((0.9 budget)^(1/d)) points in each of the d dimensions, the bounds included
/// (600 × 600 for a budget of 400,000 in two dimensions). The rest of the budget refines the best
/// peaks of the grid (points without a better neighbour, at least a sixteenth of the bounds apart;
/// see `refine`), starting with a reach of one cell, until it is used or the reach is below 1e-9.
/// A dimension with lower = upper takes no part. The seed has no effect.
class Grid final : public Search {
 public:
  SearchResult maximize(Objective& objective, const SearchOptions& options) override {
    check(options);
    const Box box(objective);
    const Lattice lattice(box.free(), options.budget);
    EvaluationCounter progress(options.progress);
    auto point = [&](long i) { return box.theta_r(lattice.point(i)); };
    const std::vector<double> values =
        evaluate_all(objective, lattice.size(), point, options.threads, progress);
    Part found;
    std::vector<Candidate> peaks;
    for (long i = 0; i < lattice.size(); ++i) {
      found.trace.add(values[i]);
      if (lattice.is_peak(values, i)) peaks.push_back({point(i), values[i]});
    }
    RefineOptions refinement;
    refinement.step = lattice.spacing();
    refinement.separation = 1.0 / 16;
    refinement.budget = options.budget - lattice.size();
    refinement.threads = options.threads;
    refine(objective, box, std::move(peaks), refinement, progress, found);
    return make_result(found);
  }
};

}  // namespace

std::unique_ptr<Search> make_grid() { return std::make_unique<Grid>(); }

}  // namespace maxwrench
