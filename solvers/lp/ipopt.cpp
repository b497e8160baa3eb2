#include <IpSolveStatistics.hpp>
#include <algorithm>

#include "solvers/ipopt/ipopt_lock.h"
#include "solvers/ipopt/ipopt_nlp.h"
#include "solvers/lp/elastic.h"
#include "solvers/lp/makers.h"

namespace maxwrench {
namespace {

/// min -c'x subject to A x = b, l <= x <= u. Ipopt's Lagrangian is -c'x + lambda'(A x - b), so its
/// lambda is already d(c'x)/db.
class LinearNlp final : public IpoptNlp {
 public:
  LinearNlp(const LinearProgram& program, const Eigen::VectorXd& start)
      : IpoptNlp({start, program.l, program.u, program.b, program.b, entries_of(program.A)}),
        lp_(program) {}

 private:
  bool value(const Point& x, double& f) override {
    f = -lp_.c.dot(x);
    return true;
  }
  bool gradient(const Point& /*x*/, Result slopes) override {
    slopes = -lp_.c;
    return true;
  }
  bool rows(const Point& x, Result g) override {
    g = lp_.A * x;
    return true;
  }
  bool jacobian(const Point& /*x*/, Result values) override {
    Eigen::Index k = 0;
    for (Eigen::Index j = 0; j < lp_.A.outerSize(); ++j) {
      for (Eigen::SparseMatrix<double>::InnerIterator it(lp_.A, j); it; ++it) {
        values[k++] = it.value();
      }
    }
    return true;
  }

  const LinearProgram& lp_;
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
        give_up(solution, Status::kNumericalError, "ipopt: the answer fails verification");
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
    const Ipopt::ApplicationReturnStatus status = minimize(*application_, *nlp);
    solution.iterations = 0;
    if (Ipopt::IsValid(application_->Statistics())) {
      solution.iterations = application_->Statistics()->IterationCount();
    }
    if (nlp->lambda().size() != program.rows()) return false;
    solution.x = nlp->x().cwiseMax(program.l).cwiseMin(program.u);
    solution.lambda = nlp->lambda();
    return status == Ipopt::Solve_Succeeded || status == Ipopt::Solved_To_Acceptable_Level;
  }

  void start() {
    constexpr int kIterations = 150;  // Netlib's programs take 10 to 55
    application_ = make_ipopt_application("ipopt", kIterations, [](Ipopt::OptionsList& options) {
      options.SetNumericValue("tol", 1e-10);
      options.SetStringValue("mehrotra_algorithm", "yes");
      // Its restoration phase has no affine step to correct, and would follow a null pointer.
      options.SetStringValue("resto.mehrotra_algorithm", "no");
      options.SetStringValue("jac_c_constant", "yes");
      options.SetStringValue("hessian_approximation", "exact");
      options.SetStringValue("hessian_constant", "yes");
    });
  }

  Ipopt::SmartPtr<Ipopt::IpoptApplication> application_;
};

}  // namespace

std::unique_ptr<LpSolver> make_ipopt() { return std::make_unique<IpoptSolver>(); }

}  // namespace maxwrench
