#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "solvers/search/makers.h"
#include "tests/support/known.h"

namespace maxwrench {
namespace {

using Eigen::Vector2d;

/// Half of 4000 uniform points lie in each half of the bounds, within four standard deviations
/// (sqrt(4000)/2 = 32), and no two of them are the same.
TEST(SampleTest, IsUniform) {
  std::vector<double> seen;
  Known known(
      [&](const Eigen::VectorXd& x) {
        seen.push_back(x[0]);
        return x[0];
      },
      Vector2d::Constant(-1), Vector2d::Constant(3));
  SearchOptions options;
  options.budget = 4000;
  const SearchResult result = make_sample()->maximize(known, options);
  ASSERT_EQ(seen.size(), 4000U);
  EXPECT_NEAR(std::count_if(seen.begin(), seen.end(), [](double x) { return x > 1; }), 2000, 128);
  std::sort(seen.begin(), seen.end());
  EXPECT_EQ(std::unique(seen.begin(), seen.end()), seen.end());
  EXPECT_EQ(result.value, seen.back());
}

}  // namespace
}  // namespace maxwrench
