#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/reference_models/lagrange.h"
#include "tests/support/mechanics.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using nlohmann::json;
using reference::Lagrange;
using reference::Terms;

const std::string kProblems = MAXWRENCH_SOURCE_DIR "/problems/";

json eval_state(const std::string& problem, const std::string& state) {
  const CommandResult result = run_maxwrench("eval " + problem + " --json --state '" + state + "'");
  EXPECT_EQ(result.exit_status, 0) << result.err;
  return json::parse(result.out);
}

MatrixXd matrix(const json& rows) {
  const bool nested = rows.at(0).is_array();
  MatrixXd m(rows.size(), nested ? rows[0].size() : 1);
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index k = 0; k < m.cols(); ++k) m(i, k) = nested ? rows[i][k] : rows[i];
  return m;
}

/// Each entry to 1e-9 of the largest.
void expect_terms(const json& ours, const Terms& known) {
  const std::pair<const char*, MatrixXd> all[] = {{"M", known.M},     {"C_v", known.C_v},
                                                  {"D_v", known.D_v}, {"g", known.g},
                                                  {"J", known.J},     {"tau_d", known.tau_d}};
  for (const auto& [name, expected] : all) {
    const MatrixXd found = matrix(ours[name]);
    ASSERT_EQ(found.rows(), expected.rows()) << name;
    ASSERT_EQ(found.cols(), expected.cols()) << name;
    EXPECT_LE((found - expected).cwiseAbs().maxCoeff(), 1e-9 * (1 + expected.cwiseAbs().maxCoeff()))
        << name << "\n"
        << found << "\n\n"
        << expected;
  }
}

/// The numbers of problems/uvms/state_example.toml.
TEST(EvalState, ExampleIsThatOfAnIndependentModel) {
  const Lagrange model(kProblems + "uvms/bluerov2_alpha5.toml");
  VectorXd v(10), v_d(10);
  v << 0.2, 0, -0.1, 0, 0.05, 0.3, 0.1, -0.2, 0.2, 0;
  v_d << 0, 0.1, 0, 0, 0, -0.1, 0, 0, 0.3, 0;
  expect_terms(eval_state("uvms/valve", kProblems + "uvms/state_example.toml"),
               model.terms({{-0.6, 0, 0.2}, {0, 0.1, 0.5}}, Eigen::Vector4d(3.14, 0.4, 1.97, 0), v,
                           v_d, "tool"));
}

struct Named {
  const char* problem;
  const char* robot;
  const char* tool;
};

/// Somewhere on the free axes, moving fast enough for all terms to count.
void expect_as_independent(const Named& named, const Lagrange& model, Random& random) {
  const auto& axes = model.files().axes;
  const int joints = static_cast<int>(model.files().joints.size());
  const int n = static_cast<int>(axes.size()) + joints;
  VectorXd at = VectorXd::Zero(6);
  for (const int axis : axes) at[axis] = random.uniform(-1, 1);
  const VectorXd q = random_numbers(random, joints), v = 2 * random_numbers(random, n),
                 v_d = random_numbers(random, n);
  const auto list = [](const VectorXd& x) {
    return fmt::format("[{:.17g}]", fmt::join(x.data(), x.data() + x.size(), ", "));
  };
  const TemporaryFolder folder;
  std::ofstream file(folder.path() / "state.toml");
  file << "velocity = " << list(v) << "\nacceleration = " << list(v_d)
       << "\n[theta]\nposition = " << list(at.head(3)) << "\nrpy = " << list(at.tail(3)) << "\n";
  for (int i = 0; i < joints; ++i)
    file << fmt::format("{} = {:.17g}\n", model.files().joints[i], q[i]);
  file.close();
  const json ours = eval_state(named.problem, folder.path() / "state.toml");
  const std::vector<std::string> names = ours["velocities"];
  EXPECT_EQ(std::vector<std::string>(names.end() - joints, names.end()), model.files().joints);
  expect_terms(ours, model.terms({at.head<3>(), at.tail<3>()}, q, v, v_d, named.tool));
}

TEST(EvalState, RandomMotionsAreThoseOfAnIndependentModel) {
  Random random(1);
  for (const Named& named :
       {Named{"uvms/valve", "uvms/bluerov2_alpha5.toml", "tool"},
        Named{"dual_arm/two_arms", "dual_arm/two_arms_robot.toml", "left_tool"},
        Named{"dual_arm/bar_wall", "dual_arm/bar.toml", "bar_end"},
        Named{"planar/force", "planar/vehicle.toml", "tool"}}) {
    SCOPED_TRACE(named.problem);
    const Lagrange model(kProblems + named.robot);
    for (int sample = 0; sample < 3; ++sample) expect_as_independent(named, model, random);
  }
}

/// The terms add up, and at rest only gravity is left.
TEST(EvalState, TermsAddUpAndAtRestGravityIsLeft) {
  const TemporaryFolder folder;
  const std::string theta =
      "[theta]\nposition = [1, 2, 0]\nrpy = [0, 0, 1]\nshoulder = 1\nelbow = 2";
  std::ofstream(folder.path() / "rest.toml") << theta;
  std::ofstream(folder.path() / "moving.toml")
      << "velocity = [1, 2, 3, 4, 5]\nacceleration = [5, 4, 3, 2, 1]\n"
      << theta;
  const auto eval = [&](const char* file) {
    const CommandResult result =
        run_maxwrench("eval planar/force --json --state " + std::string(file), folder.path());
    EXPECT_EQ(result.exit_status, 0) << result.err;
    return json::parse(result.out);
  };
  const json rest = eval("rest.toml"), moving = eval("moving.toml");
  EXPECT_EQ(rest["tau_d"], rest["g"]);
  EXPECT_EQ(moving["velocities"], json({"x", "y", "yaw", "shoulder", "elbow"}));
  EXPECT_EQ(moving["J"].size(), 6U);
  EXPECT_EQ(moving["J"][0].size(), 5U);
  for (int row = 0; row < 5; ++row) {
    double sum = moving["C_v"][row].get<double>() + moving["D_v"][row].get<double>() +
                 moving["g"][row].get<double>();
    for (int i = 0; i < 5; ++i) sum += moving["M"][row][i].get<double>() * (5 - i);
    EXPECT_NEAR(sum, moving["tau_d"][row], 1e-12);
  }
}

}  // namespace
}  // namespace maxwrench
