#include "tests/support/ipopt_qp.h"

#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>
#include <algorithm>
#include <stdexcept>

#include "solvers/ipopt/ipopt_lock.h"

namespace maxwrench {
namespace {

using Eigen::VectorXd;
using Ipopt::Index;
using Ipopt::Number;

/// The program in the form that Ipopt requires, with all matrices dense.
class Nlp : public Ipopt::TNLP {
 public:
  explicit Nlp(const QuadraticProgram& program) : qp_(program) {}

  bool get_nlp_info(Index& n, Index& m, Index& jacobian, Index& hessian,
                    IndexStyleEnum& style) override {
    n = static_cast<Index>(qp_.f.size());
    m = static_cast<Index>(qp_.b.size());
    jacobian = n * m;
    hessian = n * (n + 1) / 2;
    style = TNLP::C_STYLE;
    return true;
  }
  bool get_bounds_info(Index n, Number* l, Number* u, Index m, Number* g_l, Number* g_u) override {
    std::copy_n(qp_.lower.data(), n, l);
    std::copy_n(qp_.upper.data(), n, u);
    std::copy_n(qp_.b.data(), m, g_l);
    std::copy_n(qp_.b.data(), m, g_u);
    return true;
  }
  bool get_starting_point(Index n, bool, Number* x, bool, Number*, Number*, Index, bool,
                          Number*) override {
    for (Index i = 0; i < n; ++i) x[i] = std::clamp(0.0, qp_.lower[i], qp_.upper[i]);
    return true;
  }
  bool eval_f(Index n, const Number* x, bool, Number& value) override {
    const Eigen::Map<const VectorXd> at(x, n);
    value = at.dot(qp_.H * at) / 2 - qp_.f.dot(at);
    return true;
  }
  bool eval_grad_f(Index n, const Number* x, bool, Number* gradient) override {
    Eigen::Map<VectorXd>(gradient, n) = qp_.H * Eigen::Map<const VectorXd>(x, n) - qp_.f;
    return true;
  }
  bool eval_g(Index n, const Number* x, bool, Index m, Number* g) override {
    Eigen::Map<VectorXd>(g, m) = qp_.A * Eigen::Map<const VectorXd>(x, n);
    return true;
  }
  bool eval_jac_g(Index n, const Number*, bool, Index m, Index, Index* rows, Index* cols,
                  Number* values) override {
    for (Index i = 0, k = 0; i < m; ++i) {
      for (Index j = 0; j < n; ++j, ++k) {
        if (values != nullptr) {
          values[k] = qp_.A(i, j);
        } else {
          rows[k] = i;
          cols[k] = j;
        }
      }
    }
    return true;
  }
  bool eval_h(Index n, const Number*, bool, Number factor, Index, const Number*, bool, Index,
              Index* rows, Index* cols, Number* values) override {
    for (Index i = 0, k = 0; i < n; ++i) {
      for (Index j = 0; j <= i; ++j, ++k) {
        if (values != nullptr) {
          values[k] = factor * qp_.H(i, j);
        } else {
          rows[k] = i;
          cols[k] = j;
        }
      }
    }
    return true;
  }
  void finalize_solution(Ipopt::SolverReturn, Index n, const Number* x, const Number*,
                         const Number*, Index, const Number*, const Number*, Number,
                         const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {
    x_ = Eigen::Map<const VectorXd>(x, n);
  }

  const VectorXd& x() const { return x_; }

 private:
  const QuadraticProgram& qp_;
  VectorXd x_;
};

}  // namespace

VectorXd solve_by_ipopt(const QuadraticProgram& program) {
  const std::lock_guard guard(ipopt_lock());
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> application = new Ipopt::IpoptApplication(false);
  application->Options()->SetIntegerValue("print_level", 0);
  application->Options()->SetStringValue("sb", "yes");
  application->Options()->SetNumericValue("tol", 1e-11);
  application->Options()->SetNumericValue("bound_relax_factor", 0);
  application->Initialize("");
  const Ipopt::SmartPtr<Nlp> nlp = new Nlp(program);
  const Ipopt::ApplicationReturnStatus status =
      application->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(GetRawPtr(nlp)));
  if (status != Ipopt::Solve_Succeeded && status != Ipopt::Solved_To_Acceptable_Level) {
    throw std::runtime_error("ipopt found no optimum");
  }
  return nlp->x();
}

}  // namespace maxwrench
