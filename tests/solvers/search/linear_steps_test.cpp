#include "solvers/search/linear_steps.h"

#include <gtest/gtest.h>

#include <limits>

namespace maxwrench {
namespace {

TEST(TrustRegion, GrowsAfterAFullStepAsPredicted) {
  TrustRegion trust(0.1);
  EXPECT_TRUE(trust.judge(0.8, 1, 0.1));
  EXPECT_EQ(trust.radius(), 0.2);
  EXPECT_TRUE(trust.judge(0.8, 1, 0.1));  // the radius did not limit this step
  EXPECT_EQ(trust.radius(), 0.2);
  EXPECT_TRUE(trust.judge(0.5, 1, 0.2));  // a rise, but not as predicted
  EXPECT_EQ(trust.radius(), 0.2);
}

TEST(TrustRegion, ShrinksBelowTheStepThatDisappointed) {
  TrustRegion trust(1);
  EXPECT_TRUE(trust.judge(0.1, 1, 0.5));  // a tenth of the prediction is accepted
  EXPECT_EQ(trust.radius(), 0.2);
  EXPECT_FALSE(trust.judge(0.01, 1, 0.2));
  EXPECT_DOUBLE_EQ(trust.radius(), 0.08);
}

TEST(TrustRegion, AcceptsNoStepWithoutAValue) {
  for (const double risen : {-kInfinity, std::numeric_limits<double>::quiet_NaN()}) {
    TrustRegion trust(1);
    EXPECT_FALSE(trust.judge(risen, 1, 1));
    EXPECT_EQ(trust.radius(), 0.4);
  }
}

/// y_0 - 2 y_1 in [-1, 3], y_0 <= 100, which |y| <= 10 cannot reach, and y_1 >= 0.1, of which y = 0
/// is allowed to miss.
TEST(StepRows, LeaveOutWhatNoStepReaches) {
  Eigen::SparseMatrix<double> R(2, 2);
  R.insert(0, 0) = 1;
  R.insert(0, 1) = -2;
  R.insert(1, 0) = 1;
  const Eigen::Vector2d low(-1, -100), high(3, 100);
  for (const double radius : {10.0, kInfinity}) {
    StepRows rows;
    rows.add(1, 7);
    rows.end_row(-kInfinity, 7);
    rows.clear();
    rows.add(R, low, high, radius);
    rows.add(1, 1);
    rows.end_row(0.1, kInfinity);
    TrajectoryProgram program;
    rows.move_to(program, 2);
    if (radius < kInfinity) {
      EXPECT_EQ(program.r_min, Eigen::Vector2d(-1, 0));
      EXPECT_EQ(program.r_max, Eigen::Vector2d(3, kInfinity));
      EXPECT_EQ(program.R.toDense(), (Eigen::Matrix2d() << 1, -2, 0, 1).finished());
    } else {
      EXPECT_EQ(program.r_min, Eigen::Vector3d(-1, -100, 0));
      EXPECT_EQ(program.r_max, Eigen::Vector3d(3, 100, kInfinity));
      EXPECT_EQ(program.R.toDense(), (Eigen::MatrixXd(3, 2) << 1, -2, 1, 0, 0, 1).finished());
    }
  }
}

}  // namespace
}  // namespace maxwrench
