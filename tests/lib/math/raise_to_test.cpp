#include "lib/math/raise_to.h"

#include <gtest/gtest.h>

#include <limits>

namespace maxwrench {
namespace {

TEST(RaiseTo, NanIsTheWorst) {
  double worst = 1;
  raise_to(worst, 0.5);
  EXPECT_EQ(worst, 1);
  raise_to(worst, 2);
  EXPECT_EQ(worst, 2);
  raise_to(worst, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(worst, kInfinity);
  raise_to(worst, 3);
  EXPECT_EQ(worst, kInfinity);
}

}  // namespace
}  // namespace maxwrench
