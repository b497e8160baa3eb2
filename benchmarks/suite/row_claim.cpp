#include "benchmarks/suite/row_claim.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>

#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"
#include "solvers/solve/method.h"

namespace maxwrench {
namespace {

/// How a row without a value may have ended; that of a search not by a verdict of the lower level.
constexpr Status kNoValue[] = {Status::kInfeasible,     Status::kUnbounded,
                               Status::kInvalidPosture, Status::kNumericalError,
                               Status::kNoneFound,      Status::kBudgetExhausted};

}  // namespace

Eigen::VectorXd RowClaim::vector(const char* column) const {
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

std::string reject_other(const RowClaim& claim, const char* column, double anew) {
  const std::optional<double> claimed = claim.csv.number(claim.row, column);
  const bool same = std::isfinite(anew) ? claimed && std::abs(*claimed - anew) <=
                                                         kAnswerTolerance * (1 + std::abs(anew))
                                        : !claimed;
  if (same) return "";
  return std::isfinite(anew) ? fmt::format("{}: its posture has {:.9g}", column, anew)
                             : fmt::format("{}: its posture has none", column);
}

std::string reject_numbers(const RowClaim& claim, const char* column, const Eigen::VectorXd& anew) {
  const Eigen::VectorXd claimed = claim.vector(column);
  if (claimed.size() != anew.size()) {
    return fmt::format("{}: got {} numbers, expected {}", column, claimed.size(), anew.size());
  }
  if (anew.size() == 0) return "";
  const double size = 1 + anew.lpNorm<Eigen::Infinity>();
  const bool same = (claimed - anew).lpNorm<Eigen::Infinity>() <= kAnswerTolerance * size;
  return same ? "" : fmt::format("{}: its posture has other values", column);
}

std::string reject_residual(const RowClaim& claim, const Residual& anew, double beta) {
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

std::string reject_filled(const RowClaim& claim, std::initializer_list<const char*> columns) {
  for (const char* column : columns) {
    if (!claim.text(column).empty()) return fmt::format("{}: expected none", column);
  }
  return "";
}

std::string reject_effort(const Case& c, const RowClaim& claim) {
  const auto evaluations = claim.csv.whole<long>(claim.row, "evaluations");
  if (!c.integrator.empty()) return "";
  if (c.search.empty()) {
    return evaluations == 1 && claim.text("calls").empty()
               ? ""
               : "evaluations: expected 1, and no calls, for a given posture or trajectory";
  }
  const long least = claim.text("beta").empty() ? 0 : 1;
  if (evaluations < least || evaluations > c.budget) {
    return fmt::format("evaluations: expected from {} to {}", least, c.budget);
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
  return called <= evaluations ? "" : "calls: expected no more evaluations than in the row";
}

std::string reject_names(const Problem& problem, const Case& c) {
  const Case complete = resolve(problem, c).choice;
  if (complete.solver != c.solver) return fmt::format("solver: expected '{}'", complete.solver);
  if (c.budget != complete.budget) return "budget: expected at least 1";
  if (c.search.empty()) return "";
  const std::vector<std::string> supported = supported_searches(problem, c.measure, c.wrench);
  for (const SearchEntry* stage : find_search(c.search).stages) {
    if (std::find(supported.begin(), supported.end(), stage->name) == supported.end()) {
      return fmt::format("search: got '{}', expected one that supports the task", stage->name);
    }
  }
  return "";
}

std::string reject_words(const Problem& problem, const Case& c, const RowClaim& claim,
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
  return claim.text("reason").empty() ? "it has neither a value nor a reason" : "";
}

}  // namespace maxwrench
