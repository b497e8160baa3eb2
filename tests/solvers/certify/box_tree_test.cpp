#include "solvers/certify/box_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "lib/math/random.h"

namespace maxwrench {
namespace {

constexpr int kCells = 7;

/// Cells of a grid of 7 in each of three directions, each with some chance.
std::vector<GoodBox> random_cells(Random& random, double chance) {
  std::vector<GoodBox> cells;
  for (int i = 0; i < kCells * kCells * kCells; ++i) {
    if (random.uniform(0, 1) > chance) continue;
    const Eigen::Vector3d lower(i % kCells, i / kCells % kCells, i / kCells / kCells);
    cells.push_back({lower, lower.array() + 1, 0, 0});
  }
  return cells;
}

/// Number of cells between neighbours is one at most, or all but one where a coordinate turns.
bool are_neighbours(const GoodBox& a, const GoodBox& b, const std::vector<char>& turns) {
  for (int i = 0; i < 3; ++i) {
    const double apart = std::abs(a.lower[i] - b.lower[i]);
    const bool around = turns[static_cast<std::size_t>(i)] != 0 && apart == kCells - 1;
    if (apart > 1 && !around) return false;
  }
  return true;
}

/// By spreading the smallest number until nothing changes.
std::vector<int> flooded(const std::vector<GoodBox>& cells, const std::vector<char>& turns) {
  std::vector<int> label(cells.size());
  std::iota(label.begin(), label.end(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t a = 0; a < cells.size(); ++a) {
      for (std::size_t b = 0; b < cells.size(); ++b) {
        if (label[b] >= label[a] || !are_neighbours(cells[a], cells[b], turns)) continue;
        label[a] = label[b];
        changed = true;
      }
    }
  }
  return label;
}

TEST(BoxTree, FindsWhatHangsTogether) {
  Random random(3);
  for (const std::vector<char>& turns : {std::vector<char>{0, 0, 0}, {1, 0, 1}}) {
    for (const double chance : {0.02, 0.05, 0.1, 0.5}) {
      const std::vector<GoodBox> cells = random_cells(random, chance);
      const std::vector<int> expected = flooded(cells, turns);
      const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
      const std::vector<int> numbers = BoxTree(cells, zero, zero.array() + kCells, turns).connect();
      ASSERT_EQ(numbers.size(), cells.size());
      for (std::size_t a = 0; a < cells.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
          EXPECT_EQ(numbers[a] == numbers[b], expected[a] == expected[b]);
        }
      }
    }
  }
}

/// A large box beside small ones, by a corner.
TEST(BoxTree, ConnectsBoxesOfAnySize) {
  const auto box = [](double x, double y, double side) {
    const Eigen::Vector2d lower(x, y);
    return GoodBox{lower, lower.array() + side, 0, 0};
  };
  const std::vector<GoodBox> boxes = {box(0, 0, 4), box(4, 4, 1), box(6, 0, 1), box(5, 3, 1)};
  const Eigen::Vector2d zero(0, 0), ten(10, 10);
  EXPECT_EQ(BoxTree(boxes, zero, ten, {}).connect(), (std::vector<int>{0, 0, 1, 0}));
}

TEST(BoxTree, FindsTheBoxOfAPoint) {
  Random random(5);
  const std::vector<GoodBox> cells = random_cells(random, 0.3);
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  const BoxTree tree(cells, zero, zero.array() + kCells, {});
  for (int sample = 0; sample < 1000; ++sample) {
    Eigen::VectorXd x(3);
    for (double& value : x) value = random.uniform(0, kCells);
    int expected = -1;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if ((x.array().floor() == cells[i].lower.array()).all()) expected = static_cast<int>(i);
    }
    EXPECT_EQ(tree.find(x), expected);
  }
  EXPECT_EQ(BoxTree({}, zero, zero, {}).find(zero), -1);
}

}  // namespace
}  // namespace maxwrench
