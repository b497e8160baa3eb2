#pragma once

#include <nlopt.h>

#include "solvers/search/local_search.h"

namespace maxwrench {

struct NloptOptions {
  const char* method;  ///< the search's name
  nlopt_algorithm algorithm;
  /// The local optimiser of a method that has one.
  nlopt_algorithm local = NLOPT_NUM_ALGORITHMS;
  double initial_step = 0;  ///< share of the bounds; 0: NLopt's own choice
  double x_tolerance = 0;   ///< share of the bounds; 0: runs until the budget is used
  double f_tolerance = 0;   ///< relative, of phi(f)
  double x_rough = 0;       ///< in place of x_tolerance where another search goes on; 0: none
  long evaluations_per_run = 1000;  ///< see `LocalSearch`
  long max_parallel = 8;            ///< see `LocalSearch`
};

/// Throws std::runtime_error, with the search's name, unless NLopt took what it was told.
void require_taken(nlopt_result result, const char* search);

/// NLopt's word for how it ended, without the shouting: "xtol_reached".
std::string word_of(nlopt_result result);

/// Runs of an algorithm of NLopt (S. G. Johnson) in the unit cube, each until it converges or its
/// evaluations are used; those that take a start begin there.
///
/// NLopt wants a finite number everywhere. It sees phi(f) = f / (s + |f|), s = max(1, |f(start)|):
/// increasing, so the maxima stay where they are, and inside (-1, 1), so that -1, the value of
/// postures without one, lies below every value. There the gradient is zero.
///
/// NLopt's random numbers live in a state of its own for each thread, which the local search's
/// stream seeds anew for each run: the result depends on the stream only.
std::unique_ptr<Search> make_nlopt_search(const NloptOptions& method);

}  // namespace maxwrench
