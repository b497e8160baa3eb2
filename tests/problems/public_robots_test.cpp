#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "lib/posture/ik/ik_start_system.h"
#include "maxwrench/load.h"
#include "solvers/solve/row.h"
#include "tests/support/completeness.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;

/// A Franka Panda, and a UR10 that stands or rides on a made-up mecanum base.
class PublicRobots : public testing::Test {
 protected:
  Problem load(const char* task) const { return load_problem((folder_ / task).string()); }

  static Answer search(const Problem& problem, std::uint64_t seed) {
    Case c{problem.name};
    c.seed = seed;
    c.budget = 20000;
    return solve(problem, {c, 1});
  }

  const fs::path folder_ = MAXWRENCH_SOURCE_DIR "/tests/data/robots";
};

/// Both have eight solutions where six joints follow: three parallel axes (UR10), and the last of
/// the Panda's joints fixed, which leaves a spherical shoulder.
TEST_F(PublicRobots, HaveEightSolutions) {
  EXPECT_EQ(load("ur10/push.toml").start_system->solutions(), 8);
  EXPECT_EQ(load("panda/push.toml").start_system->solutions(), 8);
}

TEST_F(PublicRobots, IkSolutionsAreAllThatRandomStartsFind) {
  constexpr int kMany = std::max(50, samples(200));
  expect_complete(load("ur10/mob_ok.toml"), kMany, kMany, kMany);
  expect_complete(load("panda/push.toml"), kMany, kMany, kMany);
}

/// Pushing forwards each wheel gives 150 N along its roller at 45 degrees, 600/sqrt 2 N in sum; the
/// IK solution near the guess bends the arm so that a joint gives way at 323 N.
TEST_F(PublicRobots, SLOW_TheWheelsLimitThePushOfTheBestIkSolution) {
  const Problem problem = load("ur10/mob_ok.toml");
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Answer row = search(problem, seed);
    EXPECT_LE(row.capability.beta, 600 / std::sqrt(2) * (1 + 1e-9));
    EXPECT_GT(row.capability.beta, 600 / std::sqrt(2) * (1 - 1e-6));
    EXPECT_EQ(row.ik_solutions.most, 4);
  }
}

/// The same task without `default` and `guess`.
TEST_F(PublicRobots, SLOW_NeedNeitherGuessNorDefault) {
  const TemporaryFolder copy;
  fs::copy(folder_ / "ur10", copy.path(), fs::copy_options::recursive);
  std::ifstream task(copy.path() / "mob_ok.toml");
  std::ofstream plain(copy.path() / "plain.toml");
  for (std::string line; std::getline(task, line);) {
    if (line.rfind("default", 0) != 0 && line.rfind("guess", 0) != 0) plain << line << '\n';
  }
  plain.close();
  const Problem problem = load_problem((copy.path() / "plain.toml").string());
  PostureEvaluator model(problem);
  EXPECT_EQ(model.evaluate(problem.theta_r_default).status, Status::kValid);
  const double least = 600 / std::sqrt(2) * (1 - 1e-6);
  EXPECT_GT(search(problem, 1).capability.beta, least);
}

/// The best of 10,000 local searches of an independent program, from random postures of the pose,
/// as it was written down: to a tenth.
TEST_F(PublicRobots, SLOW_PandaReachesTheBestOfAnIndependentSearch) {
  struct Best {
    const char* task;
    double beta;
  };
  for (const auto& [task, beta] :
       {Best{"panda/push.toml", 162.5}, Best{"panda/lift.toml", 110.8},
        Best{"panda/pushx.toml", 73.3}, Best{"panda/pushy.toml", 85.7}}) {
    EXPECT_GT(search(load(task), 1).capability.beta, beta - 0.05) << task;
  }
}

}  // namespace
}  // namespace maxwrench
