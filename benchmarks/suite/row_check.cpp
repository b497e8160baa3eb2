#include "benchmarks/suite/row_check.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "benchmarks/suite/results.h"
#include "benchmarks/suite/row_claim.h"
#include "benchmarks/tables/case_file.h"
#include "maxwrench/measure.h"
#include "maxwrench/problem.h"
#include "maxwrench/wrench_program.h"
#include "solvers/solve/method.h"
#include "solvers/solve/row.h"

namespace maxwrench {
namespace {

/// Its own efforts, wrench and multipliers, in a posture.
std::string reject_efforts(const Problem& problem, Wrench wrench, const Posture& posture,
                           const RowClaim& claim, double beta) {
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

/// The same in the best posture at theta_r, or in another one: which of two that are worth the same
/// is chosen hangs on rounding.
std::string reject_own(const Problem& problem, const Answer& anew, const RowClaim& claim,
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

/// The posture of a row, evaluated.
Answer posture_again(const Problem& problem, const Case& c, const RowClaim& claim) {
  const Eigen::VectorXd theta_r = claim.vector("theta_r");
  if (theta_r.size() != problem.redundancy()) {
    throw std::invalid_argument(
        fmt::format("theta_r: got {} numbers, expected {}", theta_r.size(), problem.redundancy()));
  }
  return evaluate(problem, theta_r, {c});
}

/// The knots of a row, evaluated.
Answer trajectory_again(const Problem& problem, const Case& c, const RowClaim& claim) {
  const Eigen::VectorXd x = claim.vector("theta_r");
  const int r = problem.redundancy();
  if (x.size() == 0 || r == 0 || x.size() % r != 0) {
    throw std::invalid_argument(
        fmt::format("theta_r: got {} numbers, expected a multiple of {}", x.size(), r));
  }
  return evaluate(problem, unstacked(x, x.size() / r), {c});
}

std::string reject_capability(const RowClaim& claim, const Capability& capability) {
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

/// Whether another posture at theta_r is worth as much, with the wrench, efforts and multipliers of
/// the row: which of those that tie is taken hangs on rounding.
bool has_tie(const Problem& problem, const Case& c, const RowClaim& claim, const Answer& anew) {
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

RowCheck check_posture(const Problem& problem, const Case& c, const RowClaim& claim, double beta) {
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

RowCheck check_trajectory(const Problem& problem, const Case& c, const RowClaim& claim,
                          double value) {
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

/// By the experiment again, of whose steps a reading depends to their tolerance.
RowCheck check_experiment(const Problem& problem, const Case& c, const RowClaim& claim,
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

/// Of a row without a value whose posture, trajectory or experiment was made again; no status of
/// such a row is one of a value.
std::string reject_again(const Answer& anew, const RowClaim& claim) {
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

/// What stands beside the value that there is not. Of a search that found nothing there is nothing.
std::string reject_beside(const Answer& anew, const RowClaim& claim) {
  if (anew.unit != claim.text("unit")) return fmt::format("unit: expected '{}'", anew.unit);
  const std::string why = reject_other(claim, "beta_linf", anew.beta_linf);
  return !why.empty()
             ? why
             : reject_other(claim, "value_between_knots", anew.trajectory.value_between_knots);
}

/// Whether a row that says why it has no value is right. A search is not made again: that it found
/// nothing is its own word, but what it names as the best has no value indeed.
std::string reject_failure(const Problem& changed, const Case& c, const RowClaim& claim) {
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

RowCheck checked(const Problem& problem, const Case& c, const RowClaim& claim) {
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
