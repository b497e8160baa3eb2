#include "solvers/search/refine.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lib/math/decompositions.h"
#include "lib/math/random.h"

namespace maxwrench {
namespace {

/// The numbers of CMA-ES that depend on the dimension d only (names as in Hansen's tutorial).
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

  /// Nothing sampled has a value: back to the best point, and closer.
  void retreat(const Eigen::VectorXd& best) {
    mean_ = best;
    sigma_ /= 2;
  }

  /// `ranked`: the mu best samples, best first.
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

/// One ascent of one candidate, with its own random numbers.
class Ascent {
 public:
  Ascent(Probe& probe, const Box& box, const Candidate& start, Random random)
      : probe_(probe), box_(box), rates_(box.free()), best_(start), random_(random) {}

  /// Spends the evaluations of the probe, or fewer.
  Candidate run(double step, double tolerance) {
    int idle = 0;
    for (int start = 0; probe_.left() > 0 && idle < 2; ++start) {
      const double before = best_.value;
      climb(start % 2 == 0 ? step : step / 100, tolerance);
      // Rounding alone, as on a flat maximum, is no progress.
      idle = best_.value > before + 1e-13 * std::abs(before) ? 0 : idle + 1;
    }
    return best_;
  }

 private:
  void climb(double step, double tolerance) {
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
      // Too few points with a value: the best one takes the places of the rest.
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

}  // namespace

std::vector<Candidate> select_apart(const Box& box, std::vector<Candidate> candidates,
                                    double separation, long count) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.value > b.value; });
  std::vector<Candidate> selected;
  for (const Candidate& candidate : candidates) {
    if (static_cast<long>(selected.size()) == count || candidate.value == -kInfinity) break;
    const Eigen::VectorXd x = box.unit(candidate.theta_r);
    const bool close = std::any_of(selected.begin(), selected.end(), [&](const Candidate& other) {
      return (box.unit(other.theta_r) - x).lpNorm<Eigen::Infinity>() < separation;
    });
    if (!close) selected.push_back(candidate);
  }
  return selected;
}

void refine(const Objective& objective, const Box& box, std::vector<Candidate> candidates,
            const RefineOptions& options, EvaluationCounter& progress, Part& found) {
  const long shared = options.budget / 2;
  const long count = std::clamp(shared / (100L * (box.free() + 1)), 1L, options.ascents);
  std::vector<Candidate> best = select_apart(box, std::move(candidates), options.separation, count);
  if (best.empty()) return;
  if (best[0].value > found.best.value) found.best = best[0];
  if (box.free() == 0 || options.budget <= 0) return;
  const long before = found.trace.evaluations();
  const auto ascend = [&](const Candidate& start, long budget, std::uint64_t stream) {
    Probe probe(objective, budget, progress);
    Part part;
    part.best = Ascent(probe, box, start, Random(options.seed, RandomUse::kRefine, stream))
                    .run(options.step, options.tolerance);
    part.trace = probe.found().trace;
    return part;
  };
  const long share = best.size() == 1 ? 0 : shared / static_cast<long>(best.size());
  std::vector<Part> parts(share == 0 ? 0 : best.size());
  parallel_for(options.threads, static_cast<long>(parts.size()),
               [&](long i) { parts[i] = ascend(best[i], share, i + 1); });
  join(parts, found);
  const long rest = options.budget - (found.trace.evaluations() - before);
  join({ascend(found.best, rest, 0)}, found);
}

}  // namespace maxwrench
