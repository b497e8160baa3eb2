#include "lib/tank/effort_tracking.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "lib/math/decompositions.h"
#include "lib/math/random.h"
#include "maxwrench/load.h"
#include "maxwrench/types.h"
#include "tests/support/ipopt_qp.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Random requests on the underwater vehicle's B with its own limits and random weights.
struct TrackingCase {
  VectorXd Q;
  EffortRequest request;
  EffortAnswer answer;

  VectorXd inside(Random& random, double share) const {
    const VectorXd half = (request.upper - request.lower) / 2;
    return request.lower + half + VectorXd::NullaryExpr(half.size(), [&] {
                                    return share * random.uniform(-1, 1);
                                  }).cwiseProduct(half);
  }
  void solve() { EffortTracker(Q).solve(request, answer); }
  double cost(const VectorXd& u) const { return (u - request.u_star).cwiseAbs2().dot(Q); }
  /// r'(B Q^-1 B')^-1 r of what is missing.
  double missing(const VectorXd& u) const {
    const MatrixXd& B = request.B;
    const VectorXd r = request.tau_c - B * u;
    return r.dot((B * Q.cwiseInverse().asDiagonal() * B.transpose()).ldlt().solve(r));
  }
  bool within(const VectorXd& u, double by) const {
    return (u.array() >= request.lower.array() - by).all() &&
           (u.array() <= request.upper.array() + by).all();
  }
};

TrackingCase on_vehicle(Random& random) {
  static const Robot kRobot = load_problem("uvms/valve").robot;
  TrackingCase c;
  c.Q = VectorXd::NullaryExpr(kRobot.actuators(), [&] { return random.uniform(0.1, 2); });
  c.request = {kRobot.actuation.B, {}, {}, kRobot.actuation.u_min, kRobot.actuation.u_max};
  return c;
}

/// Two rows and five efforts, all random; `kind` 1: two efforts pull alike, 2: one effort has equal
/// bounds, 3: both.
TrackingCase small(Random& random, int kind) {
  const int m = 5;
  const auto numbers = [&random](int size, double low, double high) -> VectorXd {
    return VectorXd::NullaryExpr(size, [&] { return random.uniform(low, high); });
  };
  TrackingCase c;
  c.Q = numbers(m, 0.1, 2);
  c.request.B = MatrixXd::NullaryExpr(2, m, [&] { return random.normal(); });
  c.request.lower = numbers(m, -3, -0.5);
  c.request.upper = numbers(m, 0.5, 3);
  if ((kind & 1) != 0) c.request.B.col(1) = c.request.B.col(0);
  if ((kind & 2) != 0) c.request.upper[2] = c.request.lower[2];
  return c;
}

/// min x'H x/2 - f'x with B_f x_f = what `reached` and the fixed efforts leave, over every choice
/// of efforts at the lower bound, at the upper bound and free; without `reached` no equality.
std::optional<VectorXd> enumerate(const TrackingCase& c, const MatrixXd& H, const VectorXd& f,
                                  const VectorXd* reached) {
  const auto m = static_cast<int>(f.size());
  int choices = 1;
  for (int i = 0; i < m; ++i) choices *= 3;
  std::optional<VectorXd> best;
  double least = kInfinity;
  for (int choice = 0; choice < choices; ++choice) {
    VectorXd u = VectorXd::Zero(m);
    std::vector<int> free;
    for (int i = 0, code = choice; i < m; ++i, code /= 3) {
      if (code % 3 == 0) free.push_back(i);
      if (code % 3 == 1) u[i] = c.request.lower[i];
      if (code % 3 == 2) u[i] = c.request.upper[i];
    }
    const auto k = static_cast<Eigen::Index>(free.size());
    const Eigen::Index rows = reached != nullptr ? reached->size() : 0;
    MatrixXd kkt = MatrixXd::Zero(k + rows, k + rows);
    VectorXd rhs(k + rows);
    kkt.topLeftCorner(k, k) = H(free, free);
    rhs.head(k) = VectorXd(f - H * u)(free);
    if (reached != nullptr) {
      const MatrixXd B_free = c.request.B(Eigen::all, free);
      kkt.topRightCorner(k, rows) = B_free.transpose();
      kkt.bottomLeftCorner(rows, k) = B_free;
      rhs.tail(rows) = *reached - c.request.B * u;
    }
    if (k > 0) u(free) = VectorXd(pseudo_inverse(kkt) * rhs).head(k);
    if (!c.within(u, 1e-9)) continue;
    if (reached != nullptr && (c.request.B * u - *reached).norm() > 1e-9) continue;
    const double value = u.dot(H * u) / 2 - f.dot(u);
    if (value < least) {
      least = value;
      best = u;
    }
  }
  return best;
}

TEST(EffortTracking, InsideTheLimitsItIsTheWeightedPseudoInverse) {
  Random random(1);
  for (int sample = 0; sample < 50; ++sample) {
    TrackingCase c = on_vehicle(random);
    c.request.u_star = c.inside(random, 0.1);
    c.request.tau_c = c.request.B * c.inside(random, 0.1);
    c.solve();
    const MatrixXd& B = c.request.B;
    const MatrixXd QB = c.Q.cwiseInverse().asDiagonal() * B.transpose();
    const VectorXd expected =
        c.request.u_star + QB * (B * QB).inverse() * (c.request.tau_c - B * c.request.u_star);
    EXPECT_LT((c.answer.u - expected).norm(), 1e-9);
    EXPECT_EQ(c.answer.iterations, 0);
    EXPECT_FALSE(c.answer.relaxed);
    EXPECT_FALSE(c.answer.saturated);
  }
}

/// All choices of active bounds, also with efforts that pull alike or cannot move, and with
/// requests on the very border of what can be had.
TEST(EffortTracking, AgreesWithAllActiveSetsTriedOut) {
  Random random(2);
  int at_bounds = 0;
  for (int sample = 0; sample < std::max(8, samples(80)); ++sample) {
    TrackingCase c = small(random, sample % 4);
    c.request.u_star = c.inside(random, 3);
    VectorXd feasible = c.inside(random, 1);
    if (sample % 5 == 0) {  // a vertex of {B u}: the largest value of a random row of B
      const VectorXd slope = c.request.B.transpose() * Eigen::Vector2d(1, random.normal());
      for (Eigen::Index i = 0; i < feasible.size(); ++i) {
        feasible[i] = slope[i] > 0 ? c.request.upper[i] : c.request.lower[i];
      }
    }
    c.request.tau_c = c.request.B * feasible;
    c.solve();
    const std::optional<VectorXd> expected =
        enumerate(c, 2 * MatrixXd(c.Q.asDiagonal()), 2 * c.Q.cwiseProduct(c.request.u_star),
                  &c.request.tau_c);
    ASSERT_TRUE(expected.has_value()) << sample;
    EXPECT_TRUE(c.answer.converged) << sample;
    EXPECT_FALSE(c.answer.relaxed) << sample;
    EXPECT_TRUE(c.within(c.answer.u, 0)) << sample;
    EXPECT_LT((c.answer.u - *expected).norm(), 1e-5) << sample;
    at_bounds += c.answer.saturated;
  }
  EXPECT_GT(at_bounds, 5);
}

/// Beyond the limits: what is missing is the least possible, in the stated norm.
TEST(EffortTracking, WhatCannotBeHadIsMissedByTheLeastEffort) {
  Random random(3);
  for (int sample = 0; sample < std::max(8, samples(80)); ++sample) {
    TrackingCase c = small(random, sample % 4);
    c.request.u_star = c.inside(random, 0.5);
    const VectorXd reach = c.request.B.cwiseAbs() * c.request.upper.cwiseMax(-c.request.lower);
    c.request.tau_c = 1.5 * reach;
    c.solve();
    const MatrixXd P =
        (c.request.B * c.Q.cwiseInverse().asDiagonal() * c.request.B.transpose()).inverse();
    const std::optional<VectorXd> expected =
        enumerate(c, 2 * c.request.B.transpose() * P * c.request.B,
                  2 * c.request.B.transpose() * P * c.request.tau_c, nullptr);
    ASSERT_TRUE(expected.has_value()) << sample;
    EXPECT_TRUE(c.answer.converged) << sample;
    EXPECT_TRUE(c.answer.relaxed) << sample;
    EXPECT_TRUE(c.answer.saturated) << sample;
    EXPECT_TRUE(c.within(c.answer.u, 0)) << sample;
    EXPECT_NEAR(c.missing(c.answer.u), c.missing(*expected), 1e-5 * c.missing(*expected));
    EXPECT_GT(c.answer.shortfall, 0.1);
  }
}

TEST(EffortTracking, AgreesWithIpoptOnTheVehicle) {
  Random random(4);
  int at_limits = 0;
  for (int sample = 0; sample < std::max(2, samples(30)); ++sample) {
    TrackingCase c = on_vehicle(random);
    c.request.u_star = c.inside(random, 3);
    c.request.tau_c = c.request.B * c.inside(random, 0.99);
    c.solve();
    const VectorXd expected = solve_by_ipopt({2 * MatrixXd(c.Q.asDiagonal()), c.request.B,
                                              2 * c.Q.cwiseProduct(c.request.u_star),
                                              c.request.tau_c, c.request.lower, c.request.upper});
    EXPECT_FALSE(c.answer.relaxed);
    EXPECT_LT(c.answer.shortfall, 1e-5);
    EXPECT_TRUE(c.within(c.answer.u, 0));
    EXPECT_LT((c.answer.u - expected).norm(), 1e-4) << sample;
    EXPECT_NEAR(c.cost(c.answer.u), c.cost(expected), 1e-6 * c.cost(expected));
    at_limits += c.answer.saturated;
  }
  EXPECT_GT(at_limits, 1);
}

/// The relaxed program as it is documented, over u within the bounds and v without.
TEST(EffortTracking, AgreesWithIpoptOnWhatCannotBeHad) {
  Random random(5);
  for (int sample = 0; sample < std::max(2, samples(30)); ++sample) {
    TrackingCase c = on_vehicle(random);
    const Eigen::Index m = c.Q.size(), n = c.request.B.rows();
    c.request.u_star = c.inside(random, 0.5);
    c.request.tau_c = 3 * c.request.B * c.inside(random, 1);
    c.request.tau_c[n - 1] = 5;  // the last joint has 2 N m
    c.solve();
    QuadraticProgram both;
    const MatrixXd Q2 = 2 * MatrixXd(c.Q.asDiagonal());
    both.H.resize(2 * m, 2 * m);
    both.H << Q2, -Q2, -Q2, Q2;
    both.f = VectorXd::Zero(2 * m);
    both.A = MatrixXd::Zero(n, 2 * m);
    both.A.rightCols(m) = c.request.B;
    both.b = c.request.tau_c;
    both.lower.resize(2 * m);
    both.upper.resize(2 * m);
    both.lower << c.request.lower, VectorXd::Constant(m, -1e19);
    both.upper << c.request.upper, VectorXd::Constant(m, 1e19);
    const VectorXd expected = solve_by_ipopt(both).head(m);
    EXPECT_TRUE(c.answer.relaxed);
    EXPECT_TRUE(c.answer.saturated);
    EXPECT_NEAR(c.answer.u[m - 1], 2, 1e-9);
    EXPECT_NEAR(c.missing(c.answer.u), c.missing(expected), 1e-5 * c.missing(expected)) << sample;
    EXPECT_LT((c.request.B * (c.answer.u - expected)).norm(), 1e-2) << sample;
  }
}

/// A row that repeats others asks for nothing new.
TEST(EffortTracking, RowsMayDependOnEachOther) {
  Random random(6);
  for (int sample = 0; sample < 20; ++sample) {
    TrackingCase c = small(random, 0);
    MatrixXd B(3, c.request.B.cols());
    B << c.request.B, c.request.B.row(0) + c.request.B.row(1);
    c.request.B = B;
    c.request.u_star = c.inside(random, 2);
    c.request.tau_c = B * c.inside(random, 0.9);
    c.solve();
    EXPECT_FALSE(c.answer.relaxed) << sample << " " << c.answer.shortfall;
    EXPECT_TRUE(c.within(c.answer.u, 0));
  }
}

TEST(EffortTracking, EarlierRequestsLeaveNoTrace) {
  Random random(7);
  TrackingCase reference = small(random, 0);
  EffortTracker tracker(reference.Q);
  EffortAnswer reused;
  for (int sample = 0; sample < 30; ++sample) {
    TrackingCase c = small(random, sample % 4);
    c.Q = reference.Q;
    c.request.u_star = c.inside(random, 2);
    c.request.tau_c = (sample % 3) * c.request.B * c.inside(random, 1);
    c.solve();
    tracker.solve(c.request, reused);
    EXPECT_EQ(reused.u, c.answer.u);
    EXPECT_EQ(reused.relaxed, c.answer.relaxed);
    EXPECT_EQ(reused.saturated, c.answer.saturated);
  }
}

}  // namespace
}  // namespace maxwrench
