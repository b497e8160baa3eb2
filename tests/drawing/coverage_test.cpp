#include "drawing/coverage.h"

#include <gtest/gtest.h>

namespace maxwrench {
namespace {

Face tile(double low, double high, double depth, Rgb colour) {
  return {{{low, low, depth}, {high, low, depth}, {high, high, depth}, {low, high, depth}}, colour};
}

std::vector<Rgb> colours(const std::vector<Face>& faces) {
  std::vector<Rgb> result;
  for (const Face& face : faces) result.push_back(face.colour);
  return result;
}

TEST(Coverage, LeavesOutWhatIsHidden) {
  Face glass = tile(0, 4, 3, 4);
  glass.opacity = 0.5;
  // Behind the wall: one is hidden, one sticks out. Glass hides nothing.
  const VisibleFaces faces =
      visible_faces({tile(1, 2, 0, 1), tile(2, 5, 1, 2), tile(0, 4, 2, 3), glass}, 0.1);
  EXPECT_EQ(colours(faces.seen), (std::vector<Rgb>{2, 3, 4}));
  EXPECT_TRUE(faces.hidden.empty());
  EXPECT_TRUE(visible_faces({}, 0.1).seen.empty());
}

/// What shines through is drawn faintly behind a wall, but not behind another mark.
TEST(Coverage, FindsWhatShinesThrough) {
  Face behind_wall = tile(1, 2, 0, 1), behind_mark = tile(6, 7, 0, 2), mark = tile(5, 8, 1, 3);
  behind_wall.shines_through = behind_mark.shines_through = mark.shines_through = true;
  behind_wall.lines = {true, true, true, true};
  const VisibleFaces faces = visible_faces({behind_wall, behind_mark, mark, tile(0, 4, 2, 4)}, 0.1);
  EXPECT_EQ(colours(faces.seen), (std::vector<Rgb>{3, 4}));
  EXPECT_EQ(colours(faces.hidden), std::vector<Rgb>{1});
  EXPECT_TRUE(faces.hidden[0].lines.empty());
}

/// A square of side 2 covers a quarter of one of side 4; the grid's step is 1/50 of that.
TEST(Coverage, ShareOfABox) {
  using Box = Eigen::AlignedBox2d;
  Coverage coverage(Box(Eigen::Vector2d(0, 0), Eigen::Vector2d(10, 10)), 0.08);
  coverage.cover({{1, 1}, {3, 1}, {3, 3}, {1, 3}});
  EXPECT_NEAR(coverage.share(Box(Eigen::Vector2d(1, 1), Eigen::Vector2d(5, 5))), 0.25, 0.02);
  EXPECT_EQ(coverage.share(Box(Eigen::Vector2d(5, 5), Eigen::Vector2d(9, 9))), 0);
  EXPECT_EQ(coverage.share(Box(Eigen::Vector2d(1.2, 1.2), Eigen::Vector2d(2.8, 2.8))), 1);
  EXPECT_EQ(coverage.share(Box(Eigen::Vector2d(-9, -9), Eigen::Vector2d(-1, -1))), 0);
}

}  // namespace
}  // namespace maxwrench
