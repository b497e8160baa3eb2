#include "solvers/wrench/padded.h"

#include <gtest/gtest.h>

#include "maxwrench/types.h"

namespace maxwrench {
namespace {

TEST(PaddedTest, HoldsTheCount) {
  EXPECT_EQ(padded(1), 2);
  EXPECT_EQ(padded(2), 2);
  EXPECT_EQ(padded(3), 4);
  EXPECT_EQ(padded(4), 4);
  EXPECT_EQ(padded(5), 8);
  EXPECT_EQ(padded(9), 12);
}

TEST(PaddedTest, SumsWholeRows) {
  for (int count = 1; count <= 20; ++count) {
    const int length = padded(count);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(length);
    Eigen::VectorXd y = Eigen::VectorXd::Zero(length);
    x.head(count).setLinSpaced(count, -0.7, 1.9);
    y.head(count).setLinSpaced(count, 2.3, 0.4);
    const Eigen::VectorXd sum = x + 0.3 * y;
    int calls = 0;
    with_length(length, [&](auto n) {
      ++calls;
      EXPECT_EQ(static_cast<int>(n), length);
      EXPECT_EQ(length % kLanes<decltype(n)>, 0);
      EXPECT_NEAR(dot(x.data(), y.data(), n), x.dot(y), 1e-14 * (1 + x.norm() * y.norm()));
      add_multiple(x.data(), 0.3, y.data(), n);
    });
    EXPECT_EQ(calls, 1);
    EXPECT_LE((x - sum).norm(), 1e-15 * sum.norm()) << count;
  }
}

}  // namespace
}  // namespace maxwrench
