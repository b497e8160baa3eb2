#include "solvers/wrench_set/support.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "solvers/lp/makers.h"
#include "solvers/wrench_set/directions.h"

namespace maxwrench {
namespace {

/// Largest residual of a support point, relative to 1 + its value.
constexpr double kSupportTolerance = 1e-9;

const WrenchSolverEntry& solver_named(const std::string& name) {
  std::vector<std::string> names;
  for (const WrenchSolverEntry& solver : wrench_solvers()) {
    if (solver.one_column_only) continue;
    if (name.empty() || name == solver.name) return solver;
    names.emplace_back(solver.name);
  }
  throw std::invalid_argument(
      fmt::format("solver: got '{}', expected one of {}", name, fmt::join(names, " ")));
}

std::unique_ptr<Measure> polytope_named(const Problem& task, const WrenchSetOptions& options) {
  if (options.measure != "linf_polytope" && options.measure != "l2_polytope") {
    throw std::invalid_argument("measure: got '" + options.measure +
                                "', expected linf_polytope or l2_polytope");
  }
  return find_measure(options.measure).make(task, solver_named(options.solver).make());
}

/// max c_w'w over the directions of recession, with the first columns within -1 and 1: with finite
/// limits of u, a wrench may grow without end only if J'W w = 0.
LinearProgram recession(const WrenchProgram& program, Eigen::Index columns) {
  LinearProgram lp;
  const Eigen::Index n = program.JtW.rows(), all = program.JtW.cols();
  lp.A = program.JtW.sparseView(1, 0);
  lp.A.makeCompressed();
  lp.b = Eigen::VectorXd::Zero(n);
  lp.c = program.c_w;
  lp.l = program.w_min;
  lp.u = program.w_max;
  for (Eigen::Index j = 0; j < all; ++j) {
    if (std::isfinite(lp.l[j])) lp.l[j] = 0;
    if (std::isfinite(lp.u[j])) lp.u[j] = 0;
  }
  lp.l.head(columns).setConstant(-1);
  lp.u.head(columns).setConstant(1);
  return lp;
}

}  // namespace

WrenchSupport::WrenchSupport(const Problem& task, const Posture& posture,
                             const WrenchSetOptions& options)
    : posture_(posture),
      program_(wrench_set_program(task, posture, options.E, options.wrench)),
      measure_(polytope_named(task, options)) {}

std::optional<SupportPoint> WrenchSupport::farthest(const Eigen::VectorXd& d) {
  program_.c_w.head(d.size()) = d;
  measure_->evaluate(posture_, program_, true, capability_);
  ++programs_;
  verdict_ = capability_;
  if (verdict_.status == Status::kUnbounded) confirm_unbounded(d);
  if (verdict_.status != Status::kOptimal) return std::nullopt;
  const Residual& residual = capability_.residual;
  if (!residual.within(kSupportTolerance * (1 + std::abs(capability_.beta)))) {
    verdict_.conclude(Status::kNumericalError, "a point of the set does not satisfy its program");
    return std::nullopt;
  }
  residual_.balance = std::max(residual_.balance, residual.balance);
  residual_.bounds = std::max(residual_.bounds, residual.bounds);
  residual_.dual = std::max(residual_.dual, residual.dual);
  residual_.gap = std::max(residual_.gap, residual.gap);
  return SupportPoint{capability_.w.head(d.size()), capability_.beta, capability_.u, capability_.h};
}

void WrenchSupport::confirm_unbounded(const Eigen::VectorXd& d) {
  LpSolution solution;
  const LinearProgram lp = recession(program_, d.size());
  make_simplex()->solve(lp, solution);
  constexpr double kNone = 1e-9;
  const bool found = solution.status == Status::kOptimal && solution.objective > kNone;
  if (!found || !verified(lp, solution)) {
    verdict_.conclude(Status::kNumericalError, "no ray proves that the set is unbounded");
    return;
  }
  ray_ = solution.x.head(d.size()).normalized();
  verdict_.conclude(Status::kUnbounded,
                    fmt::format("no actuator limits the wrench along ({:.3g}), in the columns of E",
                                fmt::join(ray_.begin(), ray_.end(), ", ")));
}

void WrenchSupport::report(WrenchSet& set) const {
  static_cast<Verdict&>(set) = verdict_;
  set.ray = ray_;
  set.residual = residual_;
  set.programs = programs_;
}

}  // namespace maxwrench
