#pragma once

#include <nlopt.h>

#include "solvers/search/local_search.h"

namespace maxwrench {

struct NloptOptions {
  const char* method;  ///< the search's name
  nlopt_algorithm algorithm;
  /// The local optimiser of a method that needs one.
  nlopt_algorithm local = NLOPT_NUM_ALGORITHMS;
  double initial_step = 0;          ///< share of the bounds; 0: NLopt's own choice
  double x_tolerance = 0;           ///< share of the bounds; 0: runs until the budget is used
  double f_tolerance = 0;           ///< relative, of phi(f)
  double x_rough = 0;               ///< replaces x_tolerance if another search follows; 0: does not
  long evaluations_per_run = 1000;  ///< see `LocalSearch`
  long max_parallel = 8;            ///< see `LocalSearch`
};

/// Throws std::runtime_error, with the search's name, unless NLopt accepted a setting.
void require_taken(nlopt_result result, const char* search);

/// NLopt's status in lower case, without its prefix: "xtol_reached".
std::string word_of(nlopt_result result);

/// Runs of an algorithm of NLopt (S. G. Johnson) in the unit cube, each until it converges or its
/// evaluations are used. Algorithms that accept a start begin there.
///
/// NLopt needs a finite number everywhere. It gets phi(f) = f / (s + |f|), s = max(1, |f(start)|).
/// This function is increasing, so the maxima stay the same. Its values lie inside (-1, 1), so -1,
/// the value for points without a posture, is below all others. There the gradient is zero.
///
/// NLopt keeps the state of its random numbers in each thread. The local search's stream seeds it
/// before each run, so the result depends on the stream only.
std::unique_ptr<Search> make_nlopt_search(const NloptOptions& method);

}  // namespace maxwrench
