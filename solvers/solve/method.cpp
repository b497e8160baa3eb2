#include "solvers/solve/method.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <thread>

#include "lib/measure/task_dynamics.h"
#include "lib/robot/gears.h"
#include "lib/scenario/ball_across.h"
#include "lib/scenario/scenario_facets.h"
#include "lib/search/facet_program.h"
#include "maxwrench/batch.h"
#include "maxwrench/measure.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"

namespace maxwrench {
namespace {

bool supports(const WrenchSolverEntry& solver, const Problem& problem, Wrench wrench) {
  const bool one_column = wrench == Wrench::kPure && problem.contact_columns() == 0;
  if (solver.one_column_only && !one_column) return false;
  return !solver.needs_facets || problem.robot.actuation.has_facets;
}

/// Whether the task has a ball of wrenches that the facets of {B u} solve.
bool ball_by_facets(const Problem& problem, Wrench wrench) {
  return problem.scenarios.ball && wrench == Wrench::kPure && ScenarioFacets::supports(problem);
}

/// The lower-level solvers that support a measure and a wrench; a null entry for a closed form.
std::vector<const WrenchSolverEntry*> solvers_for(const MeasureEntry& measure,
                                                  const Problem& problem, Wrench wrench) {
  if (wrench == Wrench::kAny && !measure.supports_any) return {};
  if (!problem.scenarios.empty() && measure.name != Case().measure) return {};
  if (!measure.needs_solver) return {nullptr};
  if (problem.scenarios.payload && wrench == Wrench::kAny) return {};
  const bool facets_only = ball_by_facets(problem, wrench);
  const ScenarioList& list = problem.scenarios;
  if (list.ball && !facets_only && !BallAcross::supports(list)) return {};
  std::vector<const WrenchSolverEntry*> supported;
  for (const WrenchSolverEntry& solver : wrench_solvers()) {
    if (facets_only && !solver.needs_facets) continue;
    if (supports(solver, problem, wrench)) supported.push_back(&solver);
  }
  return supported;
}

const char* name_of(const WrenchSolverEntry* solver) { return solver ? solver->name : kNoSolver; }

/// The solver with this name, or the first of the supported ones. Throws if it is not one of them.
const WrenchSolverEntry* choose_solver(const std::vector<const WrenchSolverEntry*>& supported,
                                       const Problem& problem, const Case& c) {
  if (c.solver.empty()) return supported.front();
  if (c.solver != kNoSolver) find_wrench_solver(c.solver);
  std::vector<std::string> names;
  for (const WrenchSolverEntry* solver : supported) {
    if (c.solver == name_of(solver)) return solver;
    names.emplace_back(name_of(solver));
  }
  const bool many = supported.front() && !problem.robot.actuation.has_facets;
  throw std::invalid_argument(fmt::format(
      "solver: got '{}', which does not support measure {} with wrench {}{}{}, expected one of {}",
      c.solver, c.measure, to_string(c.wrench),
      problem.contact_columns() > 0 ? " and a second contact" : "",
      many ? " and too many facets" : "", fmt::join(names, " ")));
}

/// For a trajectory search, the trajectory solver of the same name; `facets` and `condensed` become
/// `facets_or_ipm`.
const TrajectorySolverEntry* trajectory_solver_of(const Problem& problem, const Case& c) {
  const auto named = [](const auto& table, const std::string& name) {
    return std::find_if(table.begin(), table.end(),
                        [&](const auto& entry) { return entry.name == name; });
  };
  const std::vector<const SearchEntry*> stages = find_search(c.search).stages;
  const bool of_trajectories =
      std::any_of(stages.begin(), stages.end(), [&](const SearchEntry* stage) {
        return named(trajectory_searches(), stage->name) != trajectory_searches().end();
      });
  if (!of_trajectories || !supported_as_trajectory(problem, c.measure)) return nullptr;
  const auto same = named(trajectory_solvers(), c.solver);
  return same == trajectory_solvers().end() ? &trajectory_solvers().front() : &*same;
}

/// Whether a force of the contact has a finite limit other than zero.
bool limited(const Contact& contact) {
  const auto counts = [](double limit) { return limit != 0 && std::isfinite(limit); };
  return std::any_of(contact.w_min.begin(), contact.w_min.end(), counts) ||
         std::any_of(contact.w_max.begin(), contact.w_max.end(), counts);
}

const char* unit_of(const MeasureEntry& measure, const Problem& problem) {
  if (measure.acceleration) return problem.acceleration_unit();
  return measure.unit ? measure.unit : problem.unit();
}

/// Closed forms handle free columns only, so they do not support a contact with limits.
bool supports_limits(const MeasureEntry& measure, const Problem& problem) {
  const bool closed_form = !measure.needs_solver && measure.supports_any;
  return !(closed_form && problem.contact && limited(*problem.contact));
}

/// Rejects what a list of scenarios does not support. `none`: no solver does.
void require_scenario_case(const Problem& problem, const MeasureEntry& measure, bool none) {
  if (measure.name != Case().measure) {
    throw std::invalid_argument(
        fmt::format("measure: got {}, expected {}: {} has a list of scenarios", measure.name,
                    Case().measure, problem.name));
  }
  if (!none) return;
  if (problem.scenarios.payload) {
    throw std::invalid_argument(fmt::format(
        "wrench: got any, expected pure for a payload: what else holds it would carry it ({})",
        problem.name));
  }
  throw std::invalid_argument(fmt::format(
      "wrench: got a ball, expected pure wrenches of one contact and actuators with few facets, or "
      "a ball of one or two axes alone, or wrench.set in its place ({})",
      problem.name));
}

MeasureMaker measure_maker(const Problem& problem, const MeasureEntry& measure,
                           const WrenchSolverEntry* solver, Wrench wrench) {
  if (problem.scenarios.empty()) {
    return [&problem, &measure, solver] {
      return measure.make(problem, solver ? solver->make() : nullptr);
    };
  }
  return [&problem, solver, wrench] {
    return make_scenario_polytope(problem, wrench, solver->make(), solver->needs_facets);
  };
}

Method resolve_static(const Problem& problem, const Case& c) {
  if (!c.scheme.empty()) {
    throw std::invalid_argument(fmt::format("scheme: got '{}', expected none: {} is a static task",
                                            c.scheme, problem.name));
  }
  Method method;
  method.choice = c;
  if (!c.search.empty()) method.search = find_search(c.search);
  const LowerLevel lower = resolve_lower_level(problem, c);
  method.measure = lower.measure;
  method.choice.solver = lower.solver;
  method.unit = lower.unit;
  method.make_measure = lower.make_measure;
  if (method.search) method.trajectory_solver = trajectory_solver_of(problem, method.choice);
  const bool by_facets = ball_by_facets(problem, c.wrench);
  method.make_beta_linf =
      measure_maker(problem, find_measure("linf_polytope"),
                    &find_wrench_solver(by_facets ? "facets" : "simplex"), c.wrench);
  return method;
}

Method resolve_in_time(const Problem& problem, const Case& c) {
  const char* scheme = to_string(problem.motion->scheme);
  if (!c.scheme.empty() && c.scheme != scheme) {
    throw std::invalid_argument(
        fmt::format("scheme: got '{}', expected {}, that of the task", c.scheme, scheme));
  }
  Method method;
  method.choice = c;
  method.measure = &find_measure(c.measure);
  if (c.measure != Case().measure) {
    throw std::invalid_argument("measure: got '" + c.measure + "', expected " + Case().measure +
                                ": a task in time supports no other measure");
  }
  if (problem.motion->has_factor() && c.wrench == Wrench::kAny) {
    throw std::invalid_argument(
        problem.motion->payload
            ? "wrench: got 'any', expected pure: the environment could carry the payload"
            : "wrench: got 'any', expected pure: the table has all components of the wrench");
  }
  method.trajectory_solver =
      c.solver.empty() ? &trajectory_solvers().front() : &find_trajectory_solver(c.solver);
  method.choice.solver = method.trajectory_solver->name;
  method.choice.scheme = scheme;
  if (!c.search.empty()) {
    method.search = find_search(c.search);
    const auto& stages = method.search->stages;
    const bool throughout = std::all_of(stages.begin(), stages.end(),
                                        [](const SearchEntry* entry) { return entry->throughout; });
    if (throughout) method.trajectory_value = TrajectoryValue::kThroughout;
  }
  method.unit = problem.unit();
  return method;
}

}  // namespace

LowerLevel resolve_lower_level(const Problem& problem, const Case& c) {
  const MeasureEntry& measure = find_measure(c.measure);
  const auto supported = solvers_for(measure, problem, c.wrench);
  if (!problem.scenarios.empty()) require_scenario_case(problem, measure, supported.empty());
  if (supported.empty()) {
    throw std::invalid_argument(fmt::format(
        "wrench: got 'any', which measure {} does not support, expected pure", c.measure));
  }
  const WrenchSolverEntry* solver = choose_solver(supported, problem, c);
  if (!supports_limits(measure, problem)) {
    throw std::invalid_argument("measure: got " + c.measure +
                                ", expected one with a solver: a closed form supports only zero "
                                "and infinity as limits of contact.basis");
  }
  return {&measure, name_of(solver), unit_of(measure, problem),
          measure_maker(problem, measure, solver, c.wrench)};
}

bool supported_as_trajectory(const Problem& problem, const std::string& measure) {
  return measure == Case().measure && !problem.contact && problem.free.count() == 0 &&
         gears_at(problem.robot, problem.end_effector).empty() && problem.scenarios.empty();
}

bool supported_between_facets(const Problem& problem, const std::string& measure, Wrench wrench) {
  return measure == Case().measure && has_facet_program(problem, wrench);
}

std::vector<std::string> supported_solvers(const Problem& problem, const std::string& measure,
                                           Wrench wrench) {
  std::vector<std::string> names;
  const MeasureEntry& entry = find_measure(measure);
  if (problem.motion) {
    if (measure != Case().measure) return names;
    for (const TrajectorySolverEntry& solver : trajectory_solvers())
      names.emplace_back(solver.name);
    return names;
  }
  if (!supports_limits(entry, problem)) return names;
  if (entry.acceleration && !why_no_acceleration(problem).empty()) return names;
  for (const WrenchSolverEntry* solver : solvers_for(entry, problem, wrench)) {
    names.emplace_back(name_of(solver));
  }
  return names;
}

std::vector<std::string> supported_searches(const Problem& problem, const std::string& measure,
                                            Wrench wrench) {
  std::vector<std::string> names;
  const bool transfer = problem.motion && problem.motion->transfer;
  const auto add = [&](std::span<const SearchEntry> table) {
    for (const SearchEntry& search : table) {
      const bool by_instants = search.name == std::string("dp");  // a mass is one for all of them
      if (!(transfer && by_instants)) names.emplace_back(search.name);
    }
  };
  if (problem.motion) add(trajectory_searches());
  const bool path = problem.motion && !problem.motion->impulse && !transfer;
  if (path && problem.motion->k > 1) add(path_searches());
  if (transfer) add(transfer_searches());
  add(searches());
  if (!problem.motion && supported_as_trajectory(problem, measure)) add(trajectory_searches());
  if (supported_between_facets(problem, measure, wrench)) add(facet_searches());
  return names;
}

std::string default_search(const Problem& task, const std::string& measure, Wrench wrench) {
  if (task.motion) return trajectory_searches().front().name;
  const bool has_sqp =
      std::any_of(facet_searches().begin(), facet_searches().end(),
                  [](const SearchEntry& entry) { return entry.name == std::string("facet_sqp"); });
  const bool supports = has_sqp && supported_between_facets(task, measure, wrench);
  return supports ? "facet_sqp+cmaes" : general_search();
}

Case with_search(const Problem& task, Case c) {
  if (c.search.empty()) {
    c.search = default_search(task, c.measure, c.wrench);
    if (c.budget == 0 && !task.motion) c.search.insert(0, kRestarted);
  }
  if (c.budget == 0) c.budget = find_search(c.search).restarts ? kMostOfRestarts : kUsualBudget;
  return c;
}

Method resolve(const Problem& problem, const Case& c) {
  if (c.budget < 0 || c.budget > kMostBudget) {
    throw std::invalid_argument(fmt::format(
        "budget: got {}, expected 1 to {}, or 0 for the default", c.budget, kMostBudget));
  }
  Method method = problem.motion ? resolve_in_time(problem, c) : resolve_static(problem, c);
  method.choice.problem = problem.name;
  if (c.budget == 0) method.choice.budget = kUsualBudget;
  return method;
}

int thread_count(int threads) {
  if (threads < 0 || threads > kMostThreads) {
    throw std::invalid_argument(fmt::format(
        "threads: got {}, expected 1 to {}, or 0 for one per core", threads, kMostThreads));
  }
  return threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void set_scheme(const char* key, const std::string& scheme, Problem& problem) {
  MotionTask& task = *problem.motion;
  const std::vector<std::string> supported =
      task.has_factor() ? std::vector<std::string>{to_string(Scheme::kSpline)}
                        : scheme_names(task.impulse);
  if (std::find(supported.begin(), supported.end(), scheme) == supported.end()) {
    throw std::invalid_argument(fmt::format("{}: got '{}', expected one of {} for {} {}", key,
                                            scheme, fmt::join(supported, " "),
                                            task.impulse ? "an" : "a", problem.type()));
  }
  const Scheme parsed = parse_scheme(scheme);
  if (parsed == Scheme::kSpline && task.k < 2) {
    throw std::invalid_argument(
        fmt::format("{}: got '{}', expected another scheme for k = 1", key, scheme));
  }
  task.scheme = parsed;
}

std::unique_ptr<Objective> make_objective(const Problem& problem, const Method& method,
                                          std::shared_ptr<Tally> tally) {
  const Wrench wrench = method.choice.wrench;
  if (method.trajectory_solver) {
    return make_trajectory_objective(problem, wrench, method.trajectory_solver->make, true,
                                     method.trajectory_value);
  }
  return make_capability_objective(problem, wrench, method.make_measure, true, std::move(tally));
}

SearchResult run_search(const Problem& problem, const Method& method, Objective& objective,
                        SearchOptions options) {
  options.seed = method.choice.seed;
  options.budget = method.choice.budget;
  options.start = stacked(default_knots(problem));
  return method.search->make()->maximize(objective, options);
}

}  // namespace maxwrench
