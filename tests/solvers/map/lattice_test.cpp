#include "solvers/map/lattice.h"

#include <gtest/gtest.h>

#include <set>

namespace maxwrench {
namespace {

MapPlan plan_of(long rows, long columns, int refine, int shard = 1, int shards = 1) {
  MapPlan plan;
  plan.over = {{"x", -1, 2, rows}, {"z", 0, 1, columns}};
  plan.refine = refine;
  plan.shard = shard;
  plan.shards = shards;
  return plan;
}

std::set<Lattice::Index> places_of(const Lattice& lattice, int level) {
  std::set<Lattice::Index> places;
  for (const auto& cell : lattice.shard_cells(level)) {
    for (const auto& corner : lattice.corners(cell, level)) places.insert(corner);
  }
  return places;
}

/// The grid has all n m places in its level. Of 10 values, level 0 has those at 0, 4, 8 and 9, and
/// level 1 those at 2 and 6 beside them.
TEST(Lattice, LevelsFillTheGrid) {
  const Lattice lattice(plan_of(10, 7, 0));
  EXPECT_EQ(places_of(lattice, 0).size(), 4u * 3u);
  EXPECT_EQ(places_of(lattice, 1).size(), 6u * 4u);
  EXPECT_EQ(places_of(lattice, 2).size(), 10u * 7u);
  EXPECT_EQ(lattice.level_of({8, 0}), 0);
  EXPECT_EQ(lattice.level_of({9, 6}), 0);
  EXPECT_EQ(lattice.level_of({2, 4}), 1);
  EXPECT_EQ(lattice.level_of({2, 1}), 2);
  EXPECT_EQ(lattice.at({9, 6}), Eigen::Vector2d(2, 1));
  EXPECT_NEAR(lattice.at({3, 3})[0], 0, 1e-12);  // -1 + 3 (3/9)
  EXPECT_NEAR(lattice.at({3, 3})[1], 0.5, 1e-12);
}

TEST(Lattice, ParentsAreTheCornersOfAnEarlierLevel) {
  const Lattice lattice(plan_of(10, 7, 1));
  for (int level = 1; level <= lattice.grid_level(); ++level) {
    for (const auto& place : places_of(lattice, level)) {
      if (lattice.level_of(place) < level) continue;
      const auto parents = lattice.parents(place, level);
      EXPECT_GE(parents.size(), 2u);
      for (const auto& parent : parents) EXPECT_LT(lattice.level_of(parent), level);
    }
  }
}

/// A cell that is halved has 3 x 3 places, and 2 x 2 cells.
TEST(Lattice, HalvesCells) {
  const Lattice lattice(plan_of(5, 5, 2));  // steps of the grid: 4
  EXPECT_EQ(lattice.halved({4, 8}, 2).size(), 9u);
  EXPECT_EQ(lattice.children({4, 8}, 2).size(), 4u);
  EXPECT_EQ(lattice.halved({4, 8}, 2)[4], (Lattice::Index{6, 10}));
  EXPECT_EQ(lattice.level_of({6, 10}), 3);
}

/// The parts of a map have all of its places together, and each has the parents of its own.
TEST(Lattice, ShardsNeedNoOther) {
  for (const int shards : {1, 2, 3, 7, 9}) {
    std::set<Lattice::Index> all;
    for (int shard = 1; shard <= shards; ++shard) {
      const Lattice lattice(plan_of(13, 10, 0, shard, shards));
      std::set<Lattice::Index> before;
      for (int level = 0; level <= 2; ++level) {
        const auto here = places_of(lattice, level);
        for (const auto& place : here) {
          if (level == 0 || before.contains(place)) continue;
          for (const auto& parent : lattice.parents(place, level)) {
            EXPECT_TRUE(before.contains(parent));
          }
        }
        before = here;
      }
      all.insert(before.begin(), before.end());
    }
    EXPECT_EQ(all.size(), 13u * 10u) << shards;
  }
  // A part without a cell would find nothing.
  EXPECT_THROW(Lattice(plan_of(13, 10, 0, 1, 10)).shard_cells(0), std::invalid_argument);
}

/// A coordinate that counts wrenches is never between two of them.
TEST(Lattice, CountsAreWhole) {
  MapPlan plan;
  plan.over = {{"wrench", 1, 3, 3}, {"x", 0, 1, 5}};
  plan.refine = 3;
  const Lattice lattice(plan);
  for (int level = 0; level <= 2; ++level) {
    std::set<long> numbers;
    for (const auto& place : places_of(lattice, level)) numbers.insert(place[0]);
    EXPECT_EQ(numbers, (std::set<long>{0, 1, 2}));
  }
  EXPECT_EQ(lattice.halved({1, 8}, 2).size(), 3u);
}

TEST(Lattice, OneValueIsEnough) {
  const Lattice lattice(plan_of(1, 1, 2));
  EXPECT_EQ(places_of(lattice, 0).size(), 1u);
  EXPECT_EQ(places_of(lattice, 2).size(), 1u);
  EXPECT_EQ(lattice.at({0, 0})[0], -1);
}

}  // namespace
}  // namespace maxwrench
