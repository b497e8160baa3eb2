#include "benchmarks/suite/row_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "benchmarks/suite/results.h"
#include "benchmarks/tables/case_file.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"
#include "solvers/solve/method.h"
#include "solvers/solve/row.h"

namespace maxwrench {
namespace {

/// The valid statuses of a row without a value. A search does not end with a verdict of the lower
/// level.
constexpr Status kNoValue[] = {Status::kInfeasible,     Status::kUnbounded,
                               Status::kInvalidPosture, Status::kNumericalError,
                               Status::kNoneFound,      Status::kBudgetExhausted};

/// A row of a file.
struct RowOf {
  const CsvFile& csv;
  std::size_t row;

  const std::string& text(const char* column) const { return csv.text(row, column); }
  /// Numbers separated by blanks.
  Eigen::VectorXd vector(const char* column) const {
    std::istringstream words(text(column));
    std::vector<double> all;
    for (std::string word; words >> word;) {
      double value = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
        csv.throw_bad_cell(row, column, "finite numbers");
      }
      all.push_back(value);
    }
    return Eigen::Map<Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
  }
};

/// Checks the row's own efforts, wrench and multipliers in a posture.
std::string reject_efforts(const Problem& problem, Wrench wrench, const Posture& posture,
                           const RowOf& claim, double beta) {
  WrenchProgram program = make_wrench_program(problem, wrench);
  set_posture(posture, program);
  const Eigen::VectorXd h = claim.vector("h");
  const double tolerance = kAnswerTolerance * (1 + std::abs(beta));
  if (h.size() != 6) return "h: expected six numbers";
  const Eigen::VectorXd w = program.W.transpose() * h;
  if (!((h - program.W * w).norm() <= tolerance)) return "its wrench is not allowed";
  if (!(std::abs(program.c_w.dot(w) - beta) <= tolerance)) return "its wrench has another value";
  const Residual own = recheck(program, claim.vector("u"), w, claim.vector("lambda"));
  if (own.within(tolerance)) return "";
  return fmt::format(
      "its efforts do not satisfy its program: balance {:.2g}, bounds {:.2g}, dual {:.2g}, gap "
      "{:.2g}",
      own.balance, own.bounds, own.dual, own.gap);
}

/// The same in the best posture at theta_r, or in another one: if two have the same value, rounding
/// decides which is chosen.
std::string reject_own(const Problem& problem, const Answer& anew, const RowOf& claim,
                       double beta) {
  const Wrench wrench = anew.choice.wrench;
  const std::string why = reject_efforts(problem, wrench, anew.posture, claim, beta);
  if (why.empty()) return why;
  PostureEvaluator model(problem);
  model.evaluate(anew.posture.theta_r);
  for (int ik_solution = 0; ik_solution < model.ik_solutions(); ++ik_solution) {
    if (reject_efforts(problem, wrench, model.select(ik_solution), claim, beta).empty()) return "";
  }
  return why;
}

/// Checks a number that accompanies the value, such as beta_linf, which may be empty.
std::string reject_other(const RowOf& claim, const char* column, double anew) {
  const std::optional<double> claimed = claim.csv.number(claim.row, column);
  const bool same = std::isfinite(anew) ? claimed && std::abs(*claimed - anew) <=
                                                         kAnswerTolerance * (1 + std::abs(anew))
                                        : !claimed;
  if (same) return "";
  return std::isfinite(anew) ? fmt::format("{}: its posture has {:.9g}", column, anew)
                             : fmt::format("{}: its posture has none", column);
}

/// Checks that the numbers are those of a new evaluation of the same posture.
std::string reject_numbers(const RowOf& claim, const char* column, const Eigen::VectorXd& anew) {
  const Eigen::VectorXd claimed = claim.vector(column);
  if (claimed.size() != anew.size()) {
    return fmt::format("{}: got {} numbers, expected {}", column, claimed.size(), anew.size());
  }
  if (anew.size() == 0) return "";
  const double size = 1 + anew.lpNorm<Eigen::Infinity>();
  const bool same = (claimed - anew).lpNorm<Eigen::Infinity>() <= kAnswerTolerance * size;
  return same ? "" : fmt::format("{}: its posture has others", column);
}

/// Checks that the row's residual is that of its answer, up to rounding.
std::string reject_residual(const RowOf& claim, const Residual& anew, double beta) {
  const std::pair<const char*, double> all[] = {
      {"balance", anew.balance}, {"bounds", anew.bounds}, {"dual", anew.dual}, {"gap", anew.gap}};
  const double tolerance = kAnswerTolerance * (1 + std::abs(beta));
  for (const auto& [column, value] : all) {
    const std::optional<double> claimed = claim.csv.number(claim.row, column);
    if (!claimed) return fmt::format("{}: got none, expected a number", column);
    if (!(*claimed >= 0 && std::abs(*claimed - value) <= tolerance)) {
      return fmt::format("{}: expected about {:.2g}", column, value);
    }
  }
  return "";
}

/// Checks that these cells are empty.
std::string reject_filled(const RowOf& claim, std::initializer_list<const char*> columns) {
  for (const char* column : columns) {
    if (!claim.text(column).empty()) return fmt::format("{}: expected none", column);
  }
  return "";
}

/// The number of evaluations of a search is only compared with its budget, and must include those
/// of its methods.
std::string reject_effort(const Case& c, const RowOf& claim) {
  const auto evaluations = claim.csv.whole<long>(claim.row, "evaluations");
  if (!c.integrator.empty()) return "";
  if (c.search.empty()) {
    return evaluations == 1 && claim.text("calls").empty()
               ? ""
               : "evaluations: expected 1, and no calls, of what is given";
  }
  const long least = claim.text("beta").empty() ? 0 : 1;
  if (evaluations < least || evaluations > c.budget) {
    return fmt::format("evaluations: expected {} to {}", least, c.budget);
  }
  long called = 0;
  std::istringstream calls(claim.text("calls"));
  for (std::string call; std::getline(calls, call, ';');) {
    std::istringstream words(call);
    std::string method, status, more;
    long count = 0, spent = 0;
    if (!(words >> method >> status >> count >> spent) || words >> more || count < 1 || spent < 0) {
      return "calls: expected a method, how it ended, how often, and its evaluations";
    }
    called += spent;
  }
  return called <= evaluations ? "" : "calls: expected no more evaluations than there are in all";
}

/// Checks that the names are complete, exist and are a valid combination.
std::string reject_names(const Problem& problem, const Case& c) {
  const Case complete = resolve(problem, c).choice;
  if (complete.solver != c.solver) return fmt::format("solver: expected '{}'", complete.solver);
  if (c.budget != complete.budget) return "budget: expected at least 1";
  if (c.search.empty()) return "";
  const std::vector<std::string> served = served_searches(problem, c.measure);
  for (const SearchEntry* stage : find_search(c.search).stages) {
    if (std::find(served.begin(), served.end(), stage->name) == served.end()) {
      return fmt::format("search: got '{}', expected one that serves the task", stage->name);
    }
  }
  return "";
}

/// Checks the texts: whether a row of this status can have a value, and what belongs to its task.
std::string reject_words(const Problem& problem, const Case& c, const RowOf& claim,
                         bool has_value) {
  if (claim.text("task_digest") != problem.digest) {
    return "task_digest: expected '" + problem.digest + "', the digest of its files";
  }
  if (claim.text("label") != problem.label) return "label: expected '" + problem.label + "'";
  if (claim.text("beta_linf_unit") != problem.unit()) {
    return fmt::format("beta_linf_unit: expected '{}'", problem.unit());
  }
  const std::string& status = claim.text("status");
  const Status of_value = !c.integrator.empty() ? Status::kReached
                          : c.search.empty()    ? Status::kOptimal
                                                : Status::kBestFound;
  const bool interrupted = !c.search.empty() && claim.text("reason") == "interrupted";
  const bool exhausted = status == to_string(Status::kBudgetExhausted);
  if (has_value && !(interrupted ? exhausted : status == to_string(of_value))) {
    return fmt::format("status: got '{}', expected '{}' beside a value", status,
                       to_string(of_value));
  }
  if (has_value && c.integrator.empty() && !interrupted && !claim.text("reason").empty()) {
    return "reason: expected none beside a value";
  }
  if (has_value) return "";
  const std::string filled =
      reject_filled(claim, {"h", "u", "lambda", "balance", "bounds", "dual", "gap"});
  if (!filled.empty()) return filled;
  const bool known = std::any_of(std::begin(kNoValue), std::end(kNoValue),
                                 [&](Status each) { return status == to_string(each); });
  const bool of_search = status != to_string(Status::kInfeasible) && interrupted == exhausted;
  if (!known || (!c.search.empty() && !of_search)) {
    return fmt::format("status: got '{}' without a value", status);
  }
  return claim.text("reason").empty() ? "it has no value and no reason why" : "";
}

RowCheck compare(const Verdict& anew, double value, double beta) {
  RowCheck check;
  check.has_value = true;
  check.deviation = std::abs(value - beta) / (1 + std::abs(beta));
  if (anew.status != Status::kOptimal) {
    check.rejection = fmt::format("its posture has no value: {}", anew.reason.str());
  } else if (!(check.deviation <= kAnswerTolerance)) {
    check.rejection = fmt::format("its posture has the value {:.9g}", value);
  }
  return check;
}

Problem with_scheme(const Problem& problem, const Case& c) {
  Problem changed = problem;
  if (problem.motion) set_scheme("scheme", c.scheme, changed);
  return changed;
}

/// Evaluates the posture of a row.
Answer posture_again(const Problem& problem, const Case& c, const RowOf& claim) {
  const Eigen::VectorXd theta_r = claim.vector("theta_r");
  if (theta_r.size() != problem.redundancy()) {
    throw std::invalid_argument(
        fmt::format("theta_r: got {} numbers, expected {}", theta_r.size(), problem.redundancy()));
  }
  return evaluate(problem, theta_r, {c});
}

/// Evaluates the knots of a row.
Answer trajectory_again(const Problem& problem, const Case& c, const RowOf& claim) {
  const Eigen::VectorXd x = claim.vector("theta_r");
  const int r = problem.redundancy();
  if (x.size() == 0 || r == 0 || x.size() % r != 0) {
    throw std::invalid_argument(
        fmt::format("theta_r: got {} numbers, expected some times {}", x.size(), r));
  }
  return evaluate(problem, unstacked(x, x.size() / r), {c});
}

std::string reject_capability(const RowOf& claim, const Capability& capability) {
  const Eigen::VectorXd h =
      capability.w.size() > 0 ? Eigen::VectorXd(capability.h) : Eigen::VectorXd();
  for (const auto& [column, numbers] : {std::pair<const char*, const Eigen::VectorXd&>("h", h),
                                        {"u", capability.u},
                                        {"lambda", capability.lambda}}) {
    const std::string rejection = reject_numbers(claim, column, numbers);
    if (!rejection.empty()) return rejection;
  }
  return "";
}

/// Whether another posture at theta_r has the same value, with the wrench, efforts and multipliers
/// of the row: if values tie, rounding decides which is chosen.
bool has_tie(const Problem& problem, const Case& c, const RowOf& claim, const Answer& anew) {
  PostureEvaluator model(problem);
  const Eigen::VectorXd theta_r = claim.vector("theta_r");
  model.evaluate(theta_r);
  if (model.ik_solutions() < 2) return false;
  const auto measure = resolve(problem, c).make_measure();
  WrenchProgram program = make_wrench_program(problem, c.wrench);
  Capability capability;
  for (int ik_solution = 0; ik_solution < model.ik_solutions(); ++ik_solution) {
    const Posture& posture = model.select(ik_solution);
    if (posture.status != Status::kValid) continue;
    set_posture(posture, program);
    measure->evaluate(posture, program, true, capability);
    const double off = std::abs(capability.beta - anew.beta());
    if (capability.status == Status::kOptimal &&
        off <= kAnswerTolerance * (1 + std::abs(anew.beta())) &&
        reject_capability(claim, capability).empty()) {
      return true;
    }
  }
  return false;
}

RowCheck check_posture(const Problem& problem, const Case& c, const RowOf& claim, double beta) {
  const Answer anew = posture_again(problem, c, claim);
  RowCheck check = compare(anew, anew.capability.beta, beta);
  if (check.rejection.empty() && anew.unit != claim.text("unit")) {
    check.rejection = fmt::format("unit: expected '{}'", anew.unit);
  }
  if (check.rejection.empty()) check.rejection = reject_other(claim, "beta_linf", anew.beta_linf);
  if (check.rejection.empty()) check.rejection = reject_filled(claim, {"value_between_knots"});
  if (check.rejection.empty()) check.rejection = reject_residual(claim, anew.residual(), beta);
  if (!check.rejection.empty()) return check;
  check.rejection = reject_capability(claim, anew.capability);
  if (!check.rejection.empty() && has_tie(problem, c, claim, anew)) check.rejection.clear();
  // Rounding decides which of several optimal efforts and multipliers are found, so other ones are
  // checked for themselves.
  if (!check.rejection.empty() && c.measure == "linf_polytope" && !problem.contact) {
    check.rejection = reject_own(problem, anew, claim, beta);
  }
  return check;
}

RowCheck check_trajectory(const Problem& problem, const Case& c, const RowOf& claim, double value) {
  const Answer anew = trajectory_again(problem, c, claim);
  RowCheck check = compare(anew, anew.trajectory.value, value);
  if (check.rejection.empty() && anew.unit != claim.text("unit")) {
    check.rejection = fmt::format("unit: expected '{}'", anew.unit);
  }
  if (check.rejection.empty() && !claim.text("beta_linf").empty()) {
    check.rejection = "beta_linf: expected none of a trajectory";
  }
  if (check.rejection.empty()) {
    check.rejection =
        reject_other(claim, "value_between_knots", anew.trajectory.value_between_knots);
  }
  if (check.rejection.empty()) check.rejection = reject_filled(claim, {"h", "u", "lambda"});
  if (check.rejection.empty()) check.rejection = reject_residual(claim, anew.residual(), value);
  return check;
}

/// Repeats the experiment. Its reading depends on the integrator's steps, within their tolerance.
RowCheck check_experiment(const Problem& problem, const Case& c, const RowOf& claim,
                          double reading) {
  const Answer anew = experiment(problem, {c});
  const Eigen::VectorXd theta_r = claim.vector("theta_r");
  RowCheck check;
  check.has_value = true;
  check.deviation = std::abs(anew.beta() - reading) / (1 + std::abs(reading));
  if (!anew.has_value()) {
    check.rejection = fmt::format("its experiment has no reading: {}", anew.reason.str());
  } else if (!(check.deviation <= kSameReading)) {
    check.rejection = fmt::format("its experiment has the reading {:.9g}", anew.beta());
  } else if (anew.unit != claim.text("unit")) {
    check.rejection = fmt::format("unit: expected '{}'", anew.unit);
  } else if (anew.missed.empty() != claim.text("reason").empty()) {
    check.rejection = fmt::format("reason: expected '{}'", anew.missed);
  } else if (theta_r.size() != anew.trajectory.knots.size() ||
             theta_r != stacked(anew.trajectory.knots)) {
    check.rejection = "theta_r: expected the default of the task";
  } else {
    check.rejection = reject_other(claim, "beta_linf", anew.beta_linf);
  }
  if (check.rejection.empty()) {
    check.rejection = reject_filled(claim, {"value_between_knots", "h", "u", "lambda", "balance",
                                            "bounds", "dual", "gap", "calls"});
  }
  return check;
}

/// Checks a row without a value whose posture, trajectory or experiment was computed again. Its
/// status cannot be one of a row with a value.
std::string reject_again(const Answer& anew, const RowOf& claim) {
  const std::string status = to_string(anew.status);
  if (status != claim.text("status")) return "status: expected '" + status + "'";
  if (anew.reason.str() != claim.text("reason")) {
    return "reason: expected '" + anew.reason.str() + "'";
  }
  const Eigen::VectorXd theta_r = claim.vector("theta_r"), knots = stacked(anew.trajectory.knots);
  if (theta_r.size() != knots.size() || theta_r != knots) {
    return "theta_r: expected '" + exact_text(knots) + "'";
  }
  return reject_filled(claim, {"calls"});
}

/// Checks the numbers that accompany a missing value. A search that found nothing has none.
std::string reject_beside(const Answer& anew, const RowOf& claim) {
  if (anew.unit != claim.text("unit")) return fmt::format("unit: expected '{}'", anew.unit);
  const std::string why = reject_other(claim, "beta_linf", anew.beta_linf);
  return !why.empty()
             ? why
             : reject_other(claim, "value_between_knots", anew.trajectory.value_between_knots);
}

/// Checks a row without a value and its reason. A search is not repeated: that it found nothing is
/// taken on trust, but the best point that it names must indeed have no value.
std::string reject_failure(const Problem& changed, const Case& c, const RowOf& claim) {
  Answer anew;
  if (!c.integrator.empty()) {
    anew = experiment(changed, {c});
  } else if (!c.search.empty() && claim.text("theta_r").empty()) {
    // A search that ended by an error may have no unit.
    const bool failed = claim.text("status") == to_string(Status::kNumericalError);
    anew.unit = failed && claim.text("unit").empty() ? "" : resolve(changed, c).unit;
  } else {
    anew = (changed.motion ? trajectory_again : posture_again)(changed, c, claim);
  }
  std::string why;
  if (c.search.empty()) {
    why = reject_again(anew, claim);
  } else if (anew.has_value()) {
    why = fmt::format("beta: what it found has the value {:.9g}", anew.beta());
  }
  return !why.empty() ? why : reject_beside(anew, claim);
}

RowCheck checked(const Problem& problem, const Case& c, const RowOf& claim) {
  const std::optional<double> beta = claim.csv.number(claim.row, "beta");
  const Problem changed = with_scheme(problem, c);
  std::string rejection = reject_words(changed, c, claim, beta.has_value());
  if (rejection.empty()) rejection = reject_names(changed, c);
  if (rejection.empty()) rejection = reject_effort(c, claim);
  if (rejection.empty() && !beta) rejection = reject_failure(changed, c, claim);
  if (!beta || !rejection.empty()) return {rejection, beta.has_value(), 0};
  const auto of_search = problem.motion ? check_trajectory : check_posture;
  return (c.integrator.empty() ? of_search : check_experiment)(changed, c, claim, *beta);
}

}  // namespace

RowCheck check_row(const Problem& problem, const CsvFile& csv, std::size_t row) {
  try {
    return checked(problem, case_of(csv, row), {csv, row});
  } catch (const std::invalid_argument& error) {
    return {error.what(), !csv.text(row, "beta").empty(), 0};
  }
}

}  // namespace maxwrench
