#include "benchmarks/race/comparison.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>

#include "lib/math/require.h"
#include "lib/posture/ik/ik_start_system.h"
#include "maxwrench/batch.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "solvers/certify/proof.h"
#include "solvers/solve/method.h"

namespace maxwrench {
namespace {

constexpr const char* kPeers[] = {"glpk", "clp"};

const char* plain_search(const Problem& problem) {
  return problem.motion ? "multistart" : "annealing+cmaes";
}

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The solvers of `Comparison::peers`.
std::vector<std::string> peers_of(const Problem& problem, const Case& base) {
  const auto holds = [](const auto& table, const std::string& name) {
    return std::any_of(table.begin(), table.end(),
                       [&](const auto& entry) { return entry.name == name; });
  };
  std::vector<std::string> names;
  if (!find_measure(base.measure).needs_solver) return names;
  if (problem.motion && !holds(searches(), plain_search(problem))) return names;
  for (const char* peer : kPeers) {
    if (holds(lp_solvers(), peer)) names.emplace_back(peer);
  }
  return names;
}

std::string default_of(const Problem& problem, const Case& base) {
  const bool named = !problem.motion && !base.search.empty();
  return named ? base.search : default_search(problem, base.measure, base.wrench);
}

/// The searches that support a problem, the default first.
std::vector<std::string> searches_of(const Problem& problem, const Case& base) {
  std::vector<std::string> supported = supported_searches(problem, base.measure, base.wrench);
  const std::string first = default_of(problem, base);
  std::erase(supported, first);
  supported.insert(supported.begin(), first);
  return supported;
}

/// The cost of the most expensive stage.
int cost_of(const std::string& search) {
  int cost = 1;
  for (const SearchEntry* stage : find_search(search).stages) {
    cost = std::max(cost, stage->cost);
  }
  return cost;
}

/// A bound this near to the best value moves no target by more than a third of the lowest target
/// share.
constexpr double kNearBound = kTargetShares.back() / 3;
constexpr double kProofGap = 1e-7;
/// Boxes with more coordinates than theta_r are more expensive, so fewer are bounded. With more
/// than kMostBoxed coordinates, this few boxes prove nothing.
constexpr long kProofBoxes = 200'000, kFewerBoxes = 50'000;
constexpr Eigen::Index kMostBoxed = 8;

/// A bound on all postures, if it is within kNearBound of the best of all attempts.
std::optional<double> proven_best(const Problem& problem, const Case& base,
                                  const Comparison& comparison, const RaceOptions& race) {
  if (!comparison.has_value()) return {};
  const auto bounds = find_bound(problem, base.measure, base.wrench);
  const Eigen::Index boxed = bounds ? boxed_coordinates(problem, *bounds) : 0;
  if (!bounds || boxed > kMostBoxed) return {};
  CertifyOptions options;
  options.gap = kProofGap;
  options.boxes = boxed > problem.redundancy() ? kFewerBoxes : kProofBoxes;
  options.threads = race.threads;
  options.interrupted = race.interrupted;
  const Candidate best = comparison.best_found();
  const double bound = prove(problem, resolve(problem, base), *bounds, best, options).bound;
  if (!(bound - best.value <= kNearBound * std::abs(best.value))) return {};
  return bound;
}

/// Runs seed by seed, so that attempts of one search, which may wait for each other, do not run in
/// parallel.
void run_all(const Problem& problem, const Case& base, const RaceOptions& options,
             Comparison& comparison) {
  std::vector<Contender*> all;
  for (auto* group : {&comparison.contenders, &comparison.peers}) {
    for (Contender& contender : *group) all.push_back(&contender);
  }
  const auto count = static_cast<long>(all.size());
  std::vector<std::optional<Attempt>> attempts(all.size() *
                                               static_cast<std::size_t>(options.seeds));
  parallel_for(options.threads, count * options.seeds, [&](long i) {
    if (options.interrupted && options.interrupted()) return;
    const Contender& contender = *all[static_cast<std::size_t>(i % count)];
    Case c = base;
    c.problem = problem.name;
    c.search = contender.search;
    c.solver = contender.solver;
    c.seed = static_cast<std::uint64_t>(i / count + 1);
    c.budget = contender.budget;
    attempts[static_cast<std::size_t>(i)] =
        attempt(problem, resolve(problem, c), options.interrupted);
    if (options.done) options.done();
  });
  for (std::size_t i = 0; i < attempts.size(); ++i) {
    if (attempts[i]) all[i % all.size()]->attempts.push_back(std::move(*attempts[i]));
  }
}

}  // namespace

Attempt attempt(const Problem& problem, const Method& method,
                const std::function<bool()>& interrupted) {
  Attempt attempt;
  attempt.choice = method.choice;
  Method by_instants = method;
  by_instants.trajectory_value = TrajectoryValue::kAtInstants;
  const double begin = thread_seconds();
  SearchOptions how;
  how.interrupted = interrupted;
  how.evaluated = [&, best = -kInfinity](double value) mutable {
    ++attempt.counted;
    if (!(value > best)) return;
    best = value;
    attempt.run.rises.push_back({{attempt.counted, thread_seconds() - begin}, value});
  };
  const auto objective = make_objective(problem, by_instants);
  const SearchResult result = run_search(problem, by_instants, *objective, std::move(how));
  attempt.run.spent = {static_cast<double>(result.evaluations), thread_seconds() - begin};
  attempt.run.interrupted = result.interrupted;
  attempt.value = result.value;
  attempt.found = result.theta_r;
  if (attempt.value == -kInfinity) return attempt;
  const Answer answer =
      evaluate(problem, unstacked(attempt.found, knots_of(problem)), Options{method.choice});
  attempt.value_between_knots = answer.trajectory.value_between_knots;
  // For a task in time, the search's objective has a value even where only slack balances a
  // posture.
  if (!problem.motion && !answer.has_value()) {
    attempt.value = -kInfinity;
    attempt.run.rises.clear();
  }
  return attempt;
}

std::vector<RaceRun> Contender::runs() const {
  std::vector<RaceRun> runs;
  for (const Attempt& each : attempts) runs.push_back(each.run);
  return runs;
}

double Contender::shortfall_after(double evaluations, double best) const {
  if (best == 0 || best == -kInfinity) return kInfinity;
  std::vector<double> shortfalls;
  for (const Attempt& each : attempts) {
    const double value = value_after(each.run, &Spent::evaluations, evaluations);
    shortfalls.push_back((best - value) / std::abs(best));
  }
  return median(shortfalls);
}

double Contender::expected(double target, Cost cost) const {
  return expected_running_time(runs(), target, cost);
}

const Contender* Comparison::reference() const {
  const auto best = std::min_element(peers.begin(), peers.end(), [&](const auto& a, const auto& b) {
    return a.expected(target(), &Spent::seconds) < b.expected(target(), &Spent::seconds);
  });
  return best == peers.end() ? nullptr : &*best;
}

Candidate Comparison::best_found() const {
  Candidate best;
  for (const auto* group : {&contenders, &peers}) {
    for (const Contender& contender : *group) {
      for (const Attempt& each : contender.attempts) {
        if (each.value > best.value) best = {each.found, each.value};
      }
    }
  }
  return best;
}

double Comparison::best() const { return proven ? *proven : best_found().value; }

Comparison compare(const Problem& problem, const Case& base, const RaceOptions& options) {
  require(options.seeds >= 1, "seeds", options.seeds, "at least 1");
  require_threads(options.threads);
  const Method whole = resolve(problem, base);
  Comparison comparison{
      problem.name, whole.unit, {}, {}, default_of(problem, base), problem.motion.has_value(),
      base.budget};
  const auto enter = [&](const std::string& search, const std::string& solver) {
    const long share = options.shares_budget ? cost_of(search) : 1;
    return Contender{search, solver, std::max(1L, base.budget / share), {}};
  };
  for (const std::string& search : searches_of(problem, base)) {
    comparison.contenders.push_back(enter(search, whole.choice.solver));
  }
  for (const std::string& solver : peers_of(problem, base)) {
    comparison.peers.push_back(enter(plain_search(problem), solver));
  }
  prepare(problem, options.threads);
  run_all(problem, base, options, comparison);
  comparison.proven = proven_best(problem, base, comparison, options);
  comparison.interrupted = options.interrupted && options.interrupted();
  return comparison;
}

void prepare(const Problem& problem, int threads) {
  if (!problem.start_system) return;
  parallel_for(threads, problem.start_system->nodes(),
               [&](long i) { problem.start_system->node(static_cast<int>(i)); });
}

long attempt_count(const Problem& problem, const Case& base, int seeds) {
  return static_cast<long>(searches_of(problem, base).size() + peers_of(problem, base).size()) *
         seeds;
}

}  // namespace maxwrench
