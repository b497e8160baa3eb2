#include <gtest/gtest.h>

#include <Eigen/Core>

#include "maxwrench/types.h"
#include "solvers/solve/format.h"

namespace maxwrench {
namespace {

TEST(Decimals, WhatRoundsToZeroHasNoSign) {
  for (const double zero : {0.0, -0.0, 1e-9, -1e-9, -4.9e-6, -1e-320}) {
    EXPECT_EQ(decimals(zero), "0.00000") << zero;
  }
}

TEST(Decimals, OtherNumbersKeepTheirSign) {
  EXPECT_EQ(decimals(-5.1e-6), "-0.00001");
  EXPECT_EQ(decimals(-0.5), "-0.50000");
  EXPECT_EQ(decimals(-10), "-10.00000");
  EXPECT_EQ(decimals(1234.567891), "1234.56789");
  EXPECT_EQ(decimals(kInfinity), "inf");
  EXPECT_EQ(decimals(-kInfinity), "-inf");
}

TEST(Decimals, ColumnsAreThoseOfTheNumbers) {
  EXPECT_EQ(line(Eigen::Vector3d(-1e-7, -1, 2000)), "   0.00000  -1.00000 2000.00000");
}

}  // namespace
}  // namespace maxwrench
