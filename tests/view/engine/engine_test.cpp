#include "view/engine/engine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lib/math/fnv.h"
#include "maxwrench/load.h"
#include "maxwrench/solve.h"
#include "tests/support/coded_tasks.h"
#include "tests/support/support.h"
#include "tests/view/no_collision.h"
#include "verify/bytes.h"
#include "verify/certificate.h"
#include "view/engine/evaluator.h"
#include "view/engine/module.h"
#include "view/engine/problem_data.h"

namespace maxwrench {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::vector<Problem> static_problems() {
  std::vector<Problem> problems;
  for (const std::string& name : shipped_problems()) {
    Problem problem = load_problem(name);
    if (!problem.motion) problems.push_back(std::move(problem));
  }
  return problems;
}

/// The digest of certificates goes through all numbers of robot and task, and knows nothing of how
/// they are written here.
TEST(ProblemData, ReadsWhatWasWritten) {
  const std::vector<Problem> problems = static_problems();
  ASSERT_GE(problems.size(), 8u);
  for (const Problem& problem : problems) {
    const Problem read = read_problem(problem_data(problem));
    EXPECT_EQ(digest(read), digest(problem)) << problem.name;
    EXPECT_EQ(read.name, problem.name);
    EXPECT_EQ(read.theta_r_default, problem.theta_r_default) << problem.name;
    EXPECT_EQ(problem_data(read), problem_data(problem)) << problem.name;
    ASSERT_EQ(read.robot.collision == nullptr, problem.robot.collision == nullptr);
    if (!read.robot.collision) continue;
    ASSERT_EQ(read.robot.collision->pairs(), problem.robot.collision->pairs()) << problem.name;
    for (int i = 0; i < read.robot.collision->pairs(); ++i) {
      EXPECT_EQ(read.robot.collision->pair_name(i), problem.robot.collision->pair_name(i));
    }
  }
}

/// The engine's collision check is made of the shapes that the robot's own is made of.
TEST(ProblemData, KeepsAHull) {
  Collision collision = vehicle_shapes();
  Shape& hull = collision.shapes[2];
  hull.kind = Shape::Kind::kHull;
  hull.points = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}};
  const Problem problem = make_problem(push(finalize(vehicle(), collision)));
  const Problem read = read_problem(problem_data(problem));
  Random random(3);
  int collisions = 0;
  for (int i = 0; i < samples(300); ++i) {
    std::vector<Pose<double>> links(3);
    for (Pose<double>& link : links) {
      link = {random_rotation(random), random_vector(random, 0.2)};
    }
    const int pair = problem.robot.collision->colliding_pair(links);
    EXPECT_EQ(read.robot.collision->colliding_pair(links), pair);
    collisions += pair >= 0 ? 1 : 0;
  }
  EXPECT_GT(collisions, samples(300) / 10);
}

TEST(ProblemData, DamagedDataAreRejected) {
  const std::string data = problem_data(load_problem("planar/two_arms"));
  const auto line = [](const std::string& text) {
    return rejection_of([&] { read_problem(text); });
  };
  EXPECT_THAT(line(""), StartsWith("task data: got data of another kind or version, expected"));
  EXPECT_THAT(line(data.substr(0, 18)), HasSubstr("data that end too early"));
  for (std::size_t size = 30; size < data.size(); size += 97) {
    EXPECT_THAT(line(data.substr(0, size)), HasSubstr("damaged data")) << size;
    std::string changed = data;
    changed[size] = static_cast<char>(changed[size] ^ 4);
    EXPECT_THAT(line(changed), HasSubstr("damaged data")) << size;
  }
}

/// Whoever makes up a checksum gets no further: each count is compared with what is left.
TEST(ProblemData, ShortDataWithAChecksumAreRejected) {
  const std::string data = problem_data(load_problem("planar/force"));
  for (std::size_t size = 17; size + 8 < data.size(); size += 41) {
    const std::string bytes = data.substr(0, size);
    ByteWriter sum;
    sum.whole(fnv1a(bytes), 8);
    EXPECT_THAT(rejection_of([&] { read_problem(bytes + sum.text()); }), HasSubstr("other data"));
  }
}

TEST(ProblemData, SaysWhatTheEngineDoesNotSupport) {
  EXPECT_EQ(why_no_engine(load_problem("uvms/valve")), "");
  EXPECT_EQ(why_no_engine(load_problem("uvms/valve_trajectory")), "");
  EXPECT_EQ(why_no_engine(load_problem(MAXWRENCH_SOURCE_DIR "/examples/tasks/two_link/luus.toml")),
            "");
  Problem own = load_problem("planar/force");
  own.robot.collision = std::make_shared<NoCollision>();
  EXPECT_THAT(why_no_engine(own), StartsWith("planar/force: a collision check of its own"));
  EXPECT_EQ(rejection_of([&] { problem_data(own); }), why_no_engine(own));
}

/// The engine keeps its evaluators, `evaluate` makes them anew.
TEST(TaskEvaluator, IsEvaluate) {
  Random random(5);
  for (const Problem& problem : static_problems()) {
    TaskEvaluator engine(read_problem(problem_data(problem)));
    int optimal = 0;
    for (int i = 0; i < samples(40) || optimal == 0; ++i) {
      ASSERT_LT(i, 1000) << problem.name << ": no random posture has a value";
      const Eigen::VectorXd theta_r = random_theta_r(problem, random);
      for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
        Options options;
        options.wrench = wrench;
        const Answer answer = evaluate(problem, theta_r, options);
        const Evaluation& shown = engine.evaluate(theta_r, {options.measure, wrench, true});
        ASSERT_EQ(shown.status, answer.status) << problem.name << ' ' << theta_r.transpose();
        EXPECT_EQ(shown.reason.str(), answer.reason.str());
        if (answer.status != Status::kOptimal) {
          EXPECT_TRUE(std::isnan(shown.beta));
          continue;
        }
        ++optimal;
        EXPECT_NEAR(shown.beta, answer.beta(), 1e-9 * (1 + std::abs(answer.beta())));
        EXPECT_EQ(shown.solutions, answer.posture.ik_solutions.valid());
        EXPECT_EQ(shown.unit, answer.unit);
        EXPECT_EQ(shown.gradient.size(), problem.redundancy());
      }
    }
  }
}

/// All IK solutions have their end effector at the task's pose, the best one is chosen, and each is
/// found by its joints.
TEST(TaskEvaluator, GoesThroughIkSolutions) {
  const EvaluationChoice choice{.collision = false};
  for (const char* name : {"dual_arm/two_arms", "fixed/push"}) {
    const Problem problem = load_problem(name);
    TaskEvaluator engine(problem);
    Random random(11);
    int several = 0;
    for (int i = 0; i < samples(100) || several <= samples(100) / 20; ++i) {
      ASSERT_LT(i, 1000) << name << ": hardly any random posture has several IK solutions";
      const Eigen::VectorXd theta_r = random_theta_r(problem, random);
      const Evaluation best = engine.evaluate(theta_r, choice);
      if (best.solutions == 0) continue;
      if (best.solutions > 1) ++several;
      Eigen::Matrix<double, 3, 4, Eigen::RowMajor> pose;
      const Pose<double> wanted = pose_at(problem, theta_r);
      pose << wanted.R, wanted.p;
      for (int k = 0; k < best.solutions; ++k) {
        const Evaluation each = engine.evaluate(theta_r, choice, {k, {}});
        EXPECT_EQ(each.solution, k);
        EXPECT_FALSE(each.beta > best.beta);
        EXPECT_LT((each.end_effector - pose.reshaped<Eigen::RowMajor>()).norm(), 1e-9);
        EXPECT_EQ(engine.evaluate(theta_r, choice, {-1, each.theta}).solution, k);
      }
      EXPECT_THAT(rejection_of([&] {
                    engine.evaluate(theta_r, choice, {best.solutions, {}});
                  }),
                  StartsWith("solution: got " + std::to_string(best.solutions)));
    }
  }
}

/// The numbers of a field by its name.
Eigen::VectorXd field(const std::string& name) {
  for (int i = 0; i < engine_fields(); ++i) {
    if (name != engine_field_name(i)) continue;
    return Eigen::Map<const Eigen::VectorXd>(engine_field_numbers(i), engine_field_size(i));
  }
  return {};
}

TEST(Engine, SaysWhyNotAndGoesOn) {
  const Problem problem = load_problem("planar/force");
  const std::string data = problem_data(problem);
  Eigen::VectorXd theta_r = problem.theta_r_default;
  const auto call = [&](const char* measure, const char* wrench) {
    return engine_evaluate(theta_r.data(), static_cast<int>(theta_r.size()), measure, wrench, 1, -1,
                           nullptr, 0);
  };
  ASSERT_EQ(engine_load(data.data(), static_cast<int>(data.size())), nullptr);
  EXPECT_EQ(field("theta_r_max"), problem.theta_r_max);
  EXPECT_STREQ(engine_load(data.data(), 40),
               "task data: got damaged data, expected data that this version wrote");
  EXPECT_EQ(engine_fields(), 0);
  ASSERT_EQ(call("linf_polytope", "pure"), nullptr);
  const double beta = evaluate(problem, theta_r).beta();
  EXPECT_EQ(field("beta")[0], beta);
  EXPECT_THAT(call("mass", "pure"), StartsWith("measure: got 'mass', expected one of ellipsoid"));
  EXPECT_THAT(call("linf_polytope", "most"), StartsWith("wrench: got 'most'"));
  EXPECT_THAT(call("manipulability", "any"), StartsWith("wrench: got 'any'"));
  theta_r[0] = kNan;
  EXPECT_THAT(call("linf_polytope", "pure"),
              StartsWith("theta_r: got a value that is not a finite"));
  theta_r = problem.theta_r_default;
  ASSERT_EQ(call("linf_polytope", "pure"), nullptr);
  EXPECT_EQ(field("beta")[0], beta);
}

TEST(Engine, ModuleIsThatOfTheFolder) {
  EXPECT_TRUE(engine_module().starts_with("\x1f\x8b"));  // gzip; the test `Engine` runs it
  // Texts that long are not to be printed.
  EXPECT_TRUE(engine_module() == read_text(MAXWRENCH_SOURCE_DIR "/view/engine/engine.wasm.gz"));
  EXPECT_TRUE(engine_loader() == read_text(MAXWRENCH_SOURCE_DIR "/view/engine/engine.js"));
}

}  // namespace
}  // namespace maxwrench
