#include "benchmarks/comparison.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>

#include "benchmarks/plan_row.h"
#include "benchmarks/row.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"

namespace maxwrench {
namespace {

/// The names of a `Comparison::reference`.
struct Reference {
  const char *search, *solver;
};
constexpr Reference kOfPostures{"annealing+cmaes", "glpk"}, kOfPlans{"multistart", "clp"};

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
  PlanEvaluator* plans() override { return objective_->plans(); }
  FacetProgram* facets() override { return objective_->facets(); }
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

Reference reference_of(const Problem& problem) { return problem.motion ? kOfPlans : kOfPostures; }

bool has_reference(const Problem& problem, const Case& base) {
  const auto holds = [](const auto& table, const char* name) {
    return std::any_of(table.begin(), table.end(),
                       [&](const auto& entry) { return entry.name == std::string(name); });
  };
  const Reference reference = reference_of(problem);
  const bool built_in = !problem.motion || holds(searches(), reference.search);
  return find_measure(base.measure).needs_solver && built_in &&
         holds(lp_solvers(), reference.solver);
}

/// The searches that serve a problem: of a task in time those of plans first, of a static one the
/// default first and the tables that serve it last.
std::vector<std::string> searches_of(const Problem& problem, const Case& base) {
  std::vector<std::string> served;
  const auto add = [&](std::span<const SearchEntry> table) {
    for (const SearchEntry& search : table) served.push_back(search.name);
  };
  if (!problem.motion) served.push_back(best_search(problem, base.measure));
  if (problem.motion) add(plan_searches());
  add(searches());
  if (!problem.motion && serves_as_plan(problem, base.measure)) add(plan_searches());
  if (serves_between_facets(problem, base.measure)) add(facet_searches());
  return served;
}

/// What was noted while the search looked beyond the plan that it chose (`slp` leaves out those
/// that are worth less between their instants) is no rise of its answer.
void forget_beyond(Attempt& run) {
  std::vector<double>&at = run.improved_at, &to = run.improved_to;
  const auto beyond = std::upper_bound(to.begin(), to.end(), run.value) - to.begin();
  at.erase(at.begin() + beyond, at.end());
  to.erase(to.begin() + beyond, to.end());
  if (run.value > (to.empty() ? -kInfinity : to.back())) {
    at.push_back(run.seconds);
    to.push_back(run.value);
  }
}

/// From `start`; `found` gets the best point, if there is one.
Attempt attempt_from(const Case& choice, const NamedSearch& named,
                     std::unique_ptr<Objective> objective, const Eigen::VectorXd& start,
                     Eigen::VectorXd& found) {
  Attempt run;
  run.choice = choice;
  const double begin = processor_seconds();
  Stopwatch watch(std::move(objective), run, begin);
  const SearchResult result = search(choice, named, watch, start, 1, {});
  run.seconds = processor_seconds() - begin;
  run.value = result.value;
  run.evaluations = result.evaluations;
  run.history = result.history;
  forget_beyond(run);
  found = result.theta_r;
  return run;
}

/// Of a case on its problem.
Attempt attempt_case(const Problem& problem, const Case& c, Interruption* interruption) {
  return problem.motion ? attempt(problem, resolve_plan(problem, c), interruption)
                        : attempt(problem, resolve(problem, c), interruption);
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
  Eigen::VectorXd found;
  Attempt run = attempt_from(method.choice, *method.search,
                             make_interruptible(make_objective(problem, method), interruption),
                             problem.theta_r_default, found);
  // What a search of plans maximises has a value where only slack balances a posture.
  if (method.plan_solver && run.value > -kInfinity &&
      !evaluate(problem, method, found).has_value()) {
    run.value = -kInfinity;
    run.history.clear();
    forget_beyond(run);
  }
  return run;
}

Attempt attempt(const Problem& problem, const PlanMethod& method, Interruption* interruption) {
  Eigen::VectorXd found;
  Attempt run = attempt_from(
      method.choice, *method.search,
      make_interruptible(make_plan_objective(problem, method.choice.wrench, method.solver->make),
                         interruption),
      stacked(constant_knots(problem, problem.theta_r_default)), found);
  if (run.value > -kInfinity) {
    run.continuous =
        evaluate_plan(problem, method, unstacked(found, knots_of(problem))).plan.continuous;
  }
  return run;
}

double Contender::shortfall_after(double evaluations, double best) const {
  if (best == 0 || best == -kInfinity) return kInfinity;
  std::vector<double> shortfalls;
  for (const Attempt& each : attempts)
    shortfalls.push_back((best - each.value_after(evaluations)) / std::abs(best));
  return median(shortfalls);
}

double Contender::expected_seconds(double target) const {
  double seconds = 0;
  int reached = 0;
  for (const Attempt& each : attempts) {
    const double to = each.seconds_to(target);
    seconds += std::isfinite(to) ? to : each.seconds;
    reached += std::isfinite(to) ? 1 : 0;
  }
  return reached > 0 ? seconds / reached : kInfinity;
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
  const auto contend = [&](const std::string& search, const std::string& lp) {
    Contender contender{search, lp, {}};
    for (int seed = 1; seed <= seeds && !interrupted(); ++seed) {
      Case c = base;
      c.problem = problem.name;
      c.search = search;
      c.lp = lp;
      c.seed = static_cast<std::uint64_t>(seed);
      contender.attempts.push_back(attempt_case(problem, c, interruption));
      done();
    }
    return contender;
  };
  const char* unit = problem.motion ? problem.unit() : resolve(problem, base).unit;
  const std::string lp = complete(problem, base).lp;
  Comparison comparison{problem.name, unit, {}, {}, problem.motion.has_value(), base.budget};
  for (const std::string& search : searches_of(problem, base))
    comparison.contenders.push_back(contend(search, lp));
  const Reference reference = reference_of(problem);
  if (has_reference(problem, base))
    comparison.reference = contend(reference.search, reference.solver);
  comparison.interrupted = interrupted();
  return comparison;
}

long attempt_count(const Problem& problem, const Case& base, int seeds) {
  const auto contenders =
      static_cast<long>(searches_of(problem, base).size()) + (has_reference(problem, base) ? 1 : 0);
  return contenders * seeds;
}

double median(std::vector<double> values) {
  if (values.empty()) return kInfinity;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  if (values.size() % 2 == 1) return values[half];
  return values[half] == kInfinity ? kInfinity : (values[half - 1] + values[half]) / 2;
}

}  // namespace maxwrench
