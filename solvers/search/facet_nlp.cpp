#include "solvers/search/facet_nlp.h"

#include <IpTNLP.hpp>
#include <algorithm>

#include "solvers/caught.h"
#include "solvers/ipopt_lock.h"
#include "solvers/search/ipopt_run.h"
#include "solvers/search/makers.h"

namespace maxwrench {
namespace {

using Ipopt::Index;
using Ipopt::Number;

constexpr int kFacetIterations = 100;
constexpr long kEvaluationsOfSolve = 250;

/// A `FacetView` in the form that Ipopt requires.
class FacetNlp : public Ipopt::TNLP {
 public:
  explicit FacetNlp(FacetView& view) : view_(view), end_(view.start()) {}

  bool get_nlp_info(Index& n, Index& m, Index& nnz_jac, Index& nnz_hessian,
                    IndexStyleEnum& style) override {
    n = static_cast<Index>(view_.start().size());
    m = static_cast<Index>(view_.row_min().size());
    nnz_jac = n * m;
    nnz_hessian = 0;
    style = TNLP::C_STYLE;
    return true;
  }
  bool get_bounds_info(Index, Number* l, Number* u, Index, Number* g_l, Number* g_u) override {
    write(view_.lower(), l);
    write(view_.upper(), u);
    write(view_.row_min(), g_l);
    write(view_.row_max(), g_u);
    return true;
  }
  bool get_starting_point(Index, bool, Number* x, bool, Number*, Number*, Index, bool,
                          Number*) override {
    write(view_.start(), x);
    return true;
  }
  bool eval_f(Index n, const Number* x, bool, Number& value) override {
    value = -view_.c_y().dot(Eigen::Map<const Eigen::VectorXd>(x, n));
    return true;
  }
  bool eval_grad_f(Index, const Number*, bool, Number* gradient) override {
    write(-view_.c_y(), gradient);
    return true;
  }
  bool eval_g(Index n, const Number* x, bool, Index, Number* g) override {
    if (!look(n, x)) return false;
    write(view_.rows(), g);
    return true;
  }
  bool eval_jac_g(Index n, const Number* x, bool, Index m, Index, Index* rows, Index* cols,
                  Number* values) override {
    if (values == nullptr) {
      for (Index i = 0; i < n * m; ++i) {
        rows[i] = i / n;
        cols[i] = i % n;
      }
      return true;
    }
    if (!look(n, x)) return false;
    return caught_.run(false, [&] {
      std::copy_n(view_.jacobian().data(), n * m, values);
      return true;
    });
  }
  bool intermediate_callback(Ipopt::AlgorithmMode, Index, Number, Number, Number, Number, Number,
                             Number, Number, Number, Index, const Ipopt::IpoptData*,
                             Ipopt::IpoptCalculatedQuantities*) override {
    return !view_.ended() && !caught_.any();
  }
  void finalize_solution(Ipopt::SolverReturn, Index n, const Number* x, const Number*,
                         const Number*, Index, const Number*, const Number*, Number,
                         const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {
    const Eigen::Map<const Eigen::VectorXd> end(x, n);
    if (end.allFinite()) end_ = end;
  }

  const Eigen::VectorXd& end() const { return end_; }
  void rethrow() { caught_.rethrow(); }

 private:
  static void write(const Eigen::VectorXd& from, Number* to) {
    std::copy_n(from.data(), from.size(), to);
  }
  bool look(Index n, const Number* x) {
    return caught_.run(false, [&] { return view_.look(Eigen::Map<const Eigen::VectorXd>(x, n)); });
  }

  FacetView& view_;
  Eigen::VectorXd end_;
  Caught caught_;
};

}  // namespace

FacetEnd solve_facets_by_ipopt(FacetView& view) {
  const std::lock_guard guard(ipopt_lock());
  const auto application = make_ipopt_application(
      "facet_nlp", kFacetIterations,
      [](Ipopt::OptionsList& options) { options.SetNumericValue("tol", 1e-9); });
  const Ipopt::SmartPtr<FacetNlp> nlp = new FacetNlp(view);
  const auto status = application->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(GetRawPtr(nlp)));
  nlp->rethrow();
  return {nlp->end(), word_of(status)};
}

namespace {

/// Ipopt (Wächter, Biegler 2006): an interior point method with exact first derivatives. A solve
/// takes far more time than its evaluations, so there are fewer solves than the budget allows.
class FacetNlpSearch final : public Search {
 public:
  SearchResult maximize(Objective& objective, const SearchOptions& options) override {
    return search_from_facet_starts("facet_nlp", objective, options, solve_facets_by_ipopt,
                                    options.budget / kEvaluationsOfSolve);
  }
};

}  // namespace

std::unique_ptr<Search> make_facet_nlp() { return std::make_unique<FacetNlpSearch>(); }

}  // namespace maxwrench
