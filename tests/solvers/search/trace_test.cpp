#include "solvers/search/trace.h"

#include <gtest/gtest.h>

namespace maxwrench {
namespace {

Trace trace_of(std::initializer_list<double> values) {
  Trace trace;
  for (const double value : values) trace.add(value);
  return trace;
}

std::vector<std::pair<long, double>> pairs(const Trace& trace) {
  std::vector<std::pair<long, double>> pairs;
  for (const Improvement& each : trace.improvements())
    pairs.emplace_back(each.evaluations, each.value);
  return pairs;
}

using Pairs = std::vector<std::pair<long, double>>;

TEST(Trace, KeepsImprovementsOnly) {
  EXPECT_EQ(pairs(trace_of({-kInfinity, 1, 1, 0, 3})), (Pairs{{2, 1}, {5, 3}}));
}

TEST(Trace, GoesOnWithALaterOne) {
  Trace trace = trace_of({1, 2});
  trace.append(trace_of({0, 1.5, 3}));
  EXPECT_EQ(pairs(trace), (Pairs{{1, 1}, {2, 2}, {5, 3}}));
  EXPECT_EQ(trace.evaluations(), 5);
}

TEST(Trace, PartsTakeTurns) {
  const std::vector<Trace> parts = {trace_of({1, 4, 6}), trace_of({2, 3}), trace_of({0.5, 0, 7})};
  // Turn one: 1, 2, 0.5; turn two: 4, 3, 0; turn three: 6, 7. One evaluation went before.
  Trace trace = trace_of({0});
  trace.append(parts);
  EXPECT_EQ(pairs(trace), (Pairs{{1, 0}, {2, 1}, {3, 2}, {5, 4}, {8, 6}, {9, 7}}));
  EXPECT_EQ(trace.evaluations(), 9);
}

}  // namespace
}  // namespace maxwrench
