#include "drawing/labels.h"

#include <gtest/gtest.h>

#include "lib/math/random.h"

namespace maxwrench {
namespace {

using Box = Eigen::AlignedBox2d;
using Point = Eigen::Vector2d;

double free_everywhere(const Box&) { return 0; }

/// Thirty labels at random places of a small picture, some of them at one place.
TEST(Labels, DoNotOverlap) {
  Random random(3);
  const Box bounds(Point(10, 20), Point(400, 320));
  for (int round = 0; round < 20; ++round) {
    std::vector<Label> labels;
    for (int i = 0; i < 30; ++i) {
      Label label;
      label.lines = {"front right", "vertical 40 N"};
      label.at =
          i % 3 == 0 ? Point(200, 150) : Point(random.uniform(10, 400), random.uniform(20, 320));
      label.bold = i % 2 == 0;
      labels.push_back(label);
    }
    const std::vector<PlacedLabel> placed = place_labels(labels, bounds, free_everywhere);
    EXPECT_GT(placed.size(), 15U);
    for (std::size_t i = 0; i < placed.size(); ++i) {
      EXPECT_TRUE(bounds.contains(placed[i].box));
      // "vertical 40 N" has 13 letters, each 0.57 of the size wide (`text_width`).
      EXPECT_GE(placed[i].box.sizes().x(), 13 * 0.57 * kFontSize - 1e-9);
      EXPECT_GE(placed[i].box.sizes().y(), 2 * kFontSize);
      for (std::size_t k = 0; k < i; ++k) {
        EXPECT_TRUE(placed[i].box.intersection(placed[k].box).isEmpty()) << i << " " << k;
      }
    }
  }
}

TEST(Labels, AreBesideTheirPlaceOnFreeGround) {
  const Box bounds(Point(0, 0), Point(300, 300)), robot(Point(100, 100), Point(200, 200));
  const auto covered = [&](const Box& box) {
    const Box common = box.intersection(robot);
    return common.isEmpty() ? 0 : common.volume() / box.volume();
  };
  const Label label{{"T1"}, {150, 195}, "#000000"};
  const std::vector<PlacedLabel> placed = place_labels({label}, bounds, covered);
  ASSERT_EQ(placed.size(), 1U);
  const Box common = placed[0].box.intersection(robot);
  EXPECT_TRUE(common.isEmpty() || common.volume() < 1e-9);
  EXPECT_LT(placed[0].box.exteriorDistance(label.at), 20);
}

TEST(Labels, WithoutAPlaceAreLeftOut) {
  const Label label{{"a label that is longer than the picture is wide"}, {5, 5}, "#000000"};
  EXPECT_TRUE(place_labels({label}, Box(Point(0, 0), Point(50, 50)), free_everywhere).empty());
}

}  // namespace
}  // namespace maxwrench
