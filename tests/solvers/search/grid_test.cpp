#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "solvers/search/makers.h"
#include "tests/support/known.h"

namespace maxwrench {
namespace {

using Eigen::Vector2d;

TEST(GridTest, SixHundredSquared) {
  // 360,000 = 600^2 points at -1 + 2 i/599.
  std::atomic<long> on_lattice = 0;
  Known lattice(
      [&](const Eigen::VectorXd& x) {
        const Eigen::Array2d i = (x.array() + 1) * 599 / 2;
        if ((i - i.round()).abs().maxCoeff() < 1e-9) ++on_lattice;
        return -kInfinity;
      },
      Vector2d::Constant(-1), Vector2d::Constant(1));
  SearchOptions options;
  options.budget = 360100;
  options.threads = 2;
  EXPECT_EQ(make_grid()->maximize(lattice, options).evaluations, 360000);
  EXPECT_EQ(on_lattice, 360000);
}

TEST(GridTest, IgnoresTheSeed) {
  Known known([](const Eigen::VectorXd& x) { return std::cos(5 * x[0]) * std::cos(4 * x[1]); },
              Vector2d::Constant(-3), Vector2d::Constant(3));
  SearchOptions one, two;
  two.seed = 2;
  EXPECT_EQ(make_grid()->maximize(known, one).theta_r, make_grid()->maximize(known, two).theta_r);
}

}  // namespace
}  // namespace maxwrench
