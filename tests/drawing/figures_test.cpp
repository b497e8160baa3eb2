#include "maxwrench/figures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <set>
#include <sstream>
#include <tuple>

#include "drawing/axes.h"
#include "drawing/bars.h"
#include "drawing/convergence.h"
#include "drawing/ecdf.h"
#include "drawing/legend.h"
#include "drawing/postures.h"
#include "drawing/scatter.h"
#include "maxwrench/load.h"

namespace maxwrench {
namespace {

int count(const std::string& text, const std::string& word) {
  int found = 0;
  for (std::size_t i = text.find(word); i != std::string::npos; i = text.find(word, i + 1)) ++found;
  return found;
}

/// Values of an attribute that is a number.
std::vector<double> numbers(const std::string& svg, const std::string& attribute) {
  const std::regex pattern(" " + attribute + "=\"([-0-9.]+)\"");
  std::vector<double> values;
  for (std::sregex_iterator i(svg.begin(), svg.end(), pattern), end; i != end; ++i) {
    values.push_back(std::stod((*i)[1]));
  }
  return values;
}

/// In a column of 8 cm (72 pt are an inch) words are 6 pt high or more; lowered letters, which are
/// four fifths of that, 4.8 pt. Those along the left edge are whole: their middle is 8 px inside.
void expect_legible(const std::string& svg) {
  const double pt = 8 / 2.54 * 72 / numbers(svg, "width").front();
  std::istringstream lines(svg);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("<text")) continue;
    if (line.find("rotate(-90") != std::string::npos) {
      EXPECT_GE(numbers(line, "x").front(), 8);
    }
    const std::vector<double> sizes = numbers(line, "font-size");
    for (std::size_t i = 0; i < sizes.size(); ++i) EXPECT_GE(pt * sizes[i], i == 0 ? 6 : 4.8);
  }
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

/// A run whose reading along c is what `reading` says.
TankRun made_run(const Problem& problem, const std::vector<double>& readings) {
  TankRun run;
  run.status = Status::kOptimal;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    TankSample sample;
    sample.t = 0.01 * static_cast<double>(i + 1);
    sample.planned = 1;
    sample.reading = readings[i];
    sample.h_e = readings[i] * problem.c;
    run.samples.push_back(sample);
  }
  return run;
}

class FiguresTest : public testing::Test {
 protected:
  std::string tank(const std::vector<double>& readings) const {
    const TankRun run = made_run(problem_, readings);
    return tank_figure(problem_, {{"beta_1", &run}, {"direct_l", &run}});
  }
  const Problem problem_ = load_problem("planar/force");
};

TEST_F(FiguresTest, TankCurvesThatCannotBeDrawnAreRejected) {
  const double huge = 1e308;
  EXPECT_THROW(tank({}), std::invalid_argument);
  EXPECT_THROW(tank({1, std::nan("")}), std::invalid_argument);
  EXPECT_THROW(tank({kInfinity, 1}), std::invalid_argument);
  EXPECT_THROW(tank({huge, -huge}), std::invalid_argument);
  for (const double size : {1e-300, 1e-9, 1.0, 1e9, 1e90}) {
    const std::string svg = tank({0, size, -size});
    EXPECT_LT(svg.size(), 20000U);
    expect_legible(svg);
  }
}

/// The letter, not its name; and the name of a search is one word in a legend.
TEST_F(FiguresTest, NamesAreSpelledInOneWay) {
  const std::string svg = tank({0, 1});
  EXPECT_NE(svg.find(">\u03b2<tspan"), std::string::npos);
  EXPECT_NE(svg.find(">direct_l: "), std::string::npos);
  const ConvergenceCurve curve{"direct_l", [](double) { return 0.1; }};
  const ConvergencePanel panel{"uvms/valve", 1e5, {curve}};
  EXPECT_NE(draw_convergence({&panel, 1}, {"direct_l"}).find(">direct_l<"), std::string::npos);
}

/// Curves without a finite value are not drawn, wild budgets are cut; the named ones are in the
/// legend, no two look the same in grey (dash or mark differ), and all others are one entry.
TEST_F(FiguresTest, ConvergenceOfTwelveSearches) {
  ConvergencePanel panel{"p", 1e5, {}};
  std::vector<std::string> named;
  for (int i = 0; i < 12; ++i) {
    panel.curves.push_back({std::string(1, static_cast<char>('a' + i)),
                            [](double n) { return n < 100 ? std::nan("") : 1 / n; }});
    if (i < 8) named.push_back(panel.curves.back().name);
  }
  const std::string svg = draw_convergence({&panel, 1}, named);
  expect_legible(svg);
  for (int i = 0; i < 12; ++i) {
    EXPECT_EQ(count(svg, std::string(">") + static_cast<char>('a' + i) + "<"), i < 8 ? 1 : 0);
  }
  EXPECT_EQ(count(svg, ">all others<"), 1);
  std::set<std::tuple<std::string, Mark, bool>> looks;
  for (std::size_t i = 0; i < 12; ++i) {
    const CurveStyle style = curve_style(i);
    looks.insert({style.dash, style.mark, style.open});
  }
  EXPECT_EQ(looks.size(), 12U);
  panel.budget = kInfinity;
  EXPECT_LT(draw_convergence({&panel, 1}, named).size(), 200000U);
}

/// Two searches in two panels side by side, one of them named; a search that reached nothing is not
/// drawn, and a first hit that took no time stands at the left end.
TEST_F(FiguresTest, EcdfNamesAFew) {
  const EcdfCurve a{"a", {{10, 0.25}, {200, 1}}}, b{"b", {{0, 0.5}, {3e4, 0.75}}}, none{"none", {}};
  const EcdfPanel panels[] = {{"p", "evaluations", {a, b, none}}, {"p", "ms", {b, a}}};
  const std::string svg = draw_ecdf(panels, {"a"}, 2);
  expect_legible(svg);
  EXPECT_EQ(count(svg, ">a<"), 1);
  EXPECT_EQ(count(svg, ">b<"), 0);
  EXPECT_EQ(count(svg, ">all others<"), 1);
  EXPECT_EQ(count(svg, "<polyline"), 4);
  const std::string all_named = draw_ecdf({panels, 1}, {"a", "b", "none"}, 1);
  EXPECT_EQ(count(all_named, ">all others<"), 0);
  EXPECT_EQ(count(all_named, ">none<"), 0) << "what is not drawn has no line in the legend";
  const EcdfPanel wild{"p", "ms", {{"a", {{kInfinity, 1}}}}};
  EXPECT_THROW(draw_ecdf({&wild, 1}, {}, 1), std::invalid_argument);
}

/// A mark for each point that stands on a logarithmic axis, and one in the legend for each set.
TEST_F(FiguresTest, ScatterLeavesOutWhatHasNoLogarithm) {
  ScatterPanel panel{
      "coordinates", "us", {{"ours", {{1, 2}, {10, 300}, {0, 5}}}, {"peer", {{2, 9}}}}};
  const std::string svg = draw_scatter(panel);
  EXPECT_EQ(count(svg, "<circle"), 2 + 1);  // the first style's mark
  EXPECT_NE(svg.find(">coordinates</text>"), std::string::npos);
  EXPECT_NE(svg.find(">peer</text>"), std::string::npos);
  panel.sets = {{"none", {{0, 0}}}};
  EXPECT_THROW(draw_scatter(panel), std::invalid_argument);
}

TEST_F(FiguresTest, BarsThatCannotBeDrawnAreRejected) {
  const auto bars = [](double value) {
    return draw_bars("t", {{"N", {{"a", 1, {value}}, {"b", 2, {}}}}, {"N m", {}}}, "tank");
  };
  EXPECT_THROW(bars(std::nan("")), std::invalid_argument);
  EXPECT_THROW(bars(kInfinity), std::invalid_argument);
  expect_legible(bars(-1e3));
}

TEST_F(FiguresTest, AxesHaveFewTicksAndRejectWhatHasNone) {
  for (const double size : {1e-90, 0.3, 7.0, 1e90}) {
    for (const double low : {-size, 0.0, 0.999 * size}) {
      const Axis axis = make_axis(low, size, 0, 1, "x");
      const auto ticks = round_ticks(axis, 4);
      EXPECT_GE(ticks.size(), 4U);
      EXPECT_LE(ticks.size(), 12U);  // a step is at least two fifths of a quarter
      for (const Tick& tick : ticks) {
        EXPECT_GT(axis(tick.value), -1e-6);
        EXPECT_LT(axis(tick.value), 1 + 1e-6);
      }
    }
  }
  EXPECT_THROW(make_axis(0, kInfinity, 0, 1, "x"), std::invalid_argument);
  EXPECT_THROW(make_axis(std::nan(""), 1, 0, 1, "x"), std::invalid_argument);
  EXPECT_THROW(make_axis(1, 1, 0, 1, "x"), std::invalid_argument);
  EXPECT_THROW(make_axis(1e15, 1e15 + 1, 0, 1, "x"), std::invalid_argument);
}

TEST_F(FiguresTest, PosturesAreLegibleAndExist) {
  expect_legible(figure(problem_, {{"optimum of beta_1", problem_.theta_r_default}}));
  expect_legible(posture_figure(problem_, {{"a", problem_.theta_r_default},
                                           {"b", problem_.theta_r_default},
                                           {"c", problem_.theta_r_default}}));
  const Eigen::VectorXd beyond = problem_.theta_r_max.array() + 1;
  EXPECT_THROW(figure(problem_, {{"a", beyond}}), std::invalid_argument);
  EXPECT_THROW(posture_figure(problem_, {}), std::invalid_argument);
}

/// Every mark of the picture is named below it, and those of the legend differ from joints.
TEST_F(FiguresTest, LegendsNameEveryMark) {
  const std::string svg = figure(problem_, {{"a", problem_.theta_r_default}});
  for (const char* name : {"base", "link", "joint", "thruster", "end effector", "c (force)",
                           "force that attains \u03b2"}) {
    EXPECT_EQ(count(svg, std::string(">") + name + "<"), 1) << name;
  }
  // Open circles: joints, and the one in the legend.
  EXPECT_EQ(count(svg, "r=\"3.20\" fill=\"#ffffff\""),
            static_cast<int>(problem_.robot.joints.size()) + 1);
}

/// Every curve is named: those of each run where they share a plot, those of both once where each
/// run has its own. The limits of the thrusters are lines in each of their plots and the legend.
TEST(MotionFigure, ComparesRuns) {
  const Problem problem = load_problem("planar/trajectory");
  std::vector<TankRun> runs = {made_run(problem, {1, 2, 3}), made_run(problem, {2, 2, 4})};
  const Eigen::Index actuators = problem.robot.actuation.B.cols();
  for (TankRun& run : runs) {
    for (TankSample& sample : run.samples) {
      sample.u.setConstant(actuators, 0.5);
      sample.theta_r.setZero(problem.redundancy());
    }
  }
  const std::string svg = motion_figure(problem, {{"fixed", &runs[0]}, {"best", &runs[1]}});
  expect_legible(svg);
  std::vector<std::string> names = {"limits", "time [s]"};
  for (const char* curve : {"reading, ", "planned, ", "end effector, "}) {
    for (const char* run : {"fixed", "best"}) names.push_back(std::string(curve) + run);
  }
  for (const Thruster& thruster : problem.robot.thrusters) names.push_back(thruster.name);
  for (int i = 0; i < problem.redundancy(); ++i) names.push_back(problem.theta_r_name(i));
  for (const std::string& name : names) EXPECT_EQ(count(svg, ">" + name + "<"), 1) << name;
  for (const char* title : {"fixed", "best"}) {
    EXPECT_EQ(count(svg, ">" + std::string(title) + "<"), 2) << title;
  }
  // -1 and 1 N of all thrusters, in two plots and the legend.
  EXPECT_EQ(count(svg, "stroke-dasharray=\"1 3\""), 2 * 2 + 1);
  runs[1].samples.clear();
  EXPECT_THROW(motion_figure(problem, {{"fixed", &runs[0]}, {"best", &runs[1]}}),
               std::invalid_argument);
}

/// Without solids a robot is its skeleton: a line from the base to the first joint, between joints
/// and to the end effector, all inside the plot. A link with a solid needs no line.
TEST_F(FiguresTest, LinksWithoutSolidsAreLines) {
  Problem problem = load_problem("fixed/push");
  problem.robot.collision = nullptr;  // its links touch nothing without solids
  const auto links = [&] {
    const std::string svg = posture_figure(problem, {{"a", problem.theta_r_default}});
    const std::vector<double> places = numbers(svg, "cx");
    for (const double x : places) EXPECT_TRUE(x > 0 && x < 400) << x;
    return count(svg, "stroke-width=\"5.50\"");
  };
  const int joints = static_cast<int>(problem.robot.joints.size());
  EXPECT_EQ(links(), 0);  // all have solids
  const std::vector<ConvexBody> convex_bodies = problem.robot.convex_bodies;
  problem.robot.convex_bodies.clear();
  EXPECT_EQ(links(), 2 * (joints + 1) + 1);  // two views and the legend
  for (const ConvexBody& solid : convex_bodies) {
    if (solid.link != 2) problem.robot.convex_bodies.push_back(solid);
  }
  EXPECT_EQ(links(), 2);  // the legend's mark of a link is that of a solid
}

}  // namespace
}  // namespace maxwrench
