#include "solvers/certify/good_postures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/good_postures.h"
#include "tests/support/multimodal.h"
#include "tests/support/refusals.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

constexpr double kHalfTurn = std::numbers::pi;

/// In [-pi, pi]^d.
Multimodal multimodal_at(const std::vector<Eigen::VectorXd>& peaks) {
  const Eigen::Index d = peaks.front().size();
  return {Eigen::VectorXd::Constant(d, -kHalfTurn), Eigen::VectorXd::Constant(d, kHalfTurn), peaks};
}

GoodPostures list(const Multimodal& multimodal, const GoodOptions& options) {
  MultimodalObjective objective(multimodal);
  return find_good_postures(objective, MultimodalBound(multimodal),
                            {multimodal.peaks.front(), multimodal.top}, multimodal.top, options);
}

/// Within 10 % of the top, 1, are squares of half side 0.1 around the peaks.
TEST(GoodPostures, AreApartOrHangTogether) {
  GoodOptions options;
  options.within = 0.1;
  const Eigen::Vector2d one(0.5, 0.7), near(0.69, 0.89), far(-1, 0.7);
  const Multimodal multimodal = multimodal_at({one, near, far});
  MultimodalObjective objective(multimodal);
  const GoodPostures good = list(multimodal, options);
  EXPECT_EQ(good.status, Status::kProven);
  EXPECT_DOUBLE_EQ(good.least, 0.9);
  expect_sound(objective, good, options);
  ASSERT_EQ(good.clusters.size(), 2U);
  EXPECT_EQ(cluster_at(good, one), cluster_at(good, near));
  EXPECT_NE(cluster_at(good, one), cluster_at(good, far));
  for (const Cluster& cluster : good.clusters) {
    EXPECT_TRUE(good.holds(cluster));
    EXPECT_NEAR(cluster.best.value, 1, 1e-4);
  }
  const Cluster& alone = good.clusters[static_cast<std::size_t>(cluster_at(good, far))];
  for (const double side : {alone.upper[0] - alone.lower[0], alone.upper[1] - alone.lower[1]}) {
    EXPECT_GE(side, 0.2);
    EXPECT_LE(side, 0.2 + 2 * options.resolution);
  }
  EXPECT_NEAR(alone.share, std::pow((alone.upper[0] - alone.lower[0]) / (2 * kHalfTurn), 2),
              0.3 * alone.share);
}

/// A peak on a joint's limit is in one place if that joint turns all around, else at one end.
TEST(GoodPostures, GoAroundWhereJointsTurn) {
  GoodOptions options;
  options.within = 0.1;
  Multimodal multimodal = multimodal_at({Eigen::Vector2d(kHalfTurn, 0.3)});
  multimodal.turns = {1, 0};
  EXPECT_EQ(list(multimodal, options).clusters.size(), 2U);
  options.turns = multimodal.turns;
  const GoodPostures good = list(multimodal, options);
  ASSERT_EQ(good.clusters.size(), 1U);
  EXPECT_NEAR(good.clusters[0].lower[0], kHalfTurn - 0.1, options.resolution);
  EXPECT_NEAR(good.clusters[0].upper[0], kHalfTurn + 0.1, options.resolution);
  EXPECT_NEAR(good.clusters[0].upper[1], 0.4, options.resolution);
}

/// What is found 5 % below a bound that is that far off may be within 1 %, or not.
TEST(GoodPostures, MayHoldWhatIsNotSure) {
  const Multimodal multimodal = multimodal_at({Eigen::VectorXd::Constant(1, 0.2)});
  MultimodalObjective objective(multimodal);
  const GoodPostures good = find_good_postures(objective, MultimodalBound(multimodal),
                                               {multimodal.peaks[0], 1}, 1.05, {});
  ASSERT_EQ(good.clusters.size(), 1U);
  EXPECT_FALSE(good.holds(good.clusters[0]));
  EXPECT_DOUBLE_EQ(good.sure, 1.05 * 0.99);
}

/// All that is good lies in the boxes whatever ends the search, some of which are larger.
TEST(GoodPostures, EndEarlyWithLargerBoxes) {
  const Multimodal multimodal =
      multimodal_at({Eigen::Vector3d(0.5, 0.7, -2), Eigen::Vector3d(-1, 3, 1)});
  MultimodalObjective objective(multimodal);
  GoodOptions few, late, stopped;
  few.boxes = 20;
  late.seconds = 0;
  stopped.interrupted = [] { return true; };
  for (const auto& [options, reason] :
       {std::pair(few, "boxes"), {late, "time"}, {stopped, "interrupted"}}) {
    const GoodPostures good = list(multimodal, options);
    EXPECT_EQ(good.status, Status::kBracket);
    EXPECT_NE(good.reason.str().find(reason), std::string::npos) << good.reason.c_str();
    expect_sound(objective, good, options);
    double widest = 0;
    for (const GoodBox& box : good.boxes) {
      widest = std::max(widest, (box.upper - box.lower).maxCoeff());
    }
    EXPECT_GT(widest, options.resolution);
    for (const auto& peak : multimodal.peaks) EXPECT_GE(cluster_at(good, peak), 0);
    EXPECT_TRUE(good.holds(good.clusters.front()));
  }
}

TEST(GoodPostures, RejectOptionsOutOfRange) {
  const Multimodal multimodal = multimodal_at({Eigen::VectorXd::Constant(1, 0.2)});
  MultimodalObjective objective(multimodal);
  const MultimodalBound bound(multimodal);
  const auto rejected = [&](const char* key, const auto& spoil, double value = 1, double high = 1) {
    GoodOptions options;
    spoil(options);
    expect_rejected(key, [&] {
      find_good_postures(objective, bound, {multimodal.peaks[0], value}, high, options);
    });
  };
  const auto none = [](GoodOptions&) {};
  for (const double bad : {0.0, -1.0, std::nan(""), kInfinity, -kInfinity}) {
    rejected("within", [&](GoodOptions& options) { options.within = bad; });
    rejected("resolution", [&](GoodOptions& options) { options.resolution = bad; });
    if (bad < 0 || std::isnan(bad)) {
      rejected("seconds", [&](GoodOptions& options) { options.seconds = bad; });
    }
    if (!std::isfinite(bad)) rejected("best", none, bad);
  }
  rejected("within", [](GoodOptions& options) { options.within = 1.1; });
  rejected("boxes", [](GoodOptions& options) { options.boxes = 0; });
  rejected("threads", [](GoodOptions& options) { options.threads = 0; });
  rejected("turns", [](GoodOptions& options) { options.turns = {1, 1}; });
  rejected("high", none, 1, std::nan(""));
}

/// The value may be below zero.
TEST(GoodPostures, AreAShareOfTheSize) {
  EXPECT_DOUBLE_EQ(good_from(50, 0.1), 45);
  EXPECT_DOUBLE_EQ(good_from(-50, 0.1), -55);
  EXPECT_EQ(good_from(kInfinity, 0.1), kInfinity);  // without a bound nothing is certainly good
  Multimodal multimodal = multimodal_at({Eigen::VectorXd::Constant(1, 0.2)});
  multimodal.top = -2;
  GoodOptions options;
  options.within = 0.1;
  const GoodPostures good = list(multimodal, options);
  ASSERT_EQ(good.clusters.size(), 1U);
  EXPECT_NEAR(good.clusters[0].lower[0], 0, options.resolution);
  EXPECT_NEAR(good.clusters[0].upper[0], 0.4, options.resolution);
}

}  // namespace
}  // namespace maxwrench
