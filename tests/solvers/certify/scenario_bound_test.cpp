#include <gtest/gtest.h>

#include "maxwrench/bound.h"
#include "maxwrench/certify.h"
#include "tests/support/coded_tasks.h"
#include "tests/support/scenario_task.h"

namespace maxwrench {
namespace {

/// No posture of a box exceeds its bound.
TEST(ScenarioBound, NoPostureExceedsIt) {
  for (const auto& [wrench, tables] :
       {std::pair(std::string("set = [[0,0,0,0,0,2], [0,0,0,0,0,-1]]"), std::string()),
        std::pair(std::string(kLift), std::string("[loss]\nany = 1\n")),
        std::pair(std::string(kLift), std::string(kParameters)),
        std::pair(std::string(), std::string("[payload]\ncom = [0.05, 0, 0.02]\n"))}) {
    const Problem task = scenario_task(wrench, tables);
    const auto bound = make_capability_bound(task, "linf_polytope", Wrench::kPure);
    Random random(4);
    Options options;
    options.check_collision = false;
    for (int i = 0; i < samples(40); ++i) {
      const Eigen::VectorXd centre = random_theta_r(task, random);
      const Eigen::VectorXd half =
          Eigen::VectorXd::Constant(centre.size(), random.uniform(1e-3, 0.2));
      const Eigen::VectorXd lower = (centre - half).cwiseMax(task.theta_r_min);
      const Eigen::VectorXd upper = (centre + half).cwiseMin(task.theta_r_max);
      BoxProof proof;
      bound->evaluate(lower, upper, 0, bound->ceiling(), proof);
      for (int k = 0; k < 5; ++k) {
        Eigen::VectorXd theta_r = lower;
        for (Eigen::Index j = 0; j < lower.size(); ++j) {
          theta_r[j] = random.uniform(lower[j], upper[j]);
        }
        const Answer answer = evaluate(task, theta_r, options);
        if (answer.status != Status::kOptimal || proof.kind == BoxProof::Kind::kCollision) continue;
        EXPECT_LE(answer.beta(), std::max(proof.high, 0.0) * (1 + 1e-9) + 1e-9);
      }
    }
  }
}

/// Values of an independent model, which proved them to 0.1 %.
TEST(SLOW_ScenarioBound, ProvesALossAndAPayload) {
  ProofOptions how;
  how.gap = 1e-3;
  how.seconds = 120;
  const Proof loss =
      certify(scenario_task(kTurn, "[loss]\ncases = [['front_right_vertical']]\n"), {}, how);
  EXPECT_EQ(loss.status, Status::kProven) << loss.reason.str();
  EXPECT_NEAR(loss.answer.beta(), 24.8078, 0.026);
  EXPECT_LE(loss.bound, 24.8078 * 1.002);
  const Proof payload =
      certify(scenario_task(
                  "", "[payload]\ncom = [0.05, 0, 0.02]\nvolume_per_kg = 1.2738853503184714e-4\n"),
              {}, how);
  EXPECT_EQ(payload.status, Status::kProven) << payload.reason.str();
  EXPECT_NEAR(payload.answer.beta(), 11.85426, 0.012);
}

TEST(ScenarioBound, RejectsWhatItCannotBound) {
  const auto line = [](const std::string& wrench, const std::string& tables, Wrench allowed) {
    const Problem task = scenario_task(wrench, tables);
    return rejection_of([&] { make_capability_bound(task, "linf_polytope", allowed); });
  };
  const std::string set = "set = [[1,0,0,0,0,0]]";
  EXPECT_TRUE(line(set, "", Wrench::kAny).starts_with("certify: got wrench any, expected pure"));
  EXPECT_TRUE(line("ball = { axes = ['fx', 'fy'], radius = 1 }", "", Wrench::kPure)
                  .starts_with("certify: got a ball, expected a set"));
  EXPECT_TRUE(line(set, "[uncertainty]\ncurrent = { speed = 0.3 }\n", Wrench::kPure)
                  .starts_with("certify: got currents"));
  EXPECT_TRUE(
      line(set, std::string(kParameters) + "com.vehicle = [0.001, 0.001, 0.001]\n", Wrench::kPure)
          .starts_with("certify: got 512 scenarios, expected at most 100"));
}

}  // namespace
}  // namespace maxwrench
