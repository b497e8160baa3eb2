#include <gtest/gtest.h>

#include <cmath>

#include "maxwrench/solve.h"
#include "tests/solvers/scenario/gradients.h"
#include "tests/support/no_allocations.h"
#include "tests/support/scenario_task.h"

namespace maxwrench {
namespace {

struct ListedTask {
  const char* name;
  std::string wrench, tables;
};
void PrintTo(const ListedTask& listed, std::ostream* out) { *out << listed.name; }

const ListedTask kLists[] = {
    {"senses", "set = [[0,0,0,0,0,1], [0,0,0,0,0,-1]]", ""},
    {"held", "set = [[1,0,0,0,0,0], [0,0,-10,0,0,5]]\nhold = true", ""},
    {"tool_axes", "set = [[1,0,0,0,0,0], [0,1,0,0,0,0.5]]\nframe = 'end_effector'", ""},
    {"loads", kLift, kParameters},
    {"volumes", kTurn,
     "[uncertainty]\nvolume.vehicle = 0.0002\nmass.vehicle = '1%'\ncom.vehicle = [0.004, 0.002, "
     "0]\n"
     "payload = { mass = 0.4, com = [0.02, 0, 0] }\n"},
    {"currents", kTurn, "[uncertainty]\ncurrent = { speed = 0.4, directions = 5 }\n"},
    {"everything", "set = [[1,0,0,0,0,0], [0,0,1,0,0,0]]",
     "[uncertainty]\ntrim = 0.1\ncom.link_2 = [0.01, 0, 0]\nthrust = 0.05\ntorque = 0.1\n"
     "current = { vectors = [[0.2, 0.1, 0], [0, 0, 0.1]] }\n"
     "[loss]\ncases = [['front_left_vertical'], ['q1_shoulder_yaw', 'rear_left_vertical']]\n"
     "friction = 0.5\n"},
    {"payload", "", "[payload]\ncom = [0.05, 0, 0.02]\nvolume_per_kg = 1.27e-4\n"},
};

class ScenarioAgreement : public testing::TestWithParam<ListedTask> {
 protected:
  const Problem task_ = scenario_task(GetParam().wrench, GetParam().tables);
};

/// Facets take the worst case of each load by itself; the others solve every combination.
TEST_P(ScenarioAgreement, OfFacetsAndOfSolversOneByOne) {
  Random random(3);
  int values = 0, infeasible = 0;
  for (int i = 0; i < samples(40); ++i) {
    const Eigen::VectorXd theta_r = i == 0 ? task_.theta_r_default : random_theta_r(task_, random);
    Options options;
    options.check_collision = false;
    const Answer facets = evaluate(task_, theta_r, options);
    ASSERT_NE(facets.status, Status::kNumericalError) << facets.reason.str();
    for (const char* solver : {"condensed", "simplex", "ipopt"}) {
      if (std::string(solver) == "ipopt" && (i > 2 || task_.scenarios.count() > 16))
        continue;  // slow
      options.solver = solver;
      const Answer answer = evaluate(task_, theta_r, options);
      // A wrench that loads a limp joint by rounding alone leaves general solvers without a proof.
      if (facets.status == Status::kInfeasible && answer.status == Status::kNumericalError)
        continue;
      ASSERT_EQ(answer.status, facets.status)
          << theta_r.transpose() << ": " << solver << ": " << answer.reason.str() << " / "
          << facets.reason.str();
      if (facets.status != Status::kOptimal) continue;
      const double beta = facets.beta();
      EXPECT_NEAR(answer.beta(), beta,
                  (std::string(solver) == "ipopt" ? 1e-6 : 1e-8) * (1 + std::abs(beta)))
          << solver;
      // w and h belong to the scenario that decides, whichever of several that tie.
      const Capability& capability = answer.capability;
      EXPECT_LT((capability.h - answer.beta() * capability.decides.c).norm(),
                1e-8 * (1 + std::abs(beta)));
    }
    values += facets.status == Status::kOptimal;
    infeasible += facets.status == Status::kInfeasible;
  }
  EXPECT_GT(values, 0);
  EXPECT_LT(infeasible, samples(40));
}

TEST_P(ScenarioAgreement, OfGradientsAndDifferences) {
  Options options;
  options.check_collision = false;
  Random random(5);
  expect_gradients(task_, options, random);
}

TEST_P(ScenarioAgreement, LoopAllocatesNothing) {
  std::vector<Eigen::VectorXd> points(20, task_.theta_r_default);
  for (std::size_t i = 0; i < points.size(); ++i) points[i][1] += 0.01 * static_cast<double>(i);
  expect_no_allocations(task_, "facets", points);
}

INSTANTIATE_TEST_SUITE_P(All, ScenarioAgreement, testing::ValuesIn(kLists),
                         [](const auto& test) { return test.param.name; });

/// The value of a ball is that of the worst of its wrenches: no sample is below it, and the
/// critical wrench has it.
TEST(ScenarioBall, IsTheWorstOfItsWrenches) {
  for (const char* wrench : {"ball = { axes = ['fx', 'fy', 'fz'], radius = 2 }",
                             "ball = { axes = ['tx', 'tz'], radius = 1 }",
                             "c = [3,0,0,0,0,1]\nball = { axes = ['fy', 'fz'], radius = 0.7 }"}) {
    const Problem task = scenario_task(wrench, "[loss]\ncases = [['front_left_vertical']]\n");
    const WrenchBall& ball = *task.scenarios.ball;
    Options options;
    options.check_collision = false;
    Random random(11);
    int values = 0;
    for (int i = 0; values < samples(20); ++i) {
      ASSERT_LT(i, 1000);
      const Eigen::VectorXd theta_r = random_theta_r(task, random);
      const Answer answer = evaluate(task, theta_r, options);
      if (answer.status != Status::kOptimal) continue;
      ++values;
      Problem one = task;
      one.scenarios.ball.reset();
      const auto value_along = [&](const Vector6d& c) {
        one.scenarios.wrenches[0].c = c;
        return evaluate(one, theta_r, options).beta();
      };
      const double beta = answer.beta(), slack = 1e-8 * (1 + beta);
      EXPECT_NEAR(value_along(answer.capability.decides.c), beta, slack);
      for (int k = 0; k < 10; ++k) {
        Eigen::VectorXd z = random_vector(random, 1).head(ball.E.cols());
        z *= ball.radius / z.norm();
        EXPECT_GE(value_along(task.scenarios.wrenches[0].c + ball.E * z), beta - slack);
      }
    }
  }
}

TEST(NominalTask, LeavesOutUncertaintyAndLoss) {
  const Problem plain = scenario_task(kLift, "");
  ASSERT_TRUE(plain.scenarios.empty());
  const Problem listed = scenario_task(kLift, std::string(kParameters) + "[loss]\nany = 1\n");
  EXPECT_TRUE(nominal(listed).scenarios.empty());
  EXPECT_EQ(evaluate(nominal(listed), plain.theta_r_default).beta(),
            evaluate(plain, plain.theta_r_default).beta());
  const Problem set = scenario_task("set = [[0,0,10,0,0,0]]", "[loss]\nany = 1\n");
  const Problem kept = nominal(set);
  ASSERT_FALSE(kept.scenarios.empty());  // the length of its wrench counts
  EXPECT_NEAR(evaluate(kept, plain.theta_r_default).beta(),
              evaluate(plain, plain.theta_r_default).beta() / 10, 1e-12);
  EXPECT_EQ(kept.scenarios.limits.size(), 1u);
}

/// A robot that is too weak for its own weight needs a payload that lifts it: no mass does that.
TEST(ScenarioReasons, NameTheScenarios) {
  const Problem task = scenario_task("set = [[0,0,1,0,0,0], [0,0,-1,0,0,0]]",
                                     "[uncertainty]\npayload = { mass = 60 }\n");
  const Answer answer = evaluate(task, task.theta_r_default);
  EXPECT_EQ(answer.status, Status::kInfeasible);
  EXPECT_NE(answer.reason.str().find("payload"), std::string::npos) << answer.reason.str();
}

}  // namespace
}  // namespace maxwrench
