#include <algorithm>
#include <cmath>

#include "solvers/lp/makers.h"
#include "solvers/lp/simplex/engine.h"

namespace maxwrench {
namespace {

using simplex::Engine;
using simplex::Outcome;

constexpr int kMaxRounds = 60;
constexpr int kPerturbedRounds = 6;
constexpr int kMaxTroubles = 12;

class Simplex final : public LpSolver {
 public:
  explicit Simplex(const SimplexOptions& options) : options_(options), engine_(options) {
    options_.max_updates = std::max(options_.max_updates, 1);
  }

  void solve(const LinearProgram& program, LpSolution& solution) override {
    solution.iterations = solution.cold_restarts = 0;
    solution.objective = 0;
    if (!engine_.model.load(program)) {
      fail(program, solution, kMalformed);
      return;
    }
    engine_.options = options_;
    engine_.resize();
    engine_.iterations = 0;
    if (engine_.model.crossing) return report_crossing(program, solution);
    const bool warm = read_basis(solution);
    for (const Attempt attempt : kAttempts) {
      if (attempt == Attempt::kWarm && !warm) continue;
      if (attempt == Attempt::kCold && warm) ++solution.cold_restarts;
      set_tolerances(attempt);
      if (try_once(program, solution, attempt == Attempt::kWarm)) return;
    }
  }

 private:
  enum class Attempt { kWarm, kCold, kTight, kLoose };
  static constexpr Attempt kAttempts[] = {Attempt::kWarm, Attempt::kCold, Attempt::kTight,
                                          Attempt::kLoose};

  /// A verdict that the data do not confirm is computed again with tighter tolerances (for an
  /// optimum that tolerances hide), then with looser ones (for a verdict that depends on violations
  /// near them).
  void set_tolerances(Attempt attempt) {
    SimplexOptions& o = engine_.options;
    o = options_;
    if (attempt == Attempt::kWarm || attempt == Attempt::kCold) return;
    const double factor = attempt == Attempt::kTight ? 0.01 : 100;
    o.primal_tolerance *= factor;
    o.dual_tolerance *= factor;
    o.zero_tolerance *= 0.01;
    o.singular_tolerance *= 0.01;
    o.max_updates = std::min(o.max_updates, 20);
  }

  bool try_once(const LinearProgram& program, LpSolution& solution, bool warm);
  Status run_rounds(const char*& reason);
  bool dual_feasible() const;
  bool read_basis(const LpSolution& solution);
  void write_basis(LpSolution& solution) const;
  void write_point(const LinearProgram& program, LpSolution& solution) const;
  void write_multipliers(LpSolution& solution) const;
  void write_farkas(const LinearProgram& program, LpSolution& solution);
  void write_ray(const LinearProgram& program, LpSolution& solution);
  void fail(const LinearProgram& program, LpSolution& solution, const char* reason) const;
  void report_crossing(const LinearProgram& program, LpSolution& solution) const;

  SimplexOptions options_;
  Engine engine_;
  LpScratch scratch_;
};

/// Returns false if there is no verdict that the data confirm and another attempt may help.
bool Simplex::try_once(const LinearProgram& program, LpSolution& solution, bool warm) {
  Engine& e = engine_;
  const int per_attempt = options_.max_iterations > 0 ? options_.max_iterations
                                                      : 2000 + 20 * (e.model.rows + e.model.cols);
  e.iteration_limit = options_.max_iterations > 0 ? per_attempt : e.iterations + per_attempt;
  e.start_attempt();
  if (!warm) e.crash_basis();
  const bool regular = e.refactor();
  if (warm && !regular) return false;
  const char* reason = "";
  Status status = run_rounds(reason);
  solution.status = status;
  solution.reason = reason;
  solution.iterations = e.iterations;
  write_point(program, solution);
  write_multipliers(solution);
  write_basis(solution);
  if (status == Status::kOptimal) solution.certificate.setZero(e.model.rows);
  if (status == Status::kInfeasible) write_farkas(program, solution);
  if (status == Status::kUnbounded) write_ray(program, solution);
  if (status == Status::kBudgetExhausted) return options_.max_iterations > 0;
  if (verified(program, solution, options_.verify_tolerance, scratch_)) return true;
  if (status == Status::kOptimal || status == Status::kUnbounded) {
    // A violation that scaling magnifies may be small as a residual of the rows.
    solution.x = solution.x.cwiseMax(program.l).cwiseMin(program.u);
    solution.objective = program.c.dot(solution.x);
    if (verified(program, solution, options_.verify_tolerance, scratch_)) return true;
  }
  if (status != Status::kNumericalError) {
    solution.status = Status::kNumericalError;
    solution.reason = "the verdict is not confirmed by the program's data";
  }
  return false;
}

/// Alternates the phases until the original bounds and costs are satisfied with fresh factors.
/// After a few rounds, perturbation is turned off, so that the remaining rounds are pure phases.
Status Simplex::run_rounds(const char*& reason) {
  Engine& e = engine_;
  int troubles = 0;
  for (int round = 0; round < kMaxRounds; ++round) {
    e.perturb = round < kPerturbedRounds;
    if (round > 0) {
      e.reset_bounds_and_costs();
      e.refactor();
    }
    e.compute_primal();
    e.compute_dual();
    const bool feasible = e.primal_feasible();
    if (feasible && dual_feasible()) {
      e.refine();
      return Status::kOptimal;
    }
    // Without sparse factors, the dual simplex shifts costs instead, as it does if this fails.
    const bool seek_signs = e.model.sparse && round == 0 && !feasible && !dual_feasible();
    switch (seek_signs ? e.find_dual_feasible_basis() : feasible ? e.primal() : e.dual()) {
      case Outcome::kDone:
        break;
      case Outcome::kInfeasible:
        reason = "the constraints contradict each other";
        return Status::kInfeasible;
      case Outcome::kUnbounded:
        e.reset_bounds_and_costs();
        e.refactor();
        e.compute_primal();
        if (!e.primal_feasible()) break;
        reason = "the objective grows without limit";
        return Status::kUnbounded;
      case Outcome::kIterationLimit:
        reason = "the iteration limit is reached";
        return Status::kBudgetExhausted;
      case Outcome::kTrouble:
        if (++troubles > kMaxTroubles) round = kMaxRounds;
        break;
    }
  }
  reason = "the bases are too badly conditioned";
  return Status::kNumericalError;
}

bool Simplex::dual_feasible() const {
  for (int j = engine_.model.rows; j < engine_.model.total; ++j) {
    if (!engine_.model.fixed[j] && engine_.dual_violation(j) != 0) return false;
  }
  return true;
}

/// In an `LpSolution` the program's columns come first, in the model the logical variables.
bool Simplex::read_basis(const LpSolution& solution) {
  Engine& e = engine_;
  const int m = e.model.rows, n = e.model.cols;
  if (static_cast<int>(solution.basis.size()) != m + n) return false;
  int basic = 0;
  for (int j = 0; j < m + n; ++j) {
    VariableState s = solution.basis[j < m ? n + j : j - m];
    const double l = e.model.lower[j], u = e.model.upper[j];
    if (s == VariableState::kBasic) {
      if (basic == m) return false;
      e.head[basic++] = j;
    } else if (s == VariableState::kAtLower ? !std::isfinite(l) : !std::isfinite(u)) {
      s = std::isfinite(l)   ? VariableState::kAtLower
          : std::isfinite(u) ? VariableState::kAtUpper
                             : VariableState::kFree;
    } else if (s == VariableState::kFree) {
      s = VariableState::kAtLower;
      if (!std::isfinite(l)) s = VariableState::kAtUpper;
    }
    e.state[j] = s;
  }
  return basic == m;
}

void Simplex::write_basis(LpSolution& solution) const {
  const int m = engine_.model.rows, n = engine_.model.cols;
  solution.basis.resize(m + n);
  for (int j = 0; j < n; ++j) solution.basis[j] = engine_.state[m + j];
  for (int i = 0; i < m; ++i) solution.basis[n + i] = engine_.state[i];
}

void Simplex::write_point(const LinearProgram& program, LpSolution& solution) const {
  const Engine& e = engine_;
  const int m = e.model.rows, n = e.model.cols;
  solution.x.resize(n);
  for (int j = 0; j < n; ++j) {
    if (e.state[m + j] != VariableState::kBasic) solution.x[j] = e.nonbasic_value(m + j);
  }
  for (int p = 0; p < m; ++p) {
    if (e.head[p] >= m) solution.x[e.head[p] - m] = e.x_basic[p];
  }
  for (int j = 0; j < n; ++j) {
    if (e.model.scaled) solution.x[j] *= e.model.col_scale[j];
    solution.x[j] /= e.model.rhs_scale;
    // The exact bound, not its scaled copy.
    if (e.state[m + j] == VariableState::kAtLower) solution.x[j] = program.l[j];
    if (e.state[m + j] == VariableState::kAtUpper) solution.x[j] = program.u[j];
  }
  solution.objective = program.c.dot(solution.x);
}

void Simplex::write_multipliers(LpSolution& solution) const {
  const Engine& e = engine_;
  solution.lambda.resize(e.model.rows);
  for (int i = 0; i < e.model.rows; ++i) {
    solution.lambda[i] = -e.y[i] * (e.model.scaled ? e.model.row_scale[i] : 1) / e.model.cost_scale;
  }
}

/// The tableau row that no values of the nonbasic variables can satisfy, as y'A x = y'b. Entries
/// that may be rounding errors are removed step by step until the proof holds.
void Simplex::write_farkas(const LinearProgram& program, LpSolution& solution) {
  Engine& e = engine_;
  const int m = e.model.rows;
  e.refined_inverse_row(e.proof_position);
  double largest = 0;
  for (const double v : e.rho) largest = std::max(largest, std::abs(v));
  solution.certificate.resize(m);
  for (const double noise : {0.0, 1e-15, 1e-13, 1e-11, 1e-9}) {
    for (int i = 0; i < m; ++i) {
      const double v = std::abs(e.rho[i]) <= noise * largest ? 0 : e.proof_sign * e.rho[i];
      solution.certificate[i] = v * (e.model.scaled ? e.model.row_scale[i] : 1);
    }
    if (verified(program, solution, options_.verify_tolerance, scratch_)) return;
  }
}

/// r_q = 1, r_B = -B^-1 a_q, with rounding errors removed in the same way.
void Simplex::write_ray(const LinearProgram& program, LpSolution& solution) {
  Engine& e = engine_;
  const int m = e.model.rows;
  e.column(e.proof_column, e.alpha_column.data());
  double largest = 1;
  for (const double a : e.alpha_column) largest = std::max(largest, std::abs(a));
  for (const double noise : {1e-15, 1e-13, 1e-11, 1e-9}) {
    solution.certificate.setZero(e.model.cols);
    solution.certificate[e.proof_column - m] = e.proof_sign;
    for (int p = 0; p < m; ++p) {
      const double a = e.alpha_column[p];
      if (e.head[p] < m || std::abs(a) <= noise * largest) continue;
      solution.certificate[e.head[p] - m] = -e.proof_sign * a;
    }
    for (int j = 0; e.model.scaled && j < e.model.cols; ++j) {
      solution.certificate[j] *= e.model.col_scale[j];
    }
    if (verified(program, solution, options_.verify_tolerance, scratch_)) return;
  }
}

void Simplex::fail(const LinearProgram& program, LpSolution& solution, const char* reason) const {
  solution.status = Status::kNumericalError;
  solution.reason = reason;
  solution.x.setZero(program.cols());
  solution.lambda.setZero(program.rows());
  solution.certificate.resize(0);
  solution.basis.clear();
}

void Simplex::report_crossing(const LinearProgram& program, LpSolution& solution) const {
  fail(program, solution, "a lower bound exceeds its upper bound");
  solution.status = Status::kInfeasible;
  solution.certificate.setZero(program.rows());
}

}  // namespace

std::unique_ptr<LpSolver> make_simplex(const SimplexOptions& options) {
  return std::make_unique<Simplex>(options);
}

}  // namespace maxwrench
