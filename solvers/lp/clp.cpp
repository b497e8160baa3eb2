#include <ClpSimplex.hpp>
#include <algorithm>
#include <cmath>

#include "solvers/lp/elastic.h"
#include "solvers/lp/makers.h"

namespace maxwrench {
namespace {

/// Clp's own codes of `status()`.
constexpr int kClpOptimal = 0;
constexpr int kClpPrimalInfeasible = 1;
constexpr int kClpDualInfeasible = 2;

ClpSimplex::Status to_clp(VariableState state) {
  switch (state) {
    case VariableState::kAtLower:
      return ClpSimplex::atLowerBound;
    case VariableState::kAtUpper:
      return ClpSimplex::atUpperBound;
    case VariableState::kFree:
      return ClpSimplex::isFree;
    case VariableState::kBasic:
      break;
  }
  return ClpSimplex::basic;
}

VariableState from_clp(ClpSimplex::Status status) {
  switch (status) {
    case ClpSimplex::basic:
      return VariableState::kBasic;
    case ClpSimplex::atUpperBound:
      return VariableState::kAtUpper;
    case ClpSimplex::isFree:
    case ClpSimplex::superBasic:
      return VariableState::kFree;
    default:
      return VariableState::kAtLower;
  }
}

class Clp : public LpSolver {
 public:
  explicit Clp(bool keep_model, ClpMethod method = ClpMethod::kDual)
      : keep_model_(keep_model), method_(method) {}

  void solve(const LinearProgram& program, LpSolution& solution) override {
    if (rejected(program, solution)) return;
    // For a small program, scaling costs more than the solution. The dual simplex temporarily
    // bounds free columns by 1e10. This can leave columns 1e-6 off their bounds, or leave free
    // columns near 1e10 although any value would do, with rows that balance only to 1e-6. A failed
    // attempt is repeated with scaling and the primal simplex.
    solve_by_attempts(
        program,
        [this](const LinearProgram& other, bool warm, bool careful, LpSolution& answer) {
          return try_once(other, warm, careful, answer);
        },
        solution);
  }

 private:
  /// Whether a free column is near the temporary bound of the dual simplex.
  static bool far_out(const LinearProgram& program, const Eigen::VectorXd& x) {
    for (int j = 0; j < program.cols(); ++j) {
      const bool free = program.l[j] == -kInfinity && program.u[j] == kInfinity;
      if (free && std::abs(x[j]) > 1e9) return true;
    }
    return false;
  }

  /// Returns false if there is no verdict that the data confirm.
  bool try_once(const LinearProgram& program, bool warm, bool careful, LpSolution& solution) {
    const int status = run(program, warm, careful, solution);
    if (status == kClpOptimal) {
      solution.status = Status::kOptimal;
      solution.reason = "";
      if (!careful && far_out(program, solution.x)) return false;
      return verified(program, solution, careful ? 1e-7 : 1e-9, scratch_);
    }
    if (status == kClpPrimalInfeasible) {
      return prove(program, model_.infeasibilityRay(), program.rows(), Status::kInfeasible,
                   "no x satisfies the rows within its bounds", solution);
    }
    if (status != kClpDualInfeasible) return false;
    model_.primal(1);
    solution.x = Eigen::Map<const Eigen::VectorXd>(model_.primalColumnSolution(), program.cols());
    return prove(program, model_.unboundedRay(), program.cols(), Status::kUnbounded,
                 "the objective grows without limit", solution);
  }

  /// Stores a ray, which Clp allocated, with the sign that proves the status.
  bool prove(const LinearProgram& program, double* ray, int size, Status status, const char* reason,
             LpSolution& solution) {
    if (ray == nullptr) return false;
    solution.certificate = Eigen::Map<const Eigen::VectorXd>(ray, size);
    delete[] ray;
    drop_rounding(solution.certificate);
    solution.status = status;
    solution.reason = reason;
    if (verified(program, solution, 1e-7, scratch_)) return true;
    solution.certificate = -solution.certificate;
    return verified(program, solution, 1e-7, scratch_);
  }

  int run(const LinearProgram& program, bool warm, bool careful, LpSolution& solution) {
    load(program, careful);
    const int rows = program.rows();
    const int cols = program.cols();
    if (!warm && keep_model_) model_.allSlackBasis();
    if (warm) {
      for (int j = 0; j < cols; ++j) model_.setColumnStatus(j, to_clp(solution.basis[j]));
      for (int i = 0; i < rows; ++i) model_.setRowStatus(i, to_clp(solution.basis[cols + i]));
    }
    if (careful || method_ == ClpMethod::kPrimal) {
      model_.primal();
    } else if (method_ == ClpMethod::kDual) {
      model_.dual();
    } else {
      ClpSolve options;
      options.setSolveType(ClpSolve::automatic);
      options.setPresolveType(ClpSolve::presolveOn);
      model_.initialSolve(options);
    }
    solution.iterations += model_.numberIterations();
    solution.x = Eigen::Map<const Eigen::VectorXd>(model_.primalColumnSolution(), cols);
    // Clp minimises -c'x here.
    solution.lambda = -Eigen::Map<const Eigen::VectorXd>(model_.dualRowSolution(), rows);
    solution.objective = program.c.dot(solution.x);
    solution.basis.resize(rows + cols);
    for (int j = 0; j < cols; ++j) solution.basis[j] = from_clp(model_.getColumnStatus(j));
    for (int i = 0; i < rows; ++i) solution.basis[cols + i] = from_clp(model_.getRowStatus(i));
    return model_.status();
  }

  void load(const LinearProgram& program, bool careful) {
    matrix_ = program.A;
    matrix_.makeCompressed();
    cost_ = -program.c;
    if (keep_model_ && !careful && edit(program)) return;
    model_ = ClpSimplex();
    model_.setLogLevel(0);
    // Zeros then stay in the pattern, and other numbers can replace them.
    if (keep_model_) model_.setSmallElementValue(0);
    model_.loadProblem(program.cols(), program.rows(), matrix_.outerIndexPtr(),
                       matrix_.innerIndexPtr(), matrix_.valuePtr(), program.l.data(),
                       program.u.data(), cost_.data(), program.b.data(), program.b.data());
    model_.setPerturbation(100);  // 100 turns it off
    model_.scaling(careful || method_ != ClpMethod::kDual ? 3 : 0);
    model_.setPrimalTolerance(1e-9);
    model_.setDualTolerance(1e-9);
    model_.setMaximumIterations(5000 + 50 * (program.rows() + program.cols()));
    editable_ = !careful;
  }

  /// Replaces the program in the stored model; returns false if the pattern differs.
  bool edit(const LinearProgram& program) {
    if (!editable_ || program.cols() != model_.numberColumns() ||
        program.rows() != model_.numberRows()) {
      return false;
    }
    CoinPackedMatrix& held = *model_.matrix();
    const auto count = static_cast<std::size_t>(matrix_.nonZeros());
    const auto columns = static_cast<std::size_t>(program.cols());
    const bool same =
        held.getNumElements() == matrix_.nonZeros() &&
        std::equal(held.getVectorStarts(), held.getVectorStarts() + columns + 1,
                   matrix_.outerIndexPtr()) &&
        std::equal(held.getIndices(), held.getIndices() + count, matrix_.innerIndexPtr());
    if (!same) return false;
    std::copy_n(matrix_.valuePtr(), count, held.getMutableElements());
    std::copy_n(cost_.data(), columns, model_.objective());
    std::copy_n(program.l.data(), columns, model_.columnLower());
    std::copy_n(program.u.data(), columns, model_.columnUpper());
    std::copy_n(program.b.data(), program.rows(), model_.rowLower());
    std::copy_n(program.b.data(), program.rows(), model_.rowUpper());
    return true;
  }

  bool keep_model_;
  ClpMethod method_;
  bool editable_ = false;  ///< the model was loaded with the fast settings
  ClpSimplex model_;
  Eigen::SparseMatrix<double> matrix_;
  Eigen::VectorXd cost_;
  LpScratch scratch_;
};

}  // namespace

std::unique_ptr<LpSolver> make_clp() { return std::make_unique<Clp>(false); }
std::unique_ptr<LpSolver> make_clp_by(ClpMethod method) {
  return std::make_unique<Clp>(false, method);
}
std::unique_ptr<LpSolver> make_clp_keeping_its_model() { return std::make_unique<Clp>(true); }

}  // namespace maxwrench
