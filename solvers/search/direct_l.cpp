#include "solvers/search/makers.h"
#include "solvers/search/nlopt_run.h"

namespace maxwrench {
namespace {

/// DIRECT-L: divides the bounds into boxes, first those that may hold the best value by any
/// Lipschitz constant, biased to local search (Gablonsky, Kelley, 2001). No random numbers: the
/// seed has an effect on the sample and the refinement only.
class Direct final : public Search {
 public:
  SearchResult maximize(Objective& objective, const SearchOptions& options) override {
    NloptOptions method;
    method.algorithm = NLOPT_GN_DIRECT_L;
    return search_in_stages(objective, options, 1, nlopt_restarts(method, 1));
  }
};

}  // namespace

std::unique_ptr<Search> make_direct_l() { return std::make_unique<Direct>(); }

}  // namespace maxwrench
