#include <algorithm>
#include <cmath>

#include "lib/math/random.h"
#include "maxwrench/batch.h"
#include "solvers/search/makers.h"
#include "solvers/search/probe.h"

namespace maxwrench {
namespace {

constexpr double kColdest = 1e-4;  // last temperature over the first
constexpr int kAdaptEvery = 20;    // proposals between two changes of the step
constexpr double kMinStep = 1e-5, kMaxStep = 0.5;

/// Reflects x at the ends of [0, 1].
double reflect(double x) {
  x = std::fmod(std::abs(x), 2.0);
  return x > 1 ? 2 - x : x;
}

/// One Markov chain, with its own clone of the objective and its own random numbers.
class Chain {
 public:
  Chain(Probe& probe, const Box& box, Random random) : probe_(probe), box_(box), random_(random) {}

  /// Uses all evaluations of the probe.
  void run(const Eigen::VectorXd* start) {
    const long budget = probe_.left();
    const long scouts = std::max(1L, budget / 10);
    for (long i = 0; i < scouts && probe_.left() > 0; ++i) {
      if (i == 0 && start != nullptr)
        scout(box_.unit(*start), *start);
      else
        scout(uniform());
    }
    const long steps = budget - scouts;
    for (long k = 0; k < steps && probe_.left() > 0; ++k) {
      const double progress = static_cast<double>(k) / static_cast<double>(steps);
      if (value_ == -kInfinity)
        scout(uniform());
      else
        propose(temperature() * std::pow(kColdest, progress));
      if ((k + 1) % kAdaptEvery == 0) adapt();
    }
  }

 private:
  Eigen::VectorXd uniform() {
    Eigen::VectorXd x(box_.free());
    for (double& x_j : x) x_j = random_.uniform();
    return x;
  }

  /// Evaluates a point of the sample. The walk starts at the best one.
  void scout(const Eigen::VectorXd& x) { scout(x, box_.theta_r(x)); }
  void scout(const Eigen::VectorXd& x, const Eigen::VectorXd& theta_r) {
    const double value = probe_.evaluate(theta_r);
    if (value == -kInfinity) return;
    ++count_;
    const double change = value - mean_;
    mean_ += change / count_;
    square_ += change * (value - mean_);
    if (value > value_) move(x, value);
  }

  /// The initial temperature: the standard deviation of the sample, or a tenth of the value if that
  /// is not usable.
  double temperature() const {
    return count_ < 3 ? 0.1 * std::abs(value_) : std::sqrt(square_ / (count_ - 1));
  }

  void propose(double temperature) {
    Eigen::VectorXd x = x_;
    const double step = step_ / std::sqrt(static_cast<double>(box_.free()));
    for (double& x_j : x) x_j = reflect(x_j + step * random_.normal());
    // Drawn in any case, so that the stream does not depend on the outcome.
    const double threshold = temperature * std::log1p(-random_.uniform());
    const double value = probe_.evaluate(box_.theta_r(x));
    if (!(value - value_ >= threshold)) return;
    move(x, value);
    ++accepted_;
  }

  void move(const Eigen::VectorXd& x, double value) {
    x_ = x;
    value_ = value;
  }

  void adapt() {
    const double rate = static_cast<double>(accepted_) / kAdaptEvery;
    if (rate > 0.45) step_ = std::min(kMaxStep, 1.5 * step_);
    if (rate < 0.3) step_ = std::max(kMinStep, step_ / 1.5);
    accepted_ = 0;
  }

  Probe& probe_;
  const Box& box_;
  Random random_;
  Eigen::VectorXd x_;
  double value_ = -kInfinity;
  double step_ = 0.25;
  int accepted_ = 0;
  double count_ = 0, mean_ = 0, square_ = 0;  // of the sample: Welford's running moments
};

/// Simulated annealing with restarts (Kirkpatrick, Gelatt, Vecchi 1983).
///
/// The budget is split among r = sqrt(budget/180) independent chains (1 to 32), each with its own
/// stream of random numbers. A chain first samples the bounds with a tenth of its steps. The sample
/// begins with a point of the earlier search, if there is one; without an earlier search, the first
/// chain's sample begins with `start`. The chain walks from the best point of the sample. Its
/// temperature begins at the sample's standard deviation and falls geometrically to 1e-4 of it. A
/// proposal is a normal step of all coordinates, reflected at the bounds, with a length adapted to
/// an acceptance of 30 to 45 %. A point without a value is never accepted; a chain that has found
/// no point with a value continues to sample.
class Annealing final : public Search {
 public:
  SearchResult maximize(Objective& objective, const SearchOptions& options) override {
    check(options, objective);
    const Box box(objective);
    SearchRun run(options);
    const long walking = box.free() == 0 ? 1 : options.budget;
    const long wanted = std::lround(std::sqrt(static_cast<double>(walking) / 180));
    const long chains = std::min(walking, std::clamp(wanted, 1L, 32L));
    std::vector<Eigen::VectorXd> starts;
    for (const Candidate& start : options.starts) starts.push_back(start.theta_r);
    if (starts.empty()) starts.push_back(box.start(options.start));
    std::vector<Part> parts(chains);
    parallel_for(options.threads, chains, [&](long i) {
      const long length = walking / chains + (i < walking % chains ? 1 : 0);
      Probe probe(objective, length, run, options.starts_wanted > 0 ? &box : nullptr);
      const bool given = i < static_cast<long>(starts.size());
      Chain(probe, box, Random(options.seed, RandomUse::kLocalSearch, i))
          .run(given ? &starts[i] : nullptr);
      parts[i] = probe.take();
    });
    Part found;
    join(parts, found);
    return make_result(std::move(found), box, options, run);
  }
};

}  // namespace

std::unique_ptr<Search> make_annealing() { return std::make_unique<Annealing>(); }

}  // namespace maxwrench
