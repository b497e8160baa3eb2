#include <gtest/gtest.h>

#include "maxwrench/load.h"
#include "maxwrench/map.h"

namespace maxwrench {
namespace {

/// Cells of a level read those of earlier levels while others of it are computed.
TEST(Threads, CellsOfAMapAreComputedAtOnce) {
  const Problem problem = load_problem("planar/force");
  MapPlan plan;
  plan.over = {{"yaw", -0.5, 0.5, 6}, {"azimuth", 0, 3, 6}};
  long stored = 0;
  plan.computed = [&stored](const MapCell&) { ++stored; };  // one thread at a time
  Options options;
  options.search = "sample";
  options.budget = 40;
  options.threads = 1;
  const CapabilityMap one = map(problem, plan, options);
  EXPECT_EQ(stored, 36);
  options.threads = 4;
  const CapabilityMap many = map(problem, plan, options);
  EXPECT_EQ(stored, 72);
  ASSERT_EQ(many.cells.size(), one.cells.size());
  for (std::size_t i = 0; i < one.cells.size(); ++i) {
    EXPECT_EQ(many.cells[i].status, one.cells[i].status);
    if (one.cells[i].status != Status::kBestFound) continue;
    EXPECT_EQ(many.cells[i].beta, one.cells[i].beta);
  }
}

}  // namespace
}  // namespace maxwrench
