#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "maxwrench/figures.h"
#include "maxwrench/pareto.h"
#include "tests/support/coded_tasks.h"

namespace maxwrench {
namespace {

using testing::HasSubstr;

/// A front of three postures of values (4, 1), (3, 2), (1, 3).
Front made_front(double bound) {
  Front made;
  made.own.resize(2);
  made.own[0].choice.problem = "push";
  made.own[1].choice.problem = "lift";
  made.own[0].unit = made.own[1].unit = "N";
  for (const auto& [a, b] : {std::pair(4.0, 1.0), {3.0, 2.0}, {1.0, 3.0}}) {
    FrontPoint point;
    point.beta = point.weights = Eigen::Vector2d(a, b);
    point.bound = bound;
    made.points.push_back(point);
  }
  return made;
}

TEST(FrontFigure, NamesTasksAndProofs) {
  const std::string found = front_figure(made_front(kInfinity)),
                    proven = front_figure(made_front(1.1));
  EXPECT_THAT(found, HasSubstr("lift beta [N]"));
  EXPECT_THAT(found, testing::Not(HasSubstr("proven limit")));
  EXPECT_THAT(proven, HasSubstr("proven limit"));
}

/// At an end of the front the other task may have no value.
TEST(FrontFigure, LeavesOutWhatHasNoValue) {
  Front made = made_front(1.1);
  made.points.back().beta[0] = std::nan("");
  EXPECT_THAT(front_figure(made), HasSubstr("push beta [N]"));
  made.points.clear();
  EXPECT_THAT(rejection_of([&] { front_figure(made); }), HasSubstr("no front"));
}

}  // namespace
}  // namespace maxwrench
