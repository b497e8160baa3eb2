#include "benchmarks/comparison.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>

#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"

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
  const Verdict& verdict() const override { return objective_->verdict(); }
  bool ended() const override { return objective_->ended(); }
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

bool has_reference(const Case& base) {
  const auto table = wrench_solvers();
  return find_measure(base.measure).needs_solver &&
         std::any_of(table.begin(), table.end(),
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

Attempt attempt(const Problem& problem, const Method& method, Interruption* interruption) {
  Attempt run;
  run.choice = method.choice;
  const double start = processor_seconds();
  Stopwatch objective(make_interruptible(make_capability_objective(problem, method.choice.wrench,
                                                                   method.make_measure),
                                         interruption),
                      run, start);
  SearchOptions options;
  options.seed = method.choice.seed;
  options.budget = method.choice.budget;
  options.start = problem.theta_r_default;
  const SearchResult result = method.search->make()->maximize(objective, options);
  run.seconds = processor_seconds() - start;
  run.value = result.value;
  run.evaluations = result.evaluations;
  run.history = result.history;
  return run;
}

double Contender::shortfall_after(double evaluations, double best) const {
  if (best == 0 || best == -kInfinity) return kInfinity;
  std::vector<double> shortfalls;
  for (const Attempt& each : attempts)
    shortfalls.push_back((best - each.value_after(evaluations)) / std::abs(best));
  return median(shortfalls);
}

double Comparison::best() const {
  double best = -kInfinity;
  for (const Contender& contender : contenders)
    for (const Attempt& each : contender.attempts) best = std::max(best, each.value);
  for (const Attempt& each : reference.attempts) best = std::max(best, each.value);
  return best;
}

double Comparison::target() const {
  return has_value() ? best() - 1e-3 * std::abs(best()) : kInfinity;
}

Comparison compare(const Problem& problem, const Case& base, int seeds,
                   const std::function<void()>& done, Interruption* interruption) {
  const auto interrupted = [&] { return interruption != nullptr && interruption->asked; };
  const auto contend = [&](const char* search, const std::string& lp) {
    Contender contender{search, lp, {}};
    for (int seed = 1; seed <= seeds && !interrupted(); ++seed) {
      Case c = base;
      c.problem = problem.name;
      c.search = search;
      c.lp = lp;
      c.seed = static_cast<std::uint64_t>(seed);
      contender.attempts.push_back(attempt(problem, resolve(problem, c), interruption));
      done();
    }
    return contender;
  };
  const Method method = resolve(problem, base);
  Comparison comparison{problem.name, method.unit, {}, {}, false};
  for (const SearchEntry& search : searches())
    comparison.contenders.push_back(contend(search.name, method.choice.lp));
  if (has_reference(base)) comparison.reference = contend(kReferenceSearch, kReferenceSolver);
  comparison.interrupted = interrupted();
  return comparison;
}

long attempt_count(const Case& base, int seeds) {
  return (static_cast<long>(searches().size()) + (has_reference(base) ? 1 : 0)) * seeds;
}

double median(std::vector<double> values) {
  if (values.empty()) return kInfinity;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  if (values.size() % 2 == 1) return values[half];
  return values[half] == kInfinity ? kInfinity : (values[half - 1] + values[half]) / 2;
}

}  // namespace maxwrench
