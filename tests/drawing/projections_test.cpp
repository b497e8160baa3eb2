#include "drawing/projections.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

namespace maxwrench {
namespace {

int occurrences(const std::string& text, const std::string& word) {
  int found = 0;
  for (std::size_t i = text.find(word); i != std::string::npos; i = text.find(word, i + 1)) ++found;
  return found;
}

std::vector<BoxAxis> axes(int d) {
  std::vector<BoxAxis> all;
  for (int i = 0; i < d; ++i) all.push_back({"joint_" + std::to_string(i + 1), "rad", -3, 3});
  return all;
}

BoxGroup group(const char* name, int d) {
  BoxGroup boxes;
  boxes.name = name;
  const Eigen::VectorXd one = Eigen::VectorXd::Constant(d, 0.1);
  boxes.lower = {one, 2 * one, 5 * one};
  boxes.upper = {2 * one, 3 * one, 6 * one};
  return boxes;
}

/// How much is filled, of the fillings between the first frame and the end.
double area_of(const std::string& svg, const std::string& fill) {
  const std::regex pattern(
      R"re(points="([-0-9.]+),([-0-9.]+) ([-0-9.]+),[-0-9.]+ [-0-9.]+,([-0-9.]+)[^"]*" fill="(#[0-9A-Fa-f]+)")re");
  double sum = 0;
  for (std::sregex_iterator i(svg.begin(), svg.end(), pattern), end; i != end; ++i) {
    if ((*i)[5] != fill) continue;
    sum += std::abs((std::stod((*i)[3]) - std::stod((*i)[1])) *
                    (std::stod((*i)[4]) - std::stod((*i)[2])));
  }
  return sum;
}

TEST(Projections, HaveAPanelForEachPair) {
  for (const int d : {1, 2, 3, 4, 6}) {
    BoxGroup boxes = group("one", d);
    boxes.mark = boxes.lower.front();
    const std::string svg = draw_projections("of \"all\"", axes(d), {boxes});
    const int panels = std::max(d * (d - 1) / 2, 1);
    EXPECT_EQ(occurrences(svg, "fill=\"none\" stroke=\"#8a8a8a\""), panels) << d;
    EXPECT_NE(svg.find("joint_1"), std::string::npos);
    EXPECT_NE(svg.find("joint_" + std::to_string(d)), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    // Six panels side by side have no room for "joint_1 [rad]".
    EXPECT_NE(svg.find(d == 6 ? ">in rad<" : "joint_1 [rad]"), std::string::npos);
  }
}

/// Boxes whose projections coincide or overlap are drawn once: as a square of 2×2 of a large box, a
/// small one in it and a copy of that behind.
TEST(Projections, AreUnions) {
  BoxGroup one, more;
  one.name = more.name = "some";
  one.lower = {Eigen::Vector3d(0, 0, 0)};
  one.upper = {Eigen::Vector3d(2, 2, 2)};
  more = one;
  more.lower.insert(more.lower.end(), {Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(1, 0.5, 1)});
  more.upper.insert(more.upper.end(), {Eigen::Vector3d(2, 2, 1), Eigen::Vector3d(2, 1.5, 2)});
  const std::string colour = "#C77F00";
  const double area = area_of(draw_projections("", axes(3), {one}), colour);
  EXPECT_GT(area, 1000);
  EXPECT_NEAR(area_of(draw_projections("", axes(3), {more}), colour), area, 1e-3 * area);
}

TEST(Projections, NameWhatIsGrey) {
  BoxGroup others = group("others", 2), may = group("may", 2);
  others.grey = may.grey = true;
  const std::string svg = draw_projections("", axes(2), {group("first", 2), others, may});
  for (const char* text : {">first<", ">others<", ">may<", "#9a9a9a", "#d4d4d4"}) {
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  }
}

TEST(Projections, ShowJointsThatRest) {
  BoxGroup boxes = group("one", 2);
  for (auto* ends : {&boxes.lower, &boxes.upper}) {
    for (Eigen::VectorXd& end : *ends) end[1] = 3;
  }
  std::vector<BoxAxis> resting = axes(2);
  resting[1].lower = 3;
  EXPECT_EQ(draw_projections("", resting, {boxes}).find("nan"), std::string::npos);
}

TEST(Projections, NeedBoxes) {
  EXPECT_THROW(draw_projections("", axes(2), {}), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
