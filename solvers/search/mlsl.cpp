#include "solvers/search/makers.h"
#include "solvers/search/nlopt_run.h"

namespace maxwrench {
namespace {

/// Multi-level single-linkage (Rinnooy Kan, Timmer 1987): local climbs with the exact gradient from
/// random points, at most one for each cluster of points.
class Mlsl final : public Search {
 public:
  SearchResult maximize(Objective& objective, const SearchOptions& options) override {
    NloptOptions method;
    method.algorithm = NLOPT_G_MLSL;
    method.local = NLOPT_LD_LBFGS;
    method.x_tolerance = 1e-7;
    return search_in_stages(objective, options, 1, nlopt_restarts(method, 1));
  }
};

}  // namespace

std::unique_ptr<Search> make_mlsl() { return std::make_unique<Mlsl>(); }

}  // namespace maxwrench
