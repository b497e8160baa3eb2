#include "solvers/search/makers.h"
#include "solvers/search/nlopt_run.h"

namespace maxwrench {
namespace {

/// Controlled random search with local mutation (Price 1983; Kaelo, Ali 2006): a population that
/// random simplices pull together. Populations side by side, each started anew when it has
/// converged.
class Crs2 final : public Search {
 public:
  SearchResult maximize(Objective& objective, const SearchOptions& options) override {
    NloptOptions method;
    method.algorithm = NLOPT_GN_CRS2_LM;
    method.x_tolerance = 1e-7;
    const long parts = parts_of(options.budget);
    return search_in_stages(objective, options, parts, nlopt_restarts(method, parts));
  }
};

}  // namespace

std::unique_ptr<Search> make_crs2() { return std::make_unique<Crs2>(); }

}  // namespace maxwrench
