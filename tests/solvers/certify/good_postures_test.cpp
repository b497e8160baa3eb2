#include "solvers/certify/good_postures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"
#include "solvers/certify/certify.h"
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

bool holds(const GoodBox& box, const Eigen::VectorXd& x) {
  return (x.array() >= box.lower.array()).all() && (x.array() <= box.upper.array()).all();
}

/// Of the first box that holds x; -1: none.
int cluster_at(const GoodPostures& good, const Eigen::VectorXd& x) {
  for (const GoodBox& box : good.boxes) {
    if (holds(box, x)) return box.cluster;
  }
  return -1;
}

/// What is true of every list.
void expect_sound(Objective& objective, const GoodPostures& good, const GoodOptions& options) {
  for (const GoodBox& box : good.boxes) {
    EXPECT_GE(box.high, good.least);
    if (good.status == Status::kProven) {
      EXPECT_LE((box.upper - box.lower).maxCoeff(), options.resolution * (1 + 1e-8));
    }
    EXPECT_TRUE((box.lower.array() >= objective.lower().array()).all());
    EXPECT_TRUE((box.upper.array() <= objective.upper().array()).all());
  }
  double last = kInfinity;
  for (std::size_t i = 0; i < good.clusters.size(); ++i) {
    const Cluster& cluster = good.clusters[i];
    EXPECT_LE(cluster.best.value, last);
    last = cluster.best.value;
    if (last == -kInfinity) continue;
    EXPECT_EQ(cluster_at(good, cluster.best.theta_r), static_cast<int>(i));
    EXPECT_EQ(objective.evaluate(cluster.best.theta_r), last);
    EXPECT_LE(last, cluster.high + 1e-9 * std::abs(last));
  }
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
  Multimodal multimodal = multimodal_at({Eigen::VectorXd::Constant(1, 0.2)});
  multimodal.top = -2;
  GoodOptions options;
  options.within = 0.1;
  const GoodPostures good = list(multimodal, options);
  ASSERT_EQ(good.clusters.size(), 1U);
  EXPECT_NEAR(good.clusters[0].lower[0], 0, options.resolution);
  EXPECT_NEAR(good.clusters[0].upper[0], 0.4, options.resolution);
}

/// A problem, its best posture and the list of all good ones.
struct Listed {
  Problem problem;
  std::unique_ptr<Objective> objective;
  CertifyResult proof;

  explicit Listed(const char* name) : problem(load_problem(name)) {
    objective = make_capability_objective(problem, Wrench::kPure, [this] {
      return find_measure("linf_polytope").make(problem, find_wrench_solver("facets").make());
    });
    SearchOptions search;
    search.start = problem.theta_r_default;
    const SearchResult found = find_search(general_search()).make()->maximize(*objective, search);
    CertifyOptions options;
    proof = certify(*objective, *bound(), {found.theta_r, found.value}, options);
  }
  Listed(const Listed&) = delete;

  std::unique_ptr<Bound> bound() const {
    return make_capability_bound(problem, "linf_polytope", Wrench::kPure);
  }
  GoodPostures list(const GoodOptions& options) const {
    return find_good_postures(*objective, *bound(), proof.best, proof.bound, options);
  }
};

/// Every posture of a fine grid that is within 1 % lies in a box.
TEST(GoodPostures, SLOW_OfTheWholePlaneAreListed) {
  const Listed at("planar/force");
  const GoodOptions options;
  const GoodPostures good = at.list(options);
  EXPECT_EQ(good.status, Status::kProven);
  expect_sound(*at.objective, good, options);
  EXPECT_TRUE(good.holds(good.clusters.front()));
  const int steps = 1000;
  int found = 0;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= steps; ++j) {
      const Eigen::Array2d part = Eigen::Array2d(i, j) / steps;
      const Eigen::VectorXd& lower = at.problem.theta_r_min;
      const Eigen::VectorXd x = lower.array() + part * (at.problem.theta_r_max - lower).array();
      if (at.objective->evaluate(x) < good.least) continue;
      ++found;
      EXPECT_GE(cluster_at(good, x), 0) << x.transpose();
    }
  }
  EXPECT_GT(found, steps / 50);
}

/// Random walks through what is within 1 % never leave the boxes; they begin where local searches
/// by random steps come that near.
TEST(GoodPostures, SLOW_OfAVehicleAreListed) {
  const Listed at("uvms/lift");
  GoodOptions options;
  options.resolution = 0.1;
  const GoodPostures good = at.list(options);
  EXPECT_EQ(good.status, Status::kProven);
  expect_sound(*at.objective, good, options);
  Random random(7);
  int arrived = 0, found = 0;
  for (int start = 0; start < samples(200); ++start) {
    Eigen::VectorXd x = start == 0 ? at.proof.best.theta_r : random_theta_r(at.problem, random);
    double value = at.objective->evaluate(x);
    for (int step = 0; step < 2000; ++step) {
      const double size = std::pow(10, random.uniform(-3.5, 0));
      Eigen::VectorXd next = x;
      for (double& q : next) q += random.uniform(-size, size);
      next = next.cwiseMax(at.problem.theta_r_min).cwiseMin(at.problem.theta_r_max);
      const double there = at.objective->evaluate(next);
      if (there < std::min(value, good.least)) continue;
      x = next;
      value = there;
      if (value < good.least) continue;
      ++found;
      ASSERT_GE(cluster_at(good, x), 0) << x.transpose();
    }
    arrived += value >= good.least ? 1 : 0;
  }
  EXPECT_GE(arrived, 3);
  EXPECT_GE(found, samples(1000));
}

TEST(GoodPostures, SLOW_AreTheSameAtAnyThreadCount) {
  const Listed at("uvms/lift");
  std::vector<std::vector<double>> all;
  for (const int threads : {1, 3}) {
    GoodOptions options;
    options.resolution = 0.2;
    options.threads = threads;
    const GoodPostures good = at.list(options);
    auto& of_run = all.emplace_back();
    for (const GoodBox& box : good.boxes) {
      for (const double value : {box.lower.sum(), box.high, double(box.cluster)}) {
        of_run.push_back(value);
      }
    }
    for (const Cluster& cluster : good.clusters) of_run.push_back(cluster.best.value);
  }
  EXPECT_EQ(all[0], all[1]);
}

}  // namespace
}  // namespace maxwrench
