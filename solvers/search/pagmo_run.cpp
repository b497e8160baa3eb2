#include <algorithm>
#include <limits>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/algorithms/de.hpp>
#include <pagmo/algorithms/sade.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>

#include "solvers/search/local_search.h"
#include "solvers/search/makers.h"

// The methods of pagmo (Biscani, Izzo 2020). Its headers are large, so only this file includes
// them.

namespace maxwrench {
namespace {

/// Thrown to end a run of pagmo, which counts only generations: the probe has no evaluation left,
/// or the run has produced numbers that are not finite.
struct Stop {
  const char* why;
};

/// -f over the unit cube. pagmo minimises, and these methods use only which of two values is
/// smaller, so a point without a value gets the largest number.
struct UnitCube {
  Probe* probe = nullptr;
  const Box* box = nullptr;
  pagmo::vector_double fitness(const pagmo::vector_double& x) const {
    if (probe->left() == 0) throw Stop{kBudgetUsed};
    const Eigen::Map<const Eigen::VectorXd> point(x.data(), static_cast<Eigen::Index>(x.size()));
    if (!point.allFinite()) throw Stop{"not_finite"};
    const double value = probe->evaluate(box->theta_r(point));
    return {value == -kInfinity ? std::numeric_limits<double>::max() : -value};
  }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    const auto n = static_cast<std::size_t>(box->free());
    return {pagmo::vector_double(n, 0.0), pagmo::vector_double(n, 1.0)};
  }
};

constexpr double kPagmoTolerance = 1e-9;  // of x and of f: a run below this has converged

/// `size` points: the start first, the others up to `reach` from it in each coordinate.
pagmo::population make_population(const UnitCube& cube, const Candidate& start, long size,
                                  double reach, Random& random) {
  pagmo::population population(pagmo::problem(cube), 0, 0);
  const Eigen::VectorXd x = cube.box->unit(start.theta_r);
  population.push_back({x.begin(), x.end()}, {-start.value});
  while (static_cast<long>(population.size()) < size) {
    pagmo::vector_double y;
    for (const double x_j : x) {
      y.push_back(random.uniform(std::max(0.0, x_j - reach), std::min(1.0, x_j + reach)));
    }
    population.push_back(y);
  }
  return population;
}

/// Runs an algorithm of pagmo from a population until it converges or its evaluations are used. The
/// local search's stream seeds its random numbers; pagmo's own seeds are not used.
/// `make(generations, seed)` makes the algorithm.
template <class Make>
SearchResult search_by_pagmo(const char* method, int members, double reach, Objective& objective,
                             const SearchOptions& options, const Make& make) {
  LocalSearch local_search{method};
  local_search.evaluations_per_run = 5000;
  local_search.optimise = [&](Probe& probe, const Box& box, const Candidate& start,
                              Random& random) {
    const long size = 10 + members * box.free();
    const auto generations = static_cast<unsigned>(probe.left() / size + 1);
    const auto seed = static_cast<unsigned>(random.next() >> 32U);
    try {
      make(generations, seed).evolve(make_population({&probe, &box}, start, size, reach, random));
    } catch (const Stop& stop) {
      return stop.why;
    }
    return "converged";
  };
  return multistart_search(objective, options, local_search);
}

/// CMA-ES of pagmo. The restarts are ours, and the samples are clamped to the bounds.
class PagmoCmaes final : public Search {
 public:
  SearchResult maximize(Objective& objective, const SearchOptions& options) override {
    const double step = options.starts.empty() ? 0.3 : 0.02;
    const auto make = [step](unsigned generations, unsigned seed) {
      return pagmo::cmaes(generations, -1, -1, -1, -1, step, kPagmoTolerance, kPagmoTolerance,
                          false, true, seed);
    };
    return search_by_pagmo("pagmo_cmaes", 3, step, objective, options, make);
  }
};

/// Differential evolution (Storn, Price 1997), variant rand/1/exp.
class DifferentialEvolution final : public Search {
 public:
  SearchResult maximize(Objective& objective, const SearchOptions& options) override {
    const auto make = [](unsigned generations, unsigned seed) {
      return pagmo::de(generations, 0.8, 0.9, 2U, kPagmoTolerance, kPagmoTolerance, seed);
    };
    return search_by_pagmo("de", 5, 1, objective, options, make);
  }
};

/// Self-adaptive differential evolution: jDE (Brest and others 2006).
class SelfAdaptiveDe final : public Search {
 public:
  SearchResult maximize(Objective& objective, const SearchOptions& options) override {
    const auto make = [](unsigned generations, unsigned seed) {
      return pagmo::sade(generations, 2U, 1U, kPagmoTolerance, kPagmoTolerance, false, seed);
    };
    return search_by_pagmo("sade", 5, 1, objective, options, make);
  }
};

}  // namespace

std::unique_ptr<Search> make_pagmo_cmaes() { return std::make_unique<PagmoCmaes>(); }

std::unique_ptr<Search> make_de() { return std::make_unique<DifferentialEvolution>(); }

std::unique_ptr<Search> make_sade() { return std::make_unique<SelfAdaptiveDe>(); }

}  // namespace maxwrench
