#pragma once

#include <span>
#include <vector>

#include "maxwrench/search.h"

namespace maxwrench {

/// What a search, or a part of one, has seen: how many values, and each that was above all before.
class Trace {
 public:
  Trace() = default;
  /// What a search has seen.
  Trace(std::vector<Improvement> improvements, long evaluations)
      : evaluations_(evaluations), improvements_(std::move(improvements)) {}

  /// One more value, -infinity if there was none.
  void add(double value);

  /// What happened after this trace ended.
  void append(const Trace& later);

  /// What happened after this trace ended, in parts that ran side by side: they are taken as if
  /// they had evaluated in turns, one point each, the first part first; a part that has ended
  /// passes. So the order does not depend on the threads.
  void append(std::span<const Trace> parts);

  long evaluations() const { return evaluations_; }
  const std::vector<Improvement>& improvements() const { return improvements_; }

 private:
  void improve(const Improvement& improvement);

  long evaluations_ = 0;
  std::vector<Improvement> improvements_;
};

}  // namespace maxwrench
