#include <gtest/gtest.h>

#include <stdexcept>

#include "solvers/search/makers.h"
#include "tests/support/known.h"

namespace maxwrench {
namespace {

using Eigen::Vector2d;

TEST(AnnealingTest, SeedsDifferAndRepeat) {
  const Vector2d best(0.3, -0.5);
  Known known([&](const Eigen::VectorXd& x) { return -(x - best).squaredNorm(); },
              Vector2d::Constant(-2), Vector2d::Constant(2));
  SearchOptions options;
  options.budget = 100;
  const SearchResult one = make_annealing()->maximize(known, options);
  EXPECT_EQ(one.theta_r, make_annealing()->maximize(known, options).theta_r);
  options.seed = 2;
  EXPECT_NE(one.theta_r, make_annealing()->maximize(known, options).theta_r);
}

TEST(AnnealingTest, EvaluatesTheStartFirst) {
  // A needle that no sample would hit.
  const Eigen::Vector2d needle(0.123, 0.456);
  Known known([&](const Eigen::VectorXd& x) { return x == needle ? 1.0 : 0.0; },
              Vector2d::Constant(-2), Vector2d::Constant(2));
  SearchOptions options;
  options.budget = 1;
  EXPECT_EQ(make_annealing()->maximize(known, options).theta_r, Vector2d::Constant(0));
  options.start = needle;
  EXPECT_EQ(make_annealing()->maximize(known, options).theta_r, needle);
  options.start = Vector2d::Constant(9);  // outside: moved to the bounds
  EXPECT_EQ(make_annealing()->maximize(known, options).theta_r, Vector2d::Constant(2));
  options.start = Eigen::Vector3d::Constant(0);
  EXPECT_THROW(make_annealing()->maximize(known, options), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
