#include "view/scene/parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "maxwrench/explain.h"
#include "maxwrench/load.h"
#include "maxwrench/sensitivity.h"
#include "maxwrench/solve.h"
#include "tests/support/support.h"
#include "view/engine/engine.h"
#include "view/engine/evaluator.h"
#include "view/engine/problem_data.h"

// Trajectories, lists of scenarios and what pages show beside a value.

namespace maxwrench {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using Json = nlohmann::ordered_json;

constexpr const char* kTimedTasks[] = {"planar/trajectory", "uvms/valve_trajectory",
                                       "uvms/valve_impulse"};
constexpr const char* kListTasks[] = {"carry_steel", "lift_with_a_dead_thruster", "turn_both_ways",
                                      "turn_guaranteed", "turn_in_current"};

Problem list_task(const std::string& name) {
  return load_problem(MAXWRENCH_SOURCE_DIR "/examples/tasks/" + name + ".toml");
}

/// The default knots, each moved at random by up to 1 % of the limits.
Eigen::MatrixXd knots_near_default(const Problem& problem, Random& random) {
  Eigen::MatrixXd knots = problem.theta_r_default.transpose().replicate(problem.motion->k, 1);
  const Eigen::VectorXd width = problem.theta_r_max - problem.theta_r_min;
  for (auto knot : knots.rowwise()) {
    for (Eigen::Index i = 0; i < knot.size(); ++i)
      knot[i] += 0.02 * width[i] * (random.uniform() - 0.5);
  }
  return knots;
}

/// Of path and motion nothing is lost: the same knots give the same numbers.
TEST(TaskEvaluator, EvaluatesTrajectoriesAsEvaluateDoes) {
  for (const char* name : kTimedTasks) {
    const Problem problem = load_problem(name);
    const std::string data = problem_data(problem);
    const Problem read = read_problem(data);
    EXPECT_EQ(problem_data(read), data) << name;
    TaskEvaluator engine(read);
    Random random(8);
    int optimal = 0;
    for (int i = 0; i < 3; ++i) {
      const Eigen::MatrixXd knots =
          i == 0
              ? Eigen::MatrixXd(problem.theta_r_default.transpose().replicate(problem.motion->k, 1))
              : knots_near_default(problem, random);
      const Answer expected = evaluate(problem, knots);
      engine.evaluate_knots(knots, {});
      const Answer answer = engine.answer();
      ASSERT_EQ(answer.status, expected.status) << name << ": " << answer.reason.str();
      EXPECT_EQ(answer.reason.str(), expected.reason.str());
      EXPECT_EQ(answer.trajectory.collision.str(), expected.trajectory.collision.str());
      ASSERT_EQ(answer.trajectory.instants.size(), expected.trajectory.instants.size());
      if (answer.status != Status::kOptimal) continue;
      ++optimal;
      EXPECT_EQ(answer.beta(), expected.beta()) << name;
      EXPECT_EQ(to_json(explain(answer)), to_json(explain(expected)));
      for (std::size_t k = 0; k < expected.trajectory.instants.size(); ++k) {
        EXPECT_EQ(answer.trajectory.instants[k].u, expected.trajectory.instants[k].u);
      }
    }
    EXPECT_GE(optimal, 1) << name;
    EXPECT_THAT(rejection_of([&] { engine.evaluate(problem.theta_r_default, {}); }),
                StartsWith("theta_r: got a posture of a task in time"));
    EXPECT_THAT(rejection_of([&] { engine.evaluate_knots(Eigen::MatrixXd::Zero(1, 1), {}); }),
                StartsWith("theta_r: got a table of 1 x 1 numbers"));
    EXPECT_THAT(rejection_of([&] { engine.answer(); }), StartsWith("engine: got no evaluation"));
  }
}

/// A list keeps its wrenches, limits, loads and unit, and the same scenario decides.
TEST(TaskEvaluator, EvaluatesListsAsEvaluateDoes) {
  for (const char* name : kListTasks) {
    const Problem problem = list_task(name);
    const std::string data = problem_data(problem);
    const Problem read = read_problem(data);
    EXPECT_EQ(problem_data(read), data) << name;
    EXPECT_STREQ(read.unit(), problem.unit());
    TaskEvaluator engine(read);
    Random random(2);
    int optimal = 0;
    for (int i = 0; i < 200 && optimal < 3; ++i) {
      const Eigen::VectorXd theta_r =
          i == 0 ? problem.theta_r_default : random_theta_r(problem, random);
      const Answer expected = evaluate(problem, theta_r);
      const Evaluation& shown = engine.evaluate(theta_r, {});
      ASSERT_EQ(shown.status, expected.status) << name;
      EXPECT_EQ(shown.reason.str(), expected.reason.str()) << name;
      if (shown.status != Status::kOptimal) continue;
      ++optimal;
      EXPECT_EQ(shown.beta, expected.beta()) << name;
      EXPECT_EQ(shown.c, Eigen::VectorXd(expected.trajectory.instants[0].c)) << name;
      const Answer answer = engine.answer();
      EXPECT_EQ(scenarios_json(answer), scenarios_json(expected)) << name;
      EXPECT_TRUE(explanation_json(answer).is_null());
    }
    EXPECT_GE(optimal, 1) << name;
  }
}

/// The scenario that decides has the least upper end, which is the value, and its limits hold the
/// efforts that are shown.
TEST(Scene, NamesTheScenarioThatDecides) {
  for (const char* name : kListTasks) {
    const Problem problem = list_task(name);
    const Answer answer = evaluate(problem, problem.theta_r_default.transpose());
    if (!answer.has_value()) continue;
    const Json scenarios = scenarios_json(answer);
    ASSERT_FALSE(scenarios["ends"].empty()) << name;
    const Json& first = scenarios["ends"][0];
    if (!problem.scenarios.ball) {
      EXPECT_EQ(first["name"], scenarios["decides"]) << name;
    }
    EXPECT_NEAR(first["high"].get<double>(), answer.beta(), 1e-7 * (1 + answer.beta())) << name;
    EXPECT_EQ(scenarios["count"], problem.scenarios.count());
    for (Eigen::Index i = 0; i < answer.capability.u.size(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      EXPECT_GE(answer.capability.u[i], scenarios["u_min"][at].get<double>() - 1e-7);
      EXPECT_LE(answer.capability.u[i], scenarios["u_max"][at].get<double>() + 1e-7);
    }
  }
}

/// What a page says is what `eval --explain` says.
TEST(Scene, ExplainsAsEvalDoes) {
  const Problem problem = load_problem("uvms/lift");
  const Answer answer = evaluate(problem, problem.theta_r_default.transpose());
  const Explanation explanation = explain(answer);
  const Json json = explanation_json(answer);
  const std::string text = summary(explanation);
  EXPECT_TRUE(text.starts_with(json["words"].get<std::string>()));
  ASSERT_EQ(json["binding"].size(), explanation.limits.size());
  EXPECT_EQ(json["binding"][0]["gain"], explanation.limits[0].gain);
  EXPECT_EQ(json["least_efforts"]["u"].size(), static_cast<std::size_t>(problem.robot.actuators()));
}

std::string json_field() {
  for (int i = 0; i < engine_fields(); ++i) {
    if (engine_field_name(i) == std::string("json")) return engine_field_text(i, 0);
  }
  return "";
}

TEST(Engine, HasPartsOfTheLastEvaluation) {
  const Problem problem = load_problem("planar/force");
  const std::string data = problem_data(problem);
  ASSERT_EQ(engine_load(data.data(), static_cast<int>(data.size())), nullptr);
  EXPECT_THAT(engine_part("sets", 0), StartsWith("engine: got no evaluation"));
  const Eigen::VectorXd theta_r = Eigen::Vector2d(0.3, -0.7);
  ASSERT_EQ(engine_evaluate(theta_r.data(), 2, "linf_polytope", "pure", 1, -1, nullptr, 0),
            nullptr);
  ASSERT_EQ(engine_part("sets", 0), nullptr);
  const Answer answer = evaluate(problem, theta_r);
  EXPECT_EQ(Json::parse(json_field()), sets_json(answer, 0));
  ASSERT_EQ(engine_part("explanation", 0), nullptr);
  EXPECT_EQ(Json::parse(json_field()), explanation_json(answer));
  ASSERT_EQ(engine_part("scenarios", 0), nullptr);
  EXPECT_EQ(json_field(), "null");
  EXPECT_THAT(engine_part("sets", 1), StartsWith("instant: got 1, expected 0 to 0"));
  EXPECT_THAT(engine_part("mass", 0), StartsWith("part: got 'mass'"));
  EXPECT_THAT(engine_evaluate_knots(theta_r.data(), 2, "linf_polytope", "pure", 1),
              HasSubstr("got knots of a static task"));
}

}  // namespace
}  // namespace maxwrench
