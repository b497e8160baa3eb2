#include <algorithm>
#include <cmath>
#include <numeric>

#include "lib/math/decompositions.h"
#include "lib/math/random.h"
#include "solvers/search/local_search.h"
#include "solvers/search/makers.h"

namespace maxwrench {
namespace {

/// The parameters of CMA-ES that depend only on the dimension d (names as in Hansen's tutorial).
struct Rates {
  explicit Rates(int d) : lambda(6 + 3 * d), mu(lambda / 2), weights(mu) {
    for (int i = 0; i < mu; ++i) weights[i] = std::log((lambda + 1) / 2.0) - std::log(i + 1.0);
    weights /= weights.sum();
    mu_eff = 1 / weights.squaredNorm();
    c_sigma = (mu_eff + 2) / (d + mu_eff + 5);
    d_sigma = 1 + 2 * std::max(0.0, std::sqrt((mu_eff - 1) / (d + 1)) - 1) + c_sigma;
    c_c = (4 + mu_eff / d) / (d + 4 + 2 * mu_eff / d);
    c_1 = 2 / ((d + 1.3) * (d + 1.3) + mu_eff);
    c_mu = std::min(1 - c_1, 2 * (mu_eff - 2 + 1 / mu_eff) / ((d + 2.0) * (d + 2.0) + mu_eff));
    chi = std::sqrt(d) * (1 - 1 / (4.0 * d) + 1 / (21.0 * d * d));
  }

  int lambda, mu;
  Eigen::VectorXd weights;
  double mu_eff, c_sigma, d_sigma, c_c, c_1, c_mu, chi;
};

/// One run of CMA-ES in the unit cube: normal samples around `mean` with covariance sigma^2 C.
class Evolution {
 public:
  Evolution(const Rates& rates, const Eigen::VectorXd& mean, double sigma)
      : rates_(rates),
        mean_(mean),
        path_sigma_(Eigen::VectorXd::Zero(mean.size())),
        path_c_(path_sigma_),
        C_(Eigen::MatrixXd::Identity(mean.size(), mean.size())),
        axes_(C_),
        lengths_(Eigen::VectorXd::Ones(mean.size())),
        sigma_(sigma) {}

  /// The standard deviation along the longest axis.
  double reach() const { return sigma_ * lengths_.maxCoeff(); }

  Eigen::VectorXd sample(Random& random) const {
    Eigen::VectorXd z(mean_.size());
    for (double& z_i : z) z_i = random.normal();
    const Eigen::VectorXd x = mean_ + sigma_ * (axes_ * lengths_.cwiseProduct(z));
    return x.cwiseMax(0).cwiseMin(1);
  }

  /// For a generation without any value: returns to the best point with a smaller step.
  void retreat(const Eigen::VectorXd& best) {
    mean_ = best;
    sigma_ /= 2;
  }

  /// `ranked` holds the mu best samples, best first.
  void update(const std::vector<Eigen::VectorXd>& ranked) {
    const Rates& r = rates_;
    Eigen::MatrixXd Y(mean_.size(), r.mu);
    for (int i = 0; i < r.mu; ++i) Y.col(i) = (ranked[i] - mean_) / sigma_;
    const Eigen::VectorXd y = Y * r.weights;
    mean_ += sigma_ * y;
    const Eigen::VectorXd white =
        axes_ * (axes_.transpose() * y).cwiseQuotient(lengths_.cwiseMax(1e-150));
    path_sigma_ =
        (1 - r.c_sigma) * path_sigma_ + std::sqrt(r.c_sigma * (2 - r.c_sigma) * r.mu_eff) * white;
    const double ratio = path_sigma_.norm() / r.chi;
    const double h = ratio < 1.4 + 2.0 / (static_cast<double>(mean_.size()) + 1) ? 1 : 0;
    path_c_ = (1 - r.c_c) * path_c_ + h * std::sqrt(r.c_c * (2 - r.c_c) * r.mu_eff) * y;
    const double kept = 1 - r.c_1 - r.c_mu + (1 - h) * r.c_1 * r.c_c * (2 - r.c_c);
    C_ = (kept * C_ + r.c_1 * path_c_ * path_c_.transpose() +
          r.c_mu * Y * r.weights.asDiagonal() * Y.transpose())
             .eval();
    sigma_ *= std::exp(std::min(1.0, r.c_sigma / r.d_sigma * (ratio - 1)));
    decompose();
  }

 private:
  void decompose() {
    const SymmetricEigen eigen = symmetric_eigen(C_);
    axes_ = eigen.V;
    // Rounding may leave a negative eigenvalue where C is nearly flat.
    const double floor = 1e-14 * eigen.values.maxCoeff();
    lengths_ = eigen.values.cwiseMax(floor).cwiseSqrt();
  }

  const Rates& rates_;
  Eigen::VectorXd mean_, path_sigma_, path_c_;
  Eigen::MatrixXd C_, axes_;
  Eigen::VectorXd lengths_;
  double sigma_;
};

/// One local search from one candidate, with its own random numbers.
class CmaesRun {
 public:
  CmaesRun(Probe& probe, const Box& box, const Candidate& start, Random random)
      : probe_(probe), box_(box), rates_(box.free()), best_(start), random_(random) {}

  /// Uses the evaluations of the probe, or fewer.
  void run(double step, double tolerance) {
    int idle = 0;
    for (int start = 0; probe_.left() > 0 && idle < 2; ++start) {
      const double before = best_.value;
      optimise(start % 2 == 0 ? step : step / 100, tolerance);
      // A change by rounding only, as on a flat maximum, is not progress.
      idle = best_.value > before + 1e-13 * std::abs(before) ? 0 : idle + 1;
    }
  }

 private:
  void optimise(double step, double tolerance) {
    Evolution evolution(rates_, box_.unit(best_.theta_r), step);
    while (probe_.left() > 0 && evolution.reach() > tolerance)
      generation(std::min<long>(rates_.lambda, probe_.left()), evolution);
  }

  void generation(long size, Evolution& evolution) {
    std::vector<Eigen::VectorXd> samples(size);
    std::vector<double> values(size);
    for (long i = 0; i < size; ++i) {
      samples[i] = evolution.sample(random_);
      const Eigen::VectorXd theta_r = box_.theta_r(samples[i]);
      values[i] = probe_.evaluate(theta_r);
      if (values[i] > best_.value) best_ = {theta_r, values[i]};
    }
    if (size < rates_.lambda) return;  // the budget is used
    std::vector<long> order(size);
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](long a, long b) { return values[a] > values[b]; });
    if (values[order[0]] == -kInfinity) {
      evolution.retreat(box_.unit(best_.theta_r));
      return;
    }
    std::vector<Eigen::VectorXd> ranked;
    for (int i = 0; i < rates_.mu; ++i) {
      // If too few points have a value, the best one replaces the others.
      const long k = values[order[i]] == -kInfinity ? order[0] : order[i];
      ranked.push_back(samples[k]);
    }
    evolution.update(ranked);
  }

  Probe& probe_;
  const Box& box_;
  Rates rates_;
  Candidate best_;
  Random random_;
};

constexpr double kFirstStep = 0.3;       // from a random point, as a share of the bounds
constexpr double kNearStep = 0.02;       // from a point of an earlier search
constexpr double kTolerance = 1e-9;      // a local search ends when its reach is below this
constexpr long kMostLocalSearches = 24;  // from points of an earlier search

/// Continues from the best points of an earlier search. Up to 24 points, best first, share half of
/// the budget; there are no more of them than get 120 (d + 1) evaluations each. The best of their
/// results gets the rest of the budget.
void ascend_from(const Objective& objective, const Box& box, const SearchOptions& options,
                 SearchRun& run, Part& found) {
  const long half = options.budget / 2;
  const auto known = static_cast<long>(options.starts.size());
  const long count =
      std::min(known, std::clamp(half / (120L * (box.free() + 1)), 1L, kMostLocalSearches));
  const auto ascend = [&](const Candidate& start, long budget, std::uint64_t stream) {
    Probe probe(objective, budget, run, options.starts_wanted > 0 ? &box : nullptr);
    Random random(options.seed, RandomUse::kRefine, stream);
    CmaesRun(probe, box, start, random).run(kNearStep, kTolerance);
    const char* const word = probe.left() > 0 ? "converged" : kBudgetUsed;
    Part part = probe.take();
    part.calls.push_back({"cmaes", word, part.trace.evaluations()});
    return part;
  };
  const long share = count == 1 ? 0 : half / count;
  std::vector<Part> parts(share == 0 ? 0 : static_cast<std::size_t>(count));
  parallel_for(options.threads, static_cast<long>(parts.size()),
               [&](long i) { parts[i] = ascend(options.starts[i], share, i + 1); });
  join(parts, found);
  const bool risen = found.best.value > options.starts.front().value;
  const Candidate best = risen ? found.best : options.starts.front();
  join({ascend(best, options.budget - found.trace.evaluations(), 0)}, found);
}

/// An evolution strategy with covariance matrix adaptation (CMA-ES; Hansen, "The CMA Evolution
/// Strategy: A Tutorial", 2016) in the unit cube, projected onto the bounds. A capability is
/// piecewise smooth: its maxima often lie on sharp ridges that are not parallel to the axes, where
/// compass search and shrinking grids stall. The covariance adapts to the ridge. Points without a
/// value rank last.
///
/// Without an earlier search, local searches start from random points; otherwise first from its
/// points, see `ascend_from`, and then from random points. A local search that has converged starts
/// again at its best point, alternately with the first step and with a hundredth of it, until two
/// starts in a row bring no progress.
class Cmaes final : public Search {
 public:
  SearchResult maximize(Objective& objective, const SearchOptions& options) override {
    LocalSearch local_search{"cmaes"};
    local_search.evaluations_per_run = 5000;
    local_search.optimise = [](Probe& probe, const Box& box, const Candidate& start,
                               Random& random) {
      CmaesRun(probe, box, start, random).run(kFirstStep, kTolerance);
      return probe.left() > 0 ? "converged" : kBudgetUsed;
    };
    if (options.starts.empty()) return multistart_search(objective, options, local_search);
    check(options, objective);
    const Box box(objective);
    SearchRun run(options);
    Part found;
    if (box.free() > 0) ascend_from(objective, box, options, run, found);
    SearchOptions anew = options;
    anew.starts.clear();
    if (box.free() > 0) multistart_from(objective, box, anew, local_search, run, found);
    return make_result(std::move(found), box, options, run);
  }
};

}  // namespace

std::unique_ptr<Search> make_cmaes() { return std::make_unique<Cmaes>(); }

}  // namespace maxwrench
