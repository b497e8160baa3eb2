#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "maxwrench/posture.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"
#include "solvers/certify/bound/bounds.h"
#include "solvers/certify/box_coordinates.h"
#include "solvers/certify/certify.h"
#include "solvers/certify/good_postures.h"
#include "tests/support/good_postures.h"
#include "tests/support/loops.h"
#include "tests/support/support.h"

// Lists of the good postures of tasks.

namespace maxwrench {
namespace {

/// A problem, its best posture and the list of all good ones.
struct Listed {
  Problem problem;
  Wrench wrench;
  MeasureMaker make_measure;
  std::unique_ptr<Objective> objective;
  CertifyResult proof;

  explicit Listed(const char* name, Wrench any_or_pure = Wrench::kPure)
      : problem(loop_problem(name)), wrench(any_or_pure) {
    make_measure = [this] {
      return find_measure("linf_polytope").make(problem, find_wrench_solver("condensed").make());
    };
    objective = make_capability_objective(problem, wrench, make_measure);
    SearchOptions search;
    search.start = problem.theta_r_default;
    const SearchResult found = find_search(general_search()).make()->maximize(*objective, search);
    CertifyOptions options;
    proof = certify(*objective, *bound(), {found.theta_r, found.value}, options);
  }
  Listed(const Listed&) = delete;

  std::unique_ptr<Bound> bound() const {
    return make_bound_of_all_coordinates(problem, "linf_polytope", wrench);
  }
  GoodPostures list(GoodOptions options) const {
    options.turns = BoxCoordinates(problem).turns();
    if (!problem.dependent.empty()) {
      options.make_postures = make_all_postures(problem, wrench, make_measure);
    }
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

/// No posture of random theta_r with a good value, whatever its IK solution, is outside the boxes;
/// and what a cluster has as its best is a posture in it with this value.
void expect_all_ik_solutions(const Listed& at) {
  GoodOptions options;
  options.within = 0.2;
  options.resolution = 0.2;
  const GoodPostures good = at.list(options);
  EXPECT_EQ(good.status, Status::kProven) << good.reason.c_str();
  const BoxCoordinates coordinates(at.problem);
  const auto near = [&](const Eigen::VectorXd& x) {
    int cluster = -1;
    for (const GoodBox& box : good.boxes) {
      EXPECT_LE((box.upper - box.lower).maxCoeff(), options.resolution * (1 + 1e-8));
      if ((x.array() < box.lower.array() - 1e-7).any()) continue;
      if ((x.array() <= box.upper.array() + 1e-7).all()) cluster = box.cluster;
    }
    return cluster;
  };
  Random random(5);
  const PosturesAt postures_at = make_all_postures(at.problem, at.wrench, at.make_measure)();
  std::vector<PosturePoint> postures;
  int found = 0;
  for (int i = 0; i < samples(3000); ++i) {
    postures_at(random_theta_r(at.problem, random), postures);
    for (const PosturePoint& posture : postures) {
      if (posture.value < good.least) continue;
      ++found;
      EXPECT_GE(near(posture.x), 0) << posture.x.transpose();
    }
  }
  EXPECT_GE(found, 1);
  EXPECT_TRUE(good.holds(good.clusters.front()));
  // Both limits of an angle are the same place only if they are a turn apart.
  const std::vector<char> turns = coordinates.turns();
  for (int i = 0; i < coordinates.count(); ++i) {
    if (turns[static_cast<std::size_t>(i)] == 0) continue;
    EXPECT_NEAR(good.upper[i] - good.lower[i], 2 * std::numbers::pi, 1e-8) << coordinates.name(i);
  }
  for (std::size_t i = 0; i < good.clusters.size(); ++i) {
    const Cluster& cluster = good.clusters[i];
    if (cluster.best.value == -kInfinity) continue;
    EXPECT_EQ(near(cluster.x), static_cast<int>(i));
    postures_at(cluster.best.theta_r, postures);
    double nearest = kInfinity, value = 0;
    for (const PosturePoint& posture : postures) {
      const double distance = (posture.x - cluster.x).lpNorm<Eigen::Infinity>();
      if (distance < nearest) value = posture.value;
      nearest = std::min(nearest, distance);
    }
    EXPECT_LE(nearest, 1e-7);
    EXPECT_NEAR(value, cluster.best.value, 1e-7 * std::abs(value));
  }
}

/// Lists with dependent joints.
class GoodDependents : public testing::TestWithParam<const char*> {};

TEST_P(GoodDependents, HaveAllTheirIkSolutionsListed) {
  expect_all_ik_solutions(Listed(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Tasks, GoodDependents,
                         testing::Values("mobile/push", "random, fixed", "random, yaw",
                                         "random, x y z yaw", "random, parked"),
                         loop_name);

TEST(GoodPostures, SLOW_OfAnyWrenchesAreListed) {
  expect_all_ik_solutions(Listed("gallery/panda/push", Wrench::kAny));
}

/// The first three joints of `fixed/push` meet in a point. With q_1 and q_3 half a turn further and
/// -q_2 all links from the elbow on are where they were, so two IK solutions have each good value,
/// in clusters that are apart.
TEST(GoodPostures, SLOW_OfIkSolutionsAreApart) {
  const Listed at("fixed/push");
  const GoodPostures good = at.list({});
  EXPECT_EQ(good.status, Status::kProven);
  ASSERT_EQ(good.clusters.size(), 4U);
  for (const Cluster& cluster : good.clusters) {
    EXPECT_TRUE(good.holds(cluster));
    EXPECT_NEAR(cluster.best.value, good.clusters[0].best.value, 1e-3);
  }
  for (const Cluster& cluster : good.clusters) {
    EXPECT_NEAR(cluster.share, good.clusters[0].share, 1e-9);
    EXPECT_NEAR(cluster.share * (at.problem.theta_r_max - at.problem.theta_r_min)[0],
                cluster.upper[0] - cluster.lower[0], 1e-6);
  }
}

TEST(GoodPostures, SLOW_AreTheSameAtAnyThreadCount) {
  for (const char* name : {"uvms/lift", "gallery/panda/push"}) {
    const Listed at(name);
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
}

}  // namespace
}  // namespace maxwrench
