#include "solvers/search/makers.h"
#include "solvers/search/nlopt_run.h"

namespace maxwrench {
namespace {

/// Improved stochastic ranking evolution strategy (Runarsson, Yao 2005), in populations side by
/// side.
class Isres final : public Search {
 public:
  SearchResult maximize(Objective& objective, const SearchOptions& options) override {
    NloptOptions method;
    method.algorithm = NLOPT_GN_ISRES;
    const long parts = parts_of(options.budget);
    return search_in_stages(objective, options, parts, nlopt_restarts(method, parts));
  }
};

}  // namespace

std::unique_ptr<Search> make_isres() { return std::make_unique<Isres>(); }

}  // namespace maxwrench
