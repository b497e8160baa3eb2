#pragma once

#include <atomic>
#include <functional>
#include <memory>

#include "maxwrench/objective.h"

namespace maxwrench {

/// The wish to end a search early, and what became of it.
struct Interruption {
  std::function<bool()> asked;       ///< from any thread; empty: nobody asks
  std::atomic<bool> noticed{false};  ///< a search gave up evaluations because of it
  std::atomic<long> skipped{0};      ///< evaluations that it counts but did not make
};

/// An objective that has no value anywhere as soon as it is asked to end: searches spend the rest
/// of their budget at once and return the best they saw. (They run in threads and inside C
/// libraries, through which no exception may travel.) `interruption` outlives it and its clones; if
/// nobody asks: returns `objective`.
std::unique_ptr<Objective> make_interruptible(std::unique_ptr<Objective> objective,
                                              Interruption& interruption);

}  // namespace maxwrench
