#include <gtest/gtest.h>

#include <cmath>

#include "lib/bound/exact_posture.h"
#include "maxwrench/bound.h"
#include "maxwrench/load.h"
#include "maxwrench/objective.h"
#include "maxwrench/posture.h"
#include "maxwrench/strategies.h"
#include "tests/support/free_poses.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

struct BoundForm {
  const char* measure;
  Wrench wrench;
};

const std::vector<BoundForm> kBoundForms = {{"linf_polytope", Wrench::kPure},
                                            {"linf_polytope", Wrench::kAny},
                                            {"l2_polytope", Wrench::kPure},
                                            {"ellipsoid", Wrench::kPure}};

const std::vector<const char*> kBoundProblems = {"planar/force", "uvms/valve", "uvms/lift",
                                                 "random", "free"};

/// A shipped problem, or one with a sliding joint, or with a pose that is partly free.
Problem bounded_problem(const std::string& name) {
  Random random(8);
  if (name == "free") return with_free_pose(random_problem(random, 2), {{1, 3, 5}, true, true});
  return name == "random" ? random_problem(random, 4) : load_problem(name);
}

MeasureMaker maker(const Problem& problem, const BoundForm& form) {
  return [&problem, form] {
    const bool one = form.wrench == Wrench::kPure;
    return find_measure(form.measure)
        .make(problem, find_wrench_solver(one ? "facets" : "box").make());
  };
}

struct RandomBox {
  Eigen::VectorXd lower, upper, inside;
};

/// Of any size, with a point in it, now and then a corner.
RandomBox random_box(const Problem& problem, Random& random) {
  RandomBox box;
  box.lower = box.upper = box.inside = random_theta_r(problem, random);
  const double size = std::pow(10, -random.uniform(0, 4));
  for (Eigen::Index i = 0; i < box.inside.size(); ++i) {
    box.lower[i] = std::max(problem.theta_r_min[i], box.inside[i] - size * random.uniform(0, 1));
    box.upper[i] = std::min(problem.theta_r_max[i], box.inside[i] + size * random.uniform(0, 1));
    const double where = random.uniform(0, 1);
    if (where < 0.2) box.inside[i] = box.lower[i];
    if (where > 0.8) box.inside[i] = box.upper[i];
  }
  return box;
}

class BoundOf : public testing::TestWithParam<std::tuple<const char*, BoundForm>> {};

std::string form_name(const testing::TestParamInfo<BoundOf::ParamType>& of) {
  std::string name = std::get<0>(of.param);
  const BoundForm& form = std::get<1>(of.param);
  name += std::string("_") + form.measure + (form.wrench == Wrench::kAny ? "_any" : "_pure");
  for (char& c : name) c = c == '/' ? '_' : c;
  return name;
}

INSTANTIATE_TEST_SUITE_P(Forms, BoundOf,
                         testing::Combine(testing::ValuesIn(kBoundProblems),
                                          testing::ValuesIn(kBoundForms)),
                         form_name);

/// 100,000 pairs of a box and a posture in it for each form. Every other bound starts at the
/// multiplier of some other box; what is not of interest ends anywhere below the value.
TEST_P(BoundOf, NoPostureIsAbove) {
  const auto& [name, form] = GetParam();
  const Problem problem = bounded_problem(name);
  const auto bound = make_capability_bound(problem, form.measure, form.wrench);
  const auto objective =
      make_capability_objective(problem, form.wrench, maker(problem, form), false);
  Random random(1);
  BoxProof proof;
  int bounded = 0;
  for (int pair = 0; pair < 25000 / kSampleDivisor; ++pair) {
    const RandomBox box = random_box(problem, random);
    const double value = objective->evaluate(box.inside);
    if (value == -kInfinity) continue;
    if (pair % 2 == 0) proof = {};
    const double low = value - random.uniform(0, 1) * std::abs(value) - 1e-9;
    const double high =
        std::min(bound->ceiling(), 10 + value + random.uniform(0, 2) * std::abs(value));
    bound->evaluate(box.lower, box.upper, low, high, proof);
    EXPECT_LE(proof.high, high);
    if (proof.kind == BoxProof::Kind::kCollision) {
      PostureEvaluator model(problem);
      EXPECT_EQ(model.evaluate(box.inside).violation, Violation::kCollision);
      proof = {};
      continue;
    }
    ++bounded;
    EXPECT_GE(std::max(low, proof.high), value) << box.lower << '\n' << box.upper;
  }
  EXPECT_GT(bounded, 2000 / kSampleDivisor);
}

/// A box of no width is its posture: the bound is the value.
TEST_P(BoundOf, IsExactAtAPoint) {
  const auto& [name, form] = GetParam();
  Problem problem = bounded_problem(name);
  problem.robot.collision = nullptr;
  const auto bound = make_capability_bound(problem, form.measure, form.wrench);
  const auto objective =
      make_capability_objective(problem, form.wrench, maker(problem, form), false);
  Random random(2);
  for (int sample = 0; sample < 50; ++sample) {
    const Eigen::VectorXd theta_r = random_theta_r(problem, random);
    const double value = objective->evaluate(theta_r);
    if (value == -kInfinity) continue;
    BoxProof proof;
    const double size = 1 + std::abs(value);
    bound->evaluate(theta_r, theta_r, value - 1e-4 * size, std::min(bound->ceiling(), 1e4), proof);
    EXPECT_NEAR(proof.high, value, 2e-6 * size);
  }
}

/// U of a pure form from the model in long double alone: a control point, a product of corners of
/// triangles, is a sum of postures at 0, pi/2 and pi with weights that add up to one, for (x, y) =
/// (a - c, b), a + b + c = 1.
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
  Extended most = -kInfinity;
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
  }
  const Zonotope& set = problem.robot.actuation;
  for (int k = 0; k < set.actuators(); ++k) {
    const Extended slope = lambda.cast<Extended>().dot(set.B.col(k).cast<Extended>());
    most += std::max(slope * set.u_min[k], slope * set.u_max[k]);
  }
  return most;
}

/// The bound is never below the exact one of its multiplier, and above by rounding only.
TEST(PolytopeBound, RoundsUpAndByLittle) {
  for (const char* name : {"planar/force", "uvms/valve", "uvms/lift"}) {
    Problem problem = load_problem(name);
    problem.robot.collision = nullptr;
    const auto bound = make_capability_bound(problem, "linf_polytope", Wrench::kPure);
    Random random(3);
    for (int sample = 0; sample < 100 / kSampleDivisor; ++sample) {
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
TEST(PolytopeBound, StandsBesideThatOfIntervals) {
  Problem problem = load_problem("uvms/valve");
  problem.robot.collision = nullptr;
  const auto bound = make_capability_bound(problem, "linf_polytope", Wrench::kPure);
  const auto objective = make_capability_objective(
      problem, Wrench::kPure, maker(problem, {"linf_polytope", Wrench::kPure}), false);
  const int n = problem.robot.velocities();
  const MultiAffine f = pure_rows(problem, Eigen::MatrixXd::Identity(n, n));
  Random random(5);
  double ours = 0, theirs = 0;
  for (int sample = 0; sample < 200 / kSampleDivisor; ++sample) {
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

/// Whether a half of a box collides throughout.
bool half_collides(Bound& bound, const RandomBox& box, int axis) {
  for (const bool second : {false, true}) {
    RandomBox half = box;
    (second ? half.lower : half.upper)[axis] = (box.lower[axis] + box.upper[axis]) / 2;
    BoxProof proof;
    bound.evaluate(half.lower, half.upper, 0, bound.ceiling(), proof);
    if (proof.kind == BoxProof::Kind::kCollision) return true;
  }
  return false;
}

/// All of a box that is turned down collides, and there are such boxes; of others, half of it where
/// it says so.
TEST(CollisionBound, TurnsDownNothingValid) {
  const Problem problem = load_problem("uvms/valve");
  const auto bound = make_capability_bound(problem, "ellipsoid", Wrench::kPure);
  PostureEvaluator model(problem);
  Random random(6);
  int turned_down = 0, cuts = 0;
  for (int sample = 0; sample < 3000 / kSampleDivisor; ++sample) {
    RandomBox box = random_box(problem, random);
    BoxProof proof;
    bound->evaluate(box.lower, box.upper, 0, bound->ceiling(), proof);
    if (proof.kind != BoxProof::Kind::kCollision) {
      EXPECT_TRUE(proof.axis < 0 || half_collides(*bound, box, proof.axis));
      cuts += proof.axis >= 0 ? 1 : 0;
      continue;
    }
    ++turned_down;
    EXPECT_EQ(proof.high, -kInfinity);
    EXPECT_FALSE(problem.robot.collision->pair_name(proof.pair).empty());
    for (int point = 0; point < 20; ++point) {
      Eigen::VectorXd q = box.lower;
      for (Eigen::Index i = 0; i < q.size(); ++i) q[i] = random.uniform(box.lower[i], box.upper[i]);
      EXPECT_EQ(model.evaluate(q).violation, Violation::kCollision);
    }
  }
  EXPECT_GT(turned_down, 300 / kSampleDivisor);
  EXPECT_GT(cuts, 20 / kSampleDivisor);
}

std::string refusal(const std::string& name, const char* measure, Wrench wrench) {
  const Problem problem = load_problem(name);
  try {
    make_capability_bound(problem, measure, wrench);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(CapabilityBound, RefusesWhatItDoesNotServe) {
  const auto refused = [](const std::string& name, const char* measure, Wrench wrench,
                          const char* word) {
    const std::string text = refusal(name, measure, wrench);
    EXPECT_NE(text.find(word), std::string::npos) << name << ": " << text;
    EXPECT_NE(text.find("expected"), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  };
  refused("uvms/valve_trajectory", "linf_polytope", Wrench::kPure, "task in time");
  refused("dual_arm/bar_wall", "ellipsoid", Wrench::kPure, "ellipsoid");
  refused("fixed/push", "linf_polytope", Wrench::kAny, "any");
  refused("planar/two_arms", "linf_polytope", Wrench::kPure, "without limits");
  refused("planar/force", "manipulability", Wrench::kPure, "manipulability");
  refused("planar/force", "ellipsoid", Wrench::kAny, "any");
  EXPECT_EQ(refusal("planar/force", "ellipsoid", Wrench::kPure), "");
}

}  // namespace
}  // namespace maxwrench
