#include "solvers/search/makers.h"
#include "solvers/search/nlopt_run.h"

namespace maxwrench {
namespace {

/// COBYLA (Powell 1994), linear models on a simplex without derivatives, from the best points of
/// the sample and then from random ones.
class Cobyla final : public Search {
 public:
  SearchResult maximize(Objective& objective, const SearchOptions& options) override {
    NloptOptions method;
    method.algorithm = NLOPT_LN_COBYLA;
    method.initial_step = 0.1;
    method.x_tolerance = 1e-6;
    const long parts = parts_of(options.budget);
    return search_in_stages(objective, options, parts, nlopt_restarts(method, parts));
  }
};

}  // namespace

std::unique_ptr<Search> make_cobyla() { return std::make_unique<Cobyla>(); }

}  // namespace maxwrench
