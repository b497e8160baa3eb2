#include "benchmarks/comparison.h"

#include <algorithm>
#include <ctime>
#include <memory>

#include "solvers/strategies.h"

namespace maxwrench {
namespace {

constexpr const char* kReferenceSearch = "annealing";
constexpr const char* kReferenceSolver = "glpk";

double processor_seconds() {
  return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

/// An objective that notes when its best value rises, over all clones. For one thread.
class Stopwatch final : public Objective {
 public:
  Stopwatch(std::unique_ptr<Objective> objective, Attempt& attempt, double start)
      : objective_(std::move(objective)), attempt_(attempt), start_(start) {}

  const Eigen::VectorXd& lower() const override { return objective_->lower(); }
  const Eigen::VectorXd& upper() const override { return objective_->upper(); }
  Status status() const override { return objective_->status(); }
  const char* reason() const override { return objective_->reason(); }
  void metric(const Eigen::VectorXd& theta_r, Eigen::MatrixXd& M) override {
    objective_->metric(theta_r, M);
  }
  double evaluate(const Eigen::VectorXd& theta_r, Eigen::VectorXd* gradient) override {
    const double value = objective_->evaluate(theta_r, gradient);
    std::vector<double>& values = attempt_.improved_to;
    if (value > (values.empty() ? -kInfinity : values.back())) {
      values.push_back(value);
      attempt_.improved_at.push_back(processor_seconds() - start_);
    }
    return value;
  }
  std::unique_ptr<Objective> clone() const override {
    return std::make_unique<Stopwatch>(objective_->clone(), attempt_, start_);
  }

 private:
  std::unique_ptr<Objective> objective_;
  Attempt& attempt_;
  double start_;
};

bool has_reference() {
  const auto table = wrench_solvers();
  return std::any_of(table.begin(), table.end(),
                     [](const auto& entry) { return entry.name == std::string(kReferenceSolver); });
}

}  // namespace

double Attempt::evaluations_to(double target) const {
  for (const Improvement& rise : history)
    if (rise.value >= target) return static_cast<double>(rise.evaluations);
  return kInfinity;
}

double Attempt::seconds_to(double target) const {
  for (std::size_t i = 0; i < improved_to.size(); ++i)
    if (improved_to[i] >= target) return improved_at[i];
  return kInfinity;
}

double Attempt::value_after(double count) const {
  double best = -kInfinity;
  for (const Improvement& rise : history)
    if (static_cast<double>(rise.evaluations) <= count) best = rise.value;
  return best;
}

Attempt attempt(const Problem& problem, const Case& c) {
  Attempt run;
  run.choice = c;
  const double start = processor_seconds();
  Stopwatch objective(make_capability_objective(problem, c.wrench, measure_maker(problem, c)), run,
                      start);
  SearchOptions options;
  options.seed = c.seed;
  options.budget = c.budget;
  options.start = problem.theta_r_default;
  const SearchResult result = find_search(c.search).make()->maximize(objective, options);
  run.seconds = processor_seconds() - start;
  run.value = result.value;
  run.evaluations = result.evaluations;
  run.history = result.history;
  return run;
}

double Comparison::best() const {
  double best = -kInfinity;
  for (const Contender& contender : contenders)
    for (const Attempt& each : contender.attempts) best = std::max(best, each.value);
  for (const Attempt& each : reference.attempts) best = std::max(best, each.value);
  return best;
}

double Comparison::target() const { return best() - 1e-3 * std::abs(best()); }

Comparison compare(const Problem& problem, const Case& base, int seeds,
                   const std::function<void()>& done) {
  const auto contend = [&](const char* search, const std::string& lp, int count) {
    Contender contender{search, lp, {}};
    for (int seed = 1; seed <= count; ++seed) {
      Case c = base;
      c.problem = problem.name;
      c.search = search;
      c.lp = lp;
      c.seed = static_cast<std::uint64_t>(seed);
      contender.attempts.push_back(attempt(problem, complete(c)));
      done();
    }
    return contender;
  };
  Comparison comparison{problem.name, problem.unit(), {}, {}};
  for (const SearchEntry& search : searches())
    comparison.contenders.push_back(contend(search.name, complete(base).lp, seeds));
  if (has_reference()) comparison.reference = contend(kReferenceSearch, kReferenceSolver, seeds);
  return comparison;
}

long attempt_count(int seeds) {
  return (static_cast<long>(searches().size()) + (has_reference() ? 1 : 0)) * seeds;
}

double median(std::vector<double> values) {
  if (values.empty()) return kInfinity;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  if (values.size() % 2 == 1) return values[half];
  return values[half] == kInfinity ? kInfinity : (values[half - 1] + values[half]) / 2;
}

}  // namespace maxwrench
