#include <gtest/gtest.h>

#include "maxwrench/bound.h"
#include "maxwrench/load.h"
#include "maxwrench/objective.h"
#include "maxwrench/strategies.h"
#include "tests/support/boxes.h"

namespace maxwrench {
namespace {

/// U of a pure form, the smaller one of both, from the model in long double alone: a control point,
/// a product of corners of triangles, is a sum of postures at 0, pi/2 and pi with weights that add
/// up to one, for (x, y) = (a - c, b), a + b + c = 1.
Extended exact_pure_U(const Problem& problem, const RandomBox& box, const Eigen::VectorXd& lambda,
                      double low, double high) {
  const Coordinates all = all_coordinates(problem);
  const int d = all.count();
  const int n = problem.robot.velocities();
  std::vector<ExtendedVector> samples;
  ExactPosture posture(problem);
  int size = 1;
  for (int i = 0; i < d; ++i) size *= 3;
  for (int a = 0; a < size; ++a) {
    ExtendedVector q(d);
    for (int i = 0, rest = a; i < d; ++i, rest /= 3) q[i] = std::acos(-1.0L) / 2 * (rest % 3);
    posture.set(q);
    ExtendedVector rows(2 * n);
    rows << posture.tau_d(), posture.J().transpose() * problem.c.cast<Extended>();
    samples.push_back(rows);
  }
  const Zonotope& set = problem.robot.actuation;
  Extended support = 0;
  for (int k = 0; k < set.actuators(); ++k) {
    const Extended slope = lambda.cast<Extended>().dot(set.B.col(k).cast<Extended>());
    support += std::max(slope * set.u_min[k], slope * set.u_max[k]);
  }
  Extended most = -kInfinity, ratio = -kInfinity;
  for (int v = 0; v < size; ++v) {
    ExtendedVector sum = ExtendedVector::Zero(2 * n);
    for (int a = 0; a < size; ++a) {
      Extended weight = 1;
      for (int i = 0, corner = v, place = a; i < d; ++i, corner /= 3, place /= 3) {
        const Extended l = box.lower[i], u = box.upper[i], m = (l + u) / 2;
        const Extended at = corner % 3 == 0 ? l : corner % 3 == 1 ? m : u;
        const Extended scale = corner % 3 == 1 ? 1 / std::cos((u - l) / 2) : 1;
        const Extended x = scale * std::cos(at), y = scale * std::sin(at);
        weight *= place % 3 == 0 ? (1 - y + x) / 2 : place % 3 == 1 ? y : (1 - y - x) / 2;
      }
      sum += weight * samples[static_cast<std::size_t>(a)];
    }
    const ExtendedVector wide = lambda.cast<Extended>();
    const Extended g = wide.dot(sum.head(n)), h = wide.dot(sum.tail(n));
    most = std::max({most, low * (1 - h) - g, high * (1 - h) - g});
    ratio = std::max(ratio, h > 0 ? (support - g) / h : Extended(kInfinity));
  }
  return std::min(support + most, ratio);
}

/// The bound is never below the exact one of its multiplier, and above by rounding only.
TEST(PureBound, RoundsUpAndByLittle) {
  for (const char* name : {"planar/force", "uvms/valve", "uvms/lift"}) {
    Problem problem = load_problem(name);
    problem.robot.collision = nullptr;
    const auto bound = make_capability_bound(problem, "linf_polytope", Wrench::kPure);
    Random random(3);
    for (int sample = 0; sample < samples(100); ++sample) {
      const RandomBox box = random_box(problem, random);
      BoxProof proof;
      bound->evaluate(box.lower, box.upper, 1, bound->ceiling(), proof);
      if (proof.kind != BoxProof::Kind::kMultiplier) continue;
      const auto exact =
          static_cast<double>(exact_pure_U(problem, box, proof.multiplier, 1, bound->ceiling()));
      EXPECT_GE(proof.high, exact);
      EXPECT_LE(proof.high, exact + 1e-7 * (1 + std::abs(exact)));
    }
  }
}

/// An interval; sums and products as they come, without a thought of what depends on what.
struct Naive {
  double low, high;
  Naive& operator+=(const Naive& other) {
    low += other.low;
    high += other.high;
    return *this;
  }
  friend Naive operator*(const Naive& a, const Naive& b) {
    const auto ends = std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
    return {ends.first, ends.second};
  }
};

Naive naive_cosine(double lower, double upper) {
  const double half_turn = std::acos(-1.0);
  Naive range{std::min(std::cos(lower), std::cos(upper)),
              std::max(std::cos(lower), std::cos(upper))};
  if (std::floor(upper / (2 * half_turn)) > std::floor(lower / (2 * half_turn)) ||
      std::fmod(lower, 2 * half_turn) == 0) {
    range.high = 1;
  }
  if (std::floor((upper / half_turn - 1) / 2) > std::floor((lower / half_turn - 1) / 2)) {
    range.low = -1;
  }
  return range;
}

/// The rows over a box, each by itself.
std::vector<Naive> naive_rows(const MultiAffine& f, const RandomBox& box) {
  std::vector<Naive> rows(static_cast<std::size_t>(f.rows()), Naive{0, 0});
  const int d = f.coordinates().count();
  for (Eigen::Index a = 0; a < f.size(); ++a) {
    Naive factor{1, 1};
    Eigen::Index rest = a;
    for (int i = d; i-- > 0; rest /= 3) {
      const double shift = std::acos(-1.0) / 2;
      if (rest % 3 == 1) factor = factor * naive_cosine(box.lower[i], box.upper[i]);
      if (rest % 3 == 2) factor = factor * naive_cosine(box.lower[i] - shift, box.upper[i] - shift);
    }
    for (int row = 0; row < f.rows(); ++row) {
      const double F = f.coefficients()(row, a);
      rows[static_cast<std::size_t>(row)] += Naive{F, F} * factor;
    }
  }
  return rows;
}

/// Ray shooting through the facets with intervals for tau_d and J'c: another true bound.
double naive_bound(const Problem& problem, const MultiAffine& f, const RandomBox& box) {
  const Zonotope& set = problem.robot.actuation;
  const int n = set.dimension();
  const std::vector<Naive> rows = naive_rows(f, box);
  double least = kInfinity;
  for (int facet = 0; facet < set.facet_pairs(); ++facet) {
    Naive tau{0, 0}, a{0, 0};
    for (int i = 0; i < n; ++i) {
      const Naive normal{set.N(i, facet), set.N(i, facet)};
      tau += normal * rows[static_cast<std::size_t>(i)];
      a += normal * rows[static_cast<std::size_t>(n + i)];
    }
    // t a <= b_max - tau with a > 0, or t a >= b_min - tau with a < 0.
    const auto ray = [&](double room, const Naive& slope) {
      if (slope.low > 0) least = std::min(least, room >= 0 ? room / slope.low : room / slope.high);
    };
    ray(set.b_max[facet] - tau.low, a);
    ray(tau.high - set.b_min[facet], {-a.high, -a.low});
  }
  return least;
}

/// Both bounds are above the best of many postures, and ours is the nearer one of small boxes.
TEST(PureBound, StandsBesideThatOfIntervals) {
  Problem problem = load_problem("uvms/valve");
  problem.robot.collision = nullptr;
  const auto bound = make_capability_bound(problem, "linf_polytope", Wrench::kPure);
  const auto objective = make_capability_objective(
      problem, Wrench::kPure,
      [&problem] {
        return find_measure("linf_polytope").make(problem, find_wrench_solver("facets").make());
      },
      false);
  const MultiAffine f = pure_rows(problem);
  Random random(5);
  double ours = 0, theirs = 0;
  for (int sample = 0; sample < samples(200); ++sample) {
    RandomBox box = random_box(problem, random);
    box.lower = box.inside.array() - 0.05;
    box.upper = box.inside.array() + 0.05;
    double best = 0;
    for (int point = 0; point < 30; ++point) {
      Eigen::VectorXd q = box.lower;
      for (Eigen::Index i = 0; i < q.size(); ++i) q[i] = random.uniform(box.lower[i], box.upper[i]);
      best = std::max(best, objective->evaluate(q));
    }
    BoxProof proof;
    bound->evaluate(box.lower, box.upper, 0, bound->ceiling(), proof);
    const double naive = naive_bound(problem, f, box);
    EXPECT_GE(std::max(proof.high, 0.0), best);
    EXPECT_GE(std::max(naive, 0.0), best);
    ours += std::min(proof.high, bound->ceiling());
    theirs += std::min(naive, bound->ceiling());
  }
  EXPECT_LT(ours, theirs);
}

}  // namespace
}  // namespace maxwrench
