#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "maxwrench/bound.h"
#include "maxwrench/load.h"
#include "tests/support/snake.h"
#include "verify/form.h"
#include "verify/model.h"

namespace maxwrench {
namespace {

using nlohmann::json;

/// A proof looks at 3^d points of a box of d joints: 13 took 4.5 GB, and 20 are more than an int.
TEST(LongChain, BeyondTheProofsIsRejectedInOneLine) {
  for (const int joints : {10, 13, 20, 25, 64}) {
    SCOPED_TRACE(joints);
    const Snake snake(joints);
    for (const char* wrench : {"pure", "any"}) {
      const CommandResult result =
          run_maxwrench("certify " + snake.task() + " --time 10 --wrench " + wrench);
      EXPECT_EQ(result.exit_status, 2);
      EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
      EXPECT_NE(result.err.find("got " + std::to_string(joints) + " coordinates"),
                std::string::npos)
          << result.err;
    }
    const Problem problem = load_problem(snake.task());
    EXPECT_THROW(FormModel{problem}, std::invalid_argument);
    // Thrusters of full rank, without which there is no ellipsoid to begin with.
    Problem strong = problem;
    Zonotope& set = strong.robot.actuation;
    Eigen::MatrixXd B = set.B;
    B(5, 0) += 0.4;
    set = make_zonotope(B, set.u_min, set.u_max);
    for (const char* measure : {"linf_polytope", "l2_polytope", "ellipsoid"}) {
      try {
        make_capability_bound(strong, measure, Wrench::kPure);
        ADD_FAILURE() << measure;
      } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find("coordinates"), std::string::npos) << error.what();
      }
    }
  }
}

/// Nine joints are within: a round of 256 boxes takes far longer than there is time for, and what
/// is printed is a bracket all the same, which `verify` accepts.
TEST(LongChain, SLOW_GetsABracketWhenTheTimeEnds) {
  const Snake snake(9);
  for (const char* wrench : {"pure", "any"}) {
    SCOPED_TRACE(wrench);
    const auto start = std::chrono::steady_clock::now();
    const CommandResult result = run_maxwrench(
        "certify task.toml --time 1 --json --certificate proof --wrench " + std::string(wrench),
        snake.path());
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    EXPECT_EQ(result.exit_status, 1) << result.err;
    const json proof = json::parse(result.out);
    EXPECT_EQ(proof["status"], "bracket");
    EXPECT_EQ(proof["reason"], "the time ran out");
    ASSERT_TRUE(proof["bound"].is_number());
    EXPECT_GT(proof["bound"], proof["beta"]);
    EXPECT_LT(proof["wall_s"], took.count());
    const CommandResult checked = run_maxwrench("verify proof", snake.path());
    EXPECT_EQ(checked.exit_status, 0) << checked.err;
    EXPECT_NE(checked.out.find("\nverified\n"), std::string::npos) << checked.out;
  }
}

/// Near the end of what a posture can hold, 13 and more joints deep, the rays of `facets` miss the
/// set of efforts by 1e-9: each such posture gets a verdict all the same.
TEST(LongChain, SLOW_EveryEvaluationHasAVerdict) {
  for (const int joints : {13, 20}) {
    const Snake snake(joints);
    const CommandResult result = run_maxwrench("solve " + snake.task() + " --json --budget 20000");
    ASSERT_EQ(result.exit_status, 0) << result.err;
    const json answer = json::parse(result.out);
    EXPECT_EQ(answer["solver"], "facets");
    EXPECT_EQ(answer["undecided"], 0) << joints << " joints";
  }
}

/// 3^9 products of terms fit, 3^10 do not; nor do 3^20, which no int holds.
TEST(LongChain, ShapesOfFormsAreBounded) {
  const auto of = [](std::size_t joints) {
    return FormShape(std::vector<int>(joints, 3), std::vector<int>(joints, 0));
  };
  EXPECT_EQ(of(9).size, 19683);
  for (const std::size_t joints : {10U, 20U, 21U, 40U}) {
    EXPECT_THROW(of(joints), std::invalid_argument);
  }
}

}  // namespace
}  // namespace maxwrench
