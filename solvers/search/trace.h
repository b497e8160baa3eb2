#pragma once

#include <span>
#include <vector>

#include "maxwrench/search.h"

namespace maxwrench {

/// The record of a search, or of a part of one: how many values it evaluated, and each value above
/// all earlier ones.
class Trace {
 public:
  Trace() = default;
  /// The trace of a search that has ended.
  Trace(std::vector<Improvement> improvements, long evaluations)
      : evaluations_(evaluations), improvements_(std::move(improvements)) {}

  /// One more value, -infinity if there was none.
  void add(double value);

  /// Appends what happened after this trace ended.
  void append(const Trace& later);

  /// Appends what happened after this trace ended, in parts that ran in parallel. The order is as
  /// if they had evaluated in turns, one point each, the first part first, skipping parts that have
  /// ended. So it does not depend on the threads.
  void append(std::span<const Trace> parts);

  long evaluations() const { return evaluations_; }
  const std::vector<Improvement>& improvements() const { return improvements_; }

 private:
  void improve(const Improvement& improvement);

  long evaluations_ = 0;
  std::vector<Improvement> improvements_;
};

}  // namespace maxwrench
