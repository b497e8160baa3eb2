#pragma once

#include <cstdint>
#include <vector>

#include "solvers/search/probe.h"

namespace maxwrench {

struct RefineOptions {
  double step = 0.01;       ///< how far around a candidate to look first, as a share of the bounds
  double tolerance = 1e-9;  ///< an ascent ends when it looks less far than this
  double separation = 0;    ///< candidates closer than this (largest coordinate, share of the
                            ///< bounds) to a better one are dropped
  long ascents = 8;         ///< at most so many candidates share the first half of the budget
  long budget = 0;          ///< evaluations, never exceeded
  std::uint64_t seed = 0;
  int threads = 1;
};

/// The best candidates with a value, best first, at most `count`, each at least `separation`
/// (largest coordinate, share of the bounds) from all better ones; of equal ones the first counts.
std::vector<Candidate> select_apart(const Box& box, std::vector<Candidate> candidates,
                                    double separation, long count);

/// Improves the best of `candidates` without derivatives; `found` gets what the search has found so
/// far and returns with the best point of all and the trace continued.
///
/// Each ascent is an evolution strategy with covariance matrix adaptation (CMA-ES; Hansen, "The CMA
/// Evolution Strategy: A Tutorial", 2016) in the unit cube, projected onto the bounds. A capability
/// is piecewise smooth: its maxima often lie on sharp ridges that are not parallel to the axes,
/// where compass search and shrinking grids stall. The adapted covariance learns the ridge.
/// Points without a value rank last.
///
/// Schedule: up to `ascents` candidates, best first and no more than the budget gives 100 (d + 1)
/// evaluations each, share one half of the budget; the best of their results gets the rest.
/// An ascent that has converged before its share is used starts again at its best point, with the
/// first step and with a hundredth of it in turn, until two starts in a row bring nothing.
void refine(const Objective& objective, const Box& box, std::vector<Candidate> candidates,
            const RefineOptions& options, EvaluationCounter& progress, Part& found);

}  // namespace maxwrench
