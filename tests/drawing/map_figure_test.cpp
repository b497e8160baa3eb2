#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drawing/colour_scale.h"
#include "maxwrench/figures.h"
#include "maxwrench/load.h"
#include "maxwrench/map.h"
#include "tests/support/coded_tasks.h"

namespace maxwrench {
namespace {

using testing::HasSubstr;

/// A map of two values in each coordinate; the last place has no value.
CapabilityMap made_map(const std::vector<std::string>& names) {
  CapabilityMap made;
  made.task = std::make_shared<const Problem>(load_problem("planar/force"));
  made.unit = "N";
  for (const std::string& name : names) made.plan.over.push_back({name, 0, 1, 2});
  const int count = 1 << names.size();
  for (int i = 0; i < count; ++i) {
    MapCell cell;
    cell.at.resize(static_cast<Eigen::Index>(names.size()));
    for (std::size_t a = 0; a < names.size(); ++a) {
      cell.index.push_back(i >> a & 1);
      cell.at[static_cast<Eigen::Index>(a)] = static_cast<double>(i >> a & 1);
    }
    cell.conclude(i + 1 < count ? Status::kBestFound : Status::kNoneFound);
    cell.beta = i;
    made.cells.push_back(cell);
  }
  return made;
}

int number_of(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST(MapFigure, HasTheColourOfEachValue) {
  const std::string svg = map_figure(made_map({"x", "roll"}));
  EXPECT_THAT(svg, HasSubstr("x [m]"));
  EXPECT_THAT(svg, HasSubstr("roll [rad]"));
  EXPECT_THAT(svg, HasSubstr("[N]"));
  EXPECT_THAT(svg, HasSubstr("440154"));    // the least value
  EXPECT_THAT(svg, HasSubstr("fde725"));    // the largest one
  EXPECT_THAT(svg, HasSubstr("\"#ddd\""));  // none
}

TEST(MapFigure, DrawsCurvesRosesAndPoints) {
  EXPECT_THAT(map_figure(made_map({"pitch"})), HasSubstr("pitch [rad]"));
  EXPECT_THAT(map_figure(made_map({"azimuth"})), HasSubstr("over the azimuth of c"));
  const std::string points = map_figure(made_map({"x", "y", "z"}));
  EXPECT_THAT(points, HasSubstr("z [m]"));
  EXPECT_EQ(number_of(points, "<circle"), 7);
}

TEST(MapFigure, RejectsWhatItCannotDraw) {
  const auto rejected = [](const CapabilityMap& map) {
    return rejection_of([&] { map_figure(map); });
  };
  EXPECT_THAT(rejected(made_map({"x", "y", "z", "roll"})), HasSubstr("expected 1, 2 or 3"));
  CapabilityMap empty = made_map({"x"});
  empty.cells.front().conclude(Status::kNoneFound);
  EXPECT_THAT(rejected(empty), HasSubstr("without any value"));
}

/// The ends and the middle are those of viridis.
TEST(ColourScale, GoesFromBlueToYellow) {
  const ColourScale scale(1, 3);
  EXPECT_EQ(scale.text(1), "#440154");
  EXPECT_EQ(scale.text(2), "#21918c");
  EXPECT_EQ(scale.text(3), "#fde725");
  EXPECT_EQ(scale.text(9), "#fde725");
  EXPECT_EQ(ColourScale(2, 2).text(2), "#21918c");
  EXPECT_THROW(ColourScale(0, kInfinity), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
