#include "solvers/search/facet_sqp.h"

#include <memory>

#include "solvers/search/makers.h"
#include "solvers/search/row_sqp.h"

namespace maxwrench {
namespace {

constexpr int kSqpPoints = 400;

}  // namespace

FacetEnd solve_facets_by_slsqp(FacetView& view) { return solve_rows_by_slsqp(view, kSqpPoints); }

namespace {

/// SLSQP (Kraft 1994) of NLopt: sequential quadratic programs with exact first derivatives.
class FacetSqp final : public Search {
 public:
  SearchResult maximize(Objective& objective, const SearchOptions& options) override {
    return search_from_facet_starts("facet_sqp", objective, options, solve_facets_by_slsqp);
  }
};

}  // namespace

std::unique_ptr<Search> make_facet_sqp() { return std::make_unique<FacetSqp>(); }

}  // namespace maxwrench
