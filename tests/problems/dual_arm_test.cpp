#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "maxwrench/load.h"
#include "maxwrench/strategies.h"
#include "solvers/solve/row.h"
#include "tests/reference_models/static_task.h"
#include "tests/reference_models/vertices.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

Options pure_torque(const char* lp = "") {
  Options options;
  options.solver = lp;
  options.search = "grid+cmaes";
  options.budget = 5000;
  options.threads = 1;
  return options;
}

/// beta of a posture of the arm, by a model of its own: the bar's end is held at the origin, and
/// the tool touches the wall y = -0.5 m at this place, where it pushes along -y or exerts nothing.
double independent_beta(const Posture& posture, const Eigen::Vector2d& s, bool push) {
  const reference::Lagrange robot(MAXWRENCH_SOURCE_DIR "/problems/dual_arm/bar.toml");
  const Vector6d c = Vector6d::Unit(5);
  const reference::StaticTask task{robot, "bar_end", Eigen::Isometry3d::Identity(), c, c};
  const reference::Place base = robot.base_for(task.target, posture.q, task.tool);
  const Eigen::Vector3d place(-0.2 + s[0], -0.5, s[1]);
  EXPECT_LT((robot.tool(base, posture.q, "right_tool").translation() - place).norm(), 1e-9);
  reference::Program program = task.program(posture.q);
  if (push) {
    add_push(robot.jacobian(base, posture.q, "right_tool"), -Vector6d::Unit(1), program);
  }
  return best_vertex(program.A, program.b, program.c, program.l, program.u).value_or(NAN);
}

/// The order that the paper measured: one contact, the default one, the best one.
TEST(DualArm, WallHelpsAndABetterPlaceHelpsMore) {
  const Problem alone = load_problem("dual_arm/bar_alone");
  const Problem wall = load_problem("dual_arm/bar_wall");
  const Answer one = evaluate(alone, alone.theta_r_default, pure_torque());
  const Answer chosen = evaluate(wall, wall.theta_r_default, pure_torque());
  const Answer best = solve(wall, pure_torque());
  ASSERT_TRUE(one.has_value() && chosen.has_value() && best.has_value());
  EXPECT_GT(chosen.capability.beta, 1.1 * one.capability.beta);
  EXPECT_GT(best.capability.beta, 1.02 * chosen.capability.beta);
  for (const Answer* row : {&one, &chosen, &best}) {
    const double expected = independent_beta(row->posture, row->posture.theta_r, row != &one);
    EXPECT_NEAR(row->capability.beta, expected, 1e-8 * expected);
  }
  // The hand presses into the wall, or rests.
  EXPECT_GT(chosen.capability.w.tail<1>()[0], 0);
  EXPECT_GT(best.capability.w.tail<1>()[0], 0);
}

/// No place of a dense grid, judged by another solver and without gradients, is better than what
/// the search finds, and one is nearly as good.
TEST(DualArm, SLOW_SearchFindsTheBestPlaceOfADenseGrid) {
  const Problem wall = load_problem("dual_arm/bar_wall");
  const Answer found = solve(wall, pure_torque());
  ASSERT_TRUE(found.has_value());
  const Options by_simplex = pure_torque("simplex");
  constexpr int kPlaces = 61;
  double best = 0;
  for (int i = 0; i < kPlaces; ++i) {
    for (int k = 0; k < kPlaces; ++k) {
      const Eigen::Vector2d share(i / (kPlaces - 1.0), k / (kPlaces - 1.0));
      const Eigen::VectorXd place =
          wall.theta_r_min + share.cwiseProduct(wall.theta_r_max - wall.theta_r_min);
      const Answer row = evaluate(wall, place, by_simplex);
      if (row.has_value()) best = std::max(best, row.capability.beta);
    }
  }
  EXPECT_GE(found.capability.beta, best * (1 - 1e-9));
  EXPECT_GE(best, found.capability.beta * 0.98);
}

/// Two arms on a base that neither rolls nor pitches, which follows with two joints of the left
/// arm. At zero nothing is valid; the second arm, at rest, would collide everywhere.
TEST(TwoArms, AnOpenDefaultIsValidWithTheSecondContact) {
  const TemporaryFolder folder;
  std::filesystem::copy(std::filesystem::path(MAXWRENCH_SOURCE_DIR) / "problems" / "dual_arm",
                        folder.path());
  const auto edit = [&](const char* file, const std::string& from, const std::string& to) {
    std::string text = read_text(folder.path() / file);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    std::ofstream(folder.path() / file) << text.replace(at, from.size(), to);
  };
  edit("two_arms_robot.toml", "\"roll\", \"pitch\", ", "");
  edit("two_arms.toml", ", \"left_q3_elbow\", \"left_q4_wrist_roll\"]", "]");
  edit("two_arms.toml", "default = [3.141592653589793, 0.4, 1.9707963267948966, 0]", "");
  const Problem problem = load_problem((folder.path() / "two_arms.toml").string());
  PostureEvaluator model(problem);
  const Posture& posture = model.evaluate(problem.theta_r_default);
  EXPECT_EQ(posture.status, Status::kValid) << posture.reason.c_str();
}

}  // namespace
}  // namespace maxwrench
