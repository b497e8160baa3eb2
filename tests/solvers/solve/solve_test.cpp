#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>
#include <tuple>

#include "benchmarks/suite/product.h"
#include "maxwrench/load.h"
#include "maxwrench/strategies.h"
#include "solvers/solve/method.h"
#include "solvers/solve/row.h"
#include "tests/reference_models/static_task.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

/// The joints' limit [rad].
constexpr double kReach = std::numbers::pi / 3;

using Value = std::function<double(const Eigen::Vector2d&)>;

/// The best point of a grid of `points` each way around `middle`, `width` to each side.
std::vector<std::pair<double, Eigen::Vector2d>> grid(const Value& value,
                                                     const Eigen::Vector2d& middle, double width,
                                                     int points) {
  std::vector<std::pair<double, Eigen::Vector2d>> found;
  for (int i = 0; i < points; ++i) {
    for (int k = 0; k < points; ++k) {
      const Eigen::Vector2d step =
          Eigen::Vector2d(i, k) * 2 / (points - 1) - Eigen::Vector2d::Ones();
      const Eigen::Vector2d at = (middle + width * step).cwiseMax(-kReach).cwiseMin(kReach);
      found.emplace_back(value(at), at);
    }
  }
  std::sort(found.begin(), found.end(),
            [](const auto& a, const auto& b) { return a.first > b.first; });
  return found;
}

/// Values of the planar problem [N] in a model of its own.
class PlanarModel {
 public:
  explicit PlanarModel(const Case& c)
      : robot_(MAXWRENCH_SOURCE_DIR "/problems/planar/vehicle.toml"),
        ellipsoid_(c.measure == "ellipsoid"),
        task_{robot_, "tool", tool(), Vector6d::Unit(0), allowed(c.wrench)} {}

  double operator()(const Eigen::Vector2d& q) const {
    return (ellipsoid_ ? task_.ellipsoid(q) : task_.polytope(q)).value_or(-kInfinity);
  }

 private:
  static Eigen::Isometry3d tool() {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.rotate(Eigen::AngleAxisd(10 * std::numbers::pi / 180, Eigen::Vector3d::UnitZ()));
    return pose;
  }
  static Eigen::MatrixXd allowed(Wrench wrench) {
    if (wrench == Wrench::kPure) return Vector6d::Unit(0);
    Eigen::MatrixXd in_plane(6, 3);
    in_plane << Vector6d::Unit(0), Vector6d::Unit(1), Vector6d::Unit(5);
    return in_plane;
  }

  reference::Lagrange robot_;
  bool ellipsoid_;
  reference::StaticTask task_;
};

/// The optimum in the model of its own: a grid over the joints' limits, and finer and finer ones
/// around its best points. It takes thousands of values, so it is computed once for each measure
/// and wrench.
double planar_optimum(const std::string& measure, Wrench wrench) {
  static std::map<std::pair<std::string, Wrench>, double> known;
  const auto [optimum, is_new] = known.try_emplace({measure, wrench}, -kInfinity);
  if (!is_new) return optimum->second;
  const PlanarModel model({"planar/force", measure, wrench});
  const Value value = [&](const Eigen::Vector2d& q) { return model(q); };
  const auto coarse = grid(value, {0, 0}, kReach, 41);
  for (std::size_t start = 0; start < 5; ++start) {
    auto [beta, q] = coarse[start];
    for (double width = kReach / 20; width > 1e-5; width /= 3) {
      std::tie(beta, q) = grid(value, q, width, 7).front();
    }
    optimum->second = std::max(optimum->second, beta);
  }
  return optimum->second;
}

/// Rows that the paper has a number for: every search by the default solver, every solver by one
/// search.
std::vector<Case> planar_cases() {
  std::vector<Case> cases;
  for (Case c : product(load_problem("planar/force"), 1, 40000)) {
    const bool beta_1 = c.measure == "ellipsoid" && c.wrench == Wrench::kPure;
    if (!beta_1 && c.measure != "linf_polytope") continue;
    const bool own = c.solver == "facets" || c.solver == "condensed" || c.solver == kNoSolver;
    if (!own && c.search != general_search()) continue;
    c.budget = c.solver == "ipopt" ? 1000 : c.search.starts_with("grid") ? 400000 : 20000;
    if (c.search == "mlsl") c.budget = 4000;  // its clusters take time that grows with its square
    cases.push_back(c);
  }
  return cases;
}

class PlanarOptimum : public testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(All, PlanarOptimum, testing::ValuesIn(planar_cases()),
                         [](const testing::TestParamInfo<Case>& named) {
                           const Case& c = named.param;
                           std::string name = fmt::format("{}_{}_{}_{}", c.measure,
                                                          to_string(c.wrench), c.solver, c.search);
                           std::replace(name.begin(), name.end(), '+', '_');
                           return name;
                         });

TEST_P(PlanarOptimum, SLOW_IsFoundByEverySolverAndSearch) {
  const Problem problem = load_problem("planar/force");
  const Answer row = solve(problem, {GetParam(), 2});
  ASSERT_EQ(row.status, Status::kBestFound) << row.reason.c_str();
  EXPECT_NEAR(PlanarModel(GetParam())(row.posture.theta_r), row.capability.beta,
              GetParam().solver == "ipopt" ? 1e-6 : 1e-8);
  const double optimum = planar_optimum(GetParam().measure, GetParam().wrench);
  // Few evaluations are left after the grid through Ipopt.
  const double tolerance = GetParam().solver == "ipopt" ? 2e-3 : 1e-3;
  const std::string& search = GetParam().search;
  // Methods alone that come near only: three take what their points meet, one stops at kinks.
  const bool coarse = search == "sample" || search == "grid" || search == "dp" || search == "mma";
  if (coarse || find_search(search).local) {
    EXPECT_LT(row.capability.beta, optimum + tolerance);
    if (coarse) {
      EXPECT_GT(row.capability.beta, 0.99 * optimum);
    }
  } else {
    EXPECT_NEAR(row.capability.beta, optimum, tolerance);
  }
  EXPECT_LE(row.evaluations, GetParam().budget);
  EXPECT_TRUE(
      row.capability.residual.within(kAnswerTolerance * (1 + std::abs(row.capability.beta))));
}

/// The geometry was identified by the numbers that the paper prints [N].
TEST(Solve, SLOW_PlanarOptimaAreThePapers) {
  EXPECT_NEAR(planar_optimum("linf_polytope", Wrench::kPure), 3.47, 0.01);
  EXPECT_NEAR(planar_optimum("ellipsoid", Wrench::kPure), 1.91, 0.01);
  EXPECT_NEAR(planar_optimum("linf_polytope", Wrench::kAny), 3.88, 0.01);
}

TEST(Solve, SLOW_SearchByIpoptMayEvaluateByIpopt) {
  const Problem problem = load_problem("planar/force");
  const Case c{problem.name, "linf_polytope", Wrench::kPure, "ipopt", "multistart", 1, 200};
  const Answer row = solve(problem, {c, 2});
  EXPECT_EQ(row.status, Status::kBestFound) << row.reason.c_str();
  EXPECT_LE(row.evaluations, 200);
}

/// So heavy that no posture can be held: what a trajectory search finds has a value with slack
/// alone.
TEST(Solve, ASearchOfTrajectoriesFindsNothingWhereOnlySlackBalances) {
  Problem problem = load_problem("uvms/valve");
  add_body(problem.robot.links[0], 1000, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero());
  for (const SearchEntry& search : trajectory_searches()) {
    const Case c{problem.name, "linf_polytope", Wrench::kPure, "", search.name, 1, 60};
    const Answer row = solve(problem, {c, 2});
    EXPECT_EQ(row.status, Status::kNoneFound) << search.name;
    EXPECT_FALSE(row.has_value());
    EXPECT_LE(row.evaluations, 60);
  }
}

TEST(Solve, ASearchOfTrajectoriesRejectsWhatIsNone) {
  for (const auto& [name, measure] :
       {std::pair("planar/force", "ellipsoid"), std::pair("planar/two_arms", "linf_polytope")}) {
    const Problem problem = load_problem(name);
    const Case c{problem.name, measure, Wrench::kPure, "", "slp", 1, 60};
    EXPECT_THROW(solve(problem, {c, 1}), std::invalid_argument) << name;
  }
}

/// fixed/push with the arm all but straight, `reach` m from the wall.
Problem stretched(const std::string& reach) {
  const TemporaryFolder folder;
  std::filesystem::copy(std::filesystem::path(MAXWRENCH_SOURCE_DIR) / "problems" / "fixed",
                        folder.path());
  std::ofstream(folder.path() / "stretched.toml")
      << "type = \"static\"\nrobot = \"arm.toml\"\nend_effector = \"tool\"\nlabel = \"made "
         "up\"\nsource = \"a test\"\n"
         "[pose]\nxyz = ["
      << reach
      << ", 0, 0.34]\nrpy = [0, 1.5707963267948966, 0]\n[wrench]\nc = [1, 0, 0, 0, 0, 0]\n"
         "[theta_r]\njoints = [\"joint_7\"]\ndefault = [0]\n"
         "guess = { joint_2 = 1.5, joint_4 = -0.1, joint_6 = -0.06 }\n";
  return load_problem((folder.path() / "stretched.toml").string());
}

/// A straight arm pushes harder than any weight of slack, and a limit of a joint that follows
/// binds: what a trajectory search finds is a posture all the same, little worse than what a search
/// of postures finds, which sees the elbow bent to the other side too.
TEST(Solve, SearchesOfTrajectoriesFindPosturesOfAStraightArm) {
  for (const char* reach : {"1.0299", "1.027"}) {
    const Problem problem = stretched(reach);
    const Case c{problem.name, "linf_polytope", Wrench::kPure, "", "cobyla", 1, 600};
    const Answer cobyla = solve(problem, {c, 2});
    ASSERT_TRUE(cobyla.has_value());
    for (const SearchEntry& search : trajectory_searches()) {
      const Case each{problem.name, "linf_polytope", Wrench::kPure, "", search.name, 1, 600};
      const Answer row = solve(problem, {each, 2});
      ASSERT_TRUE(row.has_value()) << search.name << ' ' << reach << ": " << row.reason.c_str();
      EXPECT_GT(row.posture.theta_r.size(), 0);
      EXPECT_GE(row.capability.beta, 0.995 * cobyla.capability.beta) << search.name << ' ' << reach;
    }
  }
}

/// Without a choice there is one posture, whose value is that of the default.
TEST(Solve, SearchesOfTrajectoriesWithNothingToChoose) {
  Problem problem = load_problem("planar/force");
  problem.redundant.clear();
  for (Eigen::VectorXd* part :
       {&problem.theta_r_default, &problem.theta_r_min, &problem.theta_r_max}) {
    part->resize(0);
  }
  for (const SearchEntry& search : trajectory_searches()) {
    const Case c{problem.name, "linf_polytope", Wrench::kPure, "", search.name, 1, 60};
    const Method method = resolve(problem, c);
    const Answer row = solve(problem, {method.choice, 2});
    ASSERT_TRUE(row.has_value()) << search.name;
    EXPECT_EQ(row.capability.beta,
              evaluate(problem, Eigen::VectorXd(), {method.choice}).capability.beta);
  }
}

TEST(Solve, SelfCollisionDoesNotChangeThePlanarOptima) {
  const Problem checked = load_problem("planar/force");
  Problem unchecked = checked;
  unchecked.robot.collision = nullptr;
  ASSERT_TRUE(checked.robot.collision != nullptr);
  for (const char* measure : {"ellipsoid", "linf_polytope"}) {
    const Case c{checked.name, measure, Wrench::kPure};
    const Answer with = solve(checked, {c, 1});
    const Answer without = solve(unchecked, {c, 1});
    EXPECT_NEAR(with.capability.beta, without.capability.beta, 1e-9);
  }
}

TEST(Solve, EveryMeasureIsReadBesideTheSameYardstick) {
  const Problem problem = load_problem("uvms/valve");
  const Eigen::Vector4d theta_r(3, 1.2, 1.1, 0.4);
  for (Case c : product(problem, 1, 1)) {
    c.search.clear();
    const Case common{problem.name, "linf_polytope", c.wrench, "simplex"};
    const Answer row = evaluate(problem, theta_r, {c});
    ASSERT_TRUE(row.has_value()) << c.measure << ": " << row.reason.c_str();
    EXPECT_EQ(row.beta_linf, evaluate(problem, theta_r, {common}).capability.beta);
    EXPECT_EQ(values(row).size(), value_columns().size());
    const MeasureEntry& measure = find_measure(c.measure);
    const char* const own = measure.acceleration ? "rad/s^2" : "N m";
    EXPECT_EQ(row.unit, measure.unit ? measure.unit : own);
  }
  // A posture that does not exist has none.
  const Answer none = evaluate(problem, Eigen::Vector4d(9, 9, 9, 9), {{problem.name}});
  EXPECT_TRUE(std::isnan(none.beta_linf));
}

TEST(Solve, KeepsStatusAndReasonOfWhatHasNoValue) {
  Random random(1);
  Problem problem = random_problem(random, 2);
  problem.robot.gravity = 1000;  // nothing can hold this
  const Case c{problem.name, "linf_polytope", Wrench::kPure, "simplex", "grid", 1, 50};
  const Answer row = solve(problem, {c, 1});
  EXPECT_EQ(row.status, Status::kNoneFound);
  EXPECT_FALSE(row.reason.empty());
  EXPECT_FALSE(row.has_posture());
  EXPECT_EQ(values(row).size(), value_columns().size());
  EXPECT_EQ(times(row).size(), time_columns().size());
}

}  // namespace
}  // namespace maxwrench
