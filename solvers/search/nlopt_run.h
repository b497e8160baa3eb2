#pragma once

#include <nlopt.h>

#include "solvers/search/stages.h"

namespace maxwrench {

struct NloptOptions {
  nlopt_algorithm algorithm = NLOPT_LN_COBYLA;
  /// The local optimiser of a method that has one.
  nlopt_algorithm local = NLOPT_NUM_ALGORITHMS;
  double initial_step = 0;  ///< share of the bounds; 0: NLopt's own choice
  double x_tolerance = 0;   ///< share of the bounds; 0: runs until the budget is used
};

/// One run of an algorithm of NLopt (S. G. Johnson) in the unit cube, from x, until it converges or
/// the probe has no evaluation left.
///
/// NLopt wants a finite number everywhere. It sees phi(f) = f / (s + |f|) with s = sample.scale:
/// increasing, so the maxima stay where they are, and inside (-1, 1), so that -1, the value of
/// postures without one, lies below every value. There the gradient is zero.
///
/// NLopt's random numbers live in a state of its own for each thread, which `random` seeds anew for
/// each run: the result depends on the stream only.
void run_nlopt(const NloptOptions& options, Probe& probe, const Box& box, const Sample& sample,
               Eigen::VectorXd x, Random& random);

/// Runs one after the other until the budget of the climb is used: from start number `part` of the
/// sample, then from every `parts`-th one after it, then from random points.
Climb nlopt_restarts(const NloptOptions& options, long parts);

}  // namespace maxwrench
