#include "solvers/search/facet_nlp.h"

#include <algorithm>

#include "solvers/ipopt/ipopt_lock.h"
#include "solvers/ipopt/ipopt_nlp.h"
#include "solvers/search/makers.h"

namespace maxwrench {
namespace {

constexpr int kFacetIterations = 100;
constexpr long kEvaluationsOfSolve = 250;

/// A `FacetView` as Ipopt wants it.
class FacetNlp final : public IpoptNlp {
 public:
  explicit FacetNlp(FacetView& view)
      : IpoptNlp({view.start(), view.lower(), view.upper(), view.row_min(), view.row_max(),
                  all_entries(view.row_min().size(), view.start().size())}),
        view_(view) {}

 private:
  /// Row by row, as `FacetView::jacobian` is stored.
  static std::vector<std::pair<Ipopt::Index, Ipopt::Index>> all_entries(Eigen::Index rows,
                                                                        Eigen::Index columns) {
    std::vector<std::pair<Ipopt::Index, Ipopt::Index>> entries;
    for (Eigen::Index i = 0; i < rows * columns; ++i) {
      entries.emplace_back(i / columns, i % columns);
    }
    return entries;
  }

  bool value(const Point& y, double& f) override {
    f = -view_.c_y().dot(y);
    return true;
  }
  bool gradient(const Point& /*y*/, Result slopes) override {
    slopes = -view_.c_y();
    return true;
  }
  bool rows(const Point& y, Result g) override {
    if (!view_.look(y)) return false;
    g = view_.rows();
    return true;
  }
  bool jacobian(const Point& y, Result values) override {
    if (!view_.look(y)) return false;
    std::copy_n(view_.jacobian().data(), values.size(), values.data());
    return true;
  }
  bool ended() override { return view_.ended(); }

  FacetView& view_;
};

}  // namespace

FacetEnd solve_facets_by_ipopt(FacetView& view) {
  const std::lock_guard guard(ipopt_lock());
  const auto application = make_ipopt_application(
      "facet_nlp", kFacetIterations,
      [](Ipopt::OptionsList& options) { options.SetNumericValue("tol", 1e-9); });
  const Ipopt::SmartPtr<FacetNlp> nlp = new FacetNlp(view);
  const auto status = minimize(*application, *nlp);
  return {nlp->x(), word_of(status)};
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
