#include <IpIpoptApplication.hpp>
#include <IpSolveStatistics.hpp>
#include <IpTNLP.hpp>
#include <algorithm>

#include "solvers/ipopt_lock.h"
#include "solvers/lp/elastic.h"
#include "solvers/lp/makers.h"

namespace maxwrench {
namespace {

using Ipopt::Index;
using Ipopt::Number;

/// Beyond this an Ipopt bound is infinite (its default nlp_*_bound_inf).
constexpr double kIpoptInfinity = 1e19;

/// min -c'x subject to A x = b, l <= x <= u, in the form that Ipopt requires.
class LinearNlp : public Ipopt::TNLP {
 public:
  LinearNlp(const LinearProgram& program, Eigen::VectorXd start)
      : lp_(program), start_(std::move(start)) {}

  bool get_nlp_info(Index& n, Index& m, Index& nnz_jac, Index& nnz_hessian,
                    IndexStyleEnum& style) override {
    n = lp_.cols();
    m = lp_.rows();
    nnz_jac = static_cast<Index>(lp_.A.nonZeros());
    nnz_hessian = 0;
    style = TNLP::C_STYLE;
    return true;
  }
  bool get_bounds_info(Index n, Number* l, Number* u, Index m, Number* g_l, Number* g_u) override {
    for (Index j = 0; j < n; ++j) {
      l[j] = std::max(lp_.l[j], -kIpoptInfinity);
      u[j] = std::min(lp_.u[j], kIpoptInfinity);
    }
    for (Index i = 0; i < m; ++i) g_l[i] = g_u[i] = lp_.b[i];
    return true;
  }
  bool get_starting_point(Index n, bool /*init_x*/, Number* x, bool /*init_z*/, Number* /*z_l*/,
                          Number* /*z_u*/, Index /*m*/, bool /*init_lambda*/,
                          Number* /*lambda*/) override {
    std::copy(start_.data(), start_.data() + n, x);
    return true;
  }
  bool eval_f(Index n, const Number* x, bool /*new_x*/, Number& value) override {
    value = -lp_.c.dot(Eigen::Map<const Eigen::VectorXd>(x, n));
    return true;
  }
  bool eval_grad_f(Index n, const Number* /*x*/, bool /*new_x*/, Number* gradient) override {
    for (Index j = 0; j < n; ++j) gradient[j] = -lp_.c[j];
    return true;
  }
  bool eval_g(Index n, const Number* x, bool /*new_x*/, Index m, Number* g) override {
    Eigen::Map<Eigen::VectorXd>(g, m) = lp_.A * Eigen::Map<const Eigen::VectorXd>(x, n);
    return true;
  }
  bool eval_jac_g(Index n, const Number* /*x*/, bool /*new_x*/, Index /*m*/, Index /*count*/,
                  Index* rows, Index* cols, Number* values) override {
    Index k = 0;
    for (Index j = 0; j < n; ++j) {
      for (Eigen::SparseMatrix<double>::InnerIterator it(lp_.A, j); it; ++it, ++k) {
        if (values != nullptr) {
          values[k] = it.value();
        } else {
          rows[k] = static_cast<Index>(it.row());
          cols[k] = j;
        }
      }
    }
    return true;
  }
  bool eval_h(Index, const Number*, bool, Number, Index, const Number*, bool, Index, Index*, Index*,
              Number*) override {
    return true;  // a linear program has no curvature
  }
  void finalize_solution(Ipopt::SolverReturn, Index n, const Number* x, const Number*,
                         const Number*, Index m, const Number*, const Number* lambda, Number,
                         const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {
    // Ipopt's Lagrangian is -c'x + lambda'(A x - b), so its lambda is already d(c'x)/db.
    x_ = Eigen::Map<const Eigen::VectorXd>(x, n);
    lambda_ = Eigen::Map<const Eigen::VectorXd>(lambda, m);
  }

  const Eigen::VectorXd& x() const { return x_; }
  const Eigen::VectorXd& lambda() const { return lambda_; }

 private:
  const LinearProgram& lp_;
  Eigen::VectorXd start_, x_, lambda_;
};

/// A point inside the bounds.
Eigen::VectorXd interior_point(const LinearProgram& lp) {
  Eigen::VectorXd x(lp.cols());
  for (int j = 0; j < lp.cols(); ++j) {
    const bool low = std::isfinite(lp.l[j]);
    const bool high = std::isfinite(lp.u[j]);
    x[j] = low && high ? (lp.l[j] + lp.u[j]) / 2 : low ? lp.l[j] + 1 : high ? lp.u[j] - 1 : 0;
  }
  return x;
}

class IpoptSolver : public LpSolver {
 public:
  IpoptSolver() = default;
  IpoptSolver(const IpoptSolver&) = delete;
  IpoptSolver& operator=(const IpoptSolver&) = delete;
  /// Destroying the application ends its MUMPS, whose memory other threads share.
  ~IpoptSolver() override {
    const std::lock_guard guard(ipopt_lock());
    application_ = nullptr;
  }

  void solve(const LinearProgram& program, LpSolution& solution) override {
    const std::lock_guard guard(ipopt_lock());
    if (rejected(program, solution)) return;
    solution.basis.clear();
    if (run(program, solution)) {
      solution.status = Status::kOptimal;
      solution.reason = "";
      solution.objective = program.c.dot(solution.x);
      if (!verified(program, solution, kAccepted)) {
        give_up(solution, Status::kNumericalError, "ipopt: the answer does not verify");
      }
      return;
    }
    prove_no_optimum(
        program, [&](const LinearProgram& other, LpSolution& proof) { return run(other, proof); },
        solution);
  }

 private:
  /// Interior point methods end near a vertex, not exactly at it.
  static constexpr double kAccepted = 1e-6;

  bool run(const LinearProgram& program, LpSolution& solution) {
    if (!Ipopt::IsValid(application_)) start();
    const Ipopt::SmartPtr<LinearNlp> nlp = new LinearNlp(program, interior_point(program));
    const Ipopt::ApplicationReturnStatus status =
        application_->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(GetRawPtr(nlp)));
    solution.iterations = 0;
    if (Ipopt::IsValid(application_->Statistics())) {
      solution.iterations = application_->Statistics()->IterationCount();
    }
    if (nlp->x().size() != program.cols()) return false;
    solution.x = nlp->x().cwiseMax(program.l).cwiseMin(program.u);
    solution.lambda = nlp->lambda();
    return status == Ipopt::Solve_Succeeded || status == Ipopt::Solved_To_Acceptable_Level;
  }

  void start() {
    application_ = new Ipopt::IpoptApplication(false);
    auto options = application_->Options();
    options->SetIntegerValue("print_level", 0);
    options->SetStringValue("sb", "yes");
    options->SetNumericValue("tol", 1e-10);
    options->SetNumericValue("bound_relax_factor", 0);
    options->SetStringValue("mehrotra_algorithm", "yes");
    // The restoration phase has no affine step to correct, and would dereference a null pointer.
    options->SetStringValue("resto.mehrotra_algorithm", "no");
    options->SetStringValue("jac_c_constant", "yes");
    options->SetStringValue("hessian_constant", "yes");
    options->SetIntegerValue("max_iter", 150);  // the programs of Netlib take 10 to 55
    options->SetIntegerValue("mumps_pivot_order", kMumpsOrdering);
    application_->Initialize("");
  }

  Ipopt::SmartPtr<Ipopt::IpoptApplication> application_;
};

}  // namespace

std::unique_ptr<LpSolver> make_ipopt() { return std::make_unique<IpoptSolver>(); }

}  // namespace maxwrench
