#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drawing/axes.h"
#include "maxwrench/figures.h"
#include "maxwrench/margin.h"

namespace maxwrench {
namespace {

using testing::HasSubstr;

MotionMargin margins(const std::vector<double>& values) {
  MotionMargin margin;
  margin.problem = "a task";
  margin.set = "any direction of fx, axes of the world";
  margin.unit = "N";
  for (std::size_t i = 0; i < values.size(); ++i) {
    margin.instants.emplace_back();
    margin.instants.back().t = static_cast<double>(i);
    margin.instants.back().margin = values[i];
  }
  margin.worst = 1;
  return margin;
}

TEST(MarginFigure, MarksTheLeastMargin) {
  const std::string svg = margin_figure(margins({3, 1, 2}));
  EXPECT_THAT(svg, HasSubstr("a task"));
  EXPECT_THAT(svg, HasSubstr("any direction of fx"));
  EXPECT_THAT(svg, HasSubstr("<polyline"));
  EXPECT_THAT(svg, HasSubstr("#D55E00"));
}

/// A margin of minus infinity divides the curve; the dot is on finite margins only.
TEST(MarginFigure, HasGapsWhereNothingHelps) {
  MotionMargin margin = margins({3, -kInfinity, 2, -1, 2});
  const std::string svg = margin_figure(margin);
  EXPECT_THAT(svg, HasSubstr("#888888"));
  EXPECT_THAT(svg, testing::Not(HasSubstr("#D55E00")));
  EXPECT_THAT(svg, testing::Not(HasSubstr("nan")));
  EXPECT_THAT(svg, testing::Not(HasSubstr("inf")));
}

TEST(MarginFigure, NeedsACurve) {
  EXPECT_THROW(margin_figure(margins({-kInfinity, -kInfinity})), std::invalid_argument);
  EXPECT_THROW(margin_figure(margins({3})), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
