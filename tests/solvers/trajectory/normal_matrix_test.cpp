#include "solvers/trajectory/normal_matrix.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "maxwrench/load.h"
#include "solvers/trajectory/forms.h"
#include "tests/support/trajectories.h"

namespace maxwrench {
namespace {

Eigen::MatrixXd normal_numbers(Random& random, Eigen::Index rows, Eigen::Index columns) {
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&](Eigen::Index) { return random.normal(); });
}

/// Eight rows, `spare` actuators more than these, k columns of the wrench: an instant has k + spare
/// variables.
struct RandomStages {
  RandomStages(int k, int spare, bool elastic, int border, Random& random) {
    constexpr int kRows = 8;
    const int m = kRows + spare;
    set = make_zonotope(normal_numbers(random, kRows, m), Eigen::VectorXd::Constant(m, -1),
                        Eigen::VectorXd::Constant(m, 1), 0);
    program.first_min = set.u_min;
    program.first_max = set.u_max;
    program.du_max = Eigen::MatrixXd::Constant(m, kInstants - 1, 0.1);
    if (elastic) program.rho = 100;
    program.first_elastic = 1;
    for (int i = 0; i < kInstants; ++i) {
      WrenchProgram at;
      at.actuation = &set;
      at.c_w = normal_numbers(random, k, 1);
      at.w_min = Eigen::VectorXd::Constant(k, -kInfinity);
      at.w_max = Eigen::VectorXd::Constant(k, kInfinity);
      at.JtW = normal_numbers(random, kRows, k);
      at.tau_d = 0.1 * normal_numbers(random, kRows, 1);
      program.instants.push_back(at);
      if (border > 0) program.G.push_back(normal_numbers(random, kRows, border));
    }
    program.y_min = Eigen::VectorXd::Constant(border, -1);
    program.y_max = Eigen::VectorXd::Constant(border, 1);
    program.R.resize(0, border);
    forms.build(program);
  }
  static constexpr int kInstants = 4;
  Zonotope set;
  TrajectoryProgram program;
  Forms forms;
};

/// phi = Phi X, as forms.h describes it.
Eigen::MatrixXd dense_map(const Forms& forms) {
  Eigen::MatrixXd Phi = Eigen::MatrixXd::Zero(forms.size, forms.variables);
  for (const Forms::Stage& at : forms.stages) {
    Phi.block(at.f0, at.x0, at.count, at.d) = forms.F_of(at);
    if (forms.t > 0) Phi(at.f0 + at.count - 1, forms.z0()) = -1;
  }
  for (int i = 0; i + 1 < forms.N; ++i) {
    Phi.middleRows(forms.rates0 + forms.rated * i, forms.rated) =
        Phi.middleRows(forms.stages[i + 1].f0, forms.rated) -
        Phi.middleRows(forms.stages[i].f0, forms.rated);
  }
  Phi.topRightCorner(forms.border0, forms.p) = forms.D;
  Phi.block(forms.border0, forms.variables - forms.p, forms.p, forms.p).setIdentity();
  return Phi;
}

double difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).norm() / b.norm();
}

/// What the blocks compute, by compiled sizes and by any, is what the dense matrices give.
TEST(NormalMatrix, BlocksOfAllSizesAgreeWithTheDenseMatrix) {
  Random random(1);
  int compiled = 0, generic = 0;
  NormalMatrix matrix;
  for (int d = 1; d <= 10; ++d) {
    for (int k = std::max(1, d - 4); k <= std::min(d, 6); ++k) {
      for (const bool elastic : {false, true}) {
        for (const int border : {0, 3}) {
          const RandomStages stages(k, d - k, elastic, border, random);
          const Forms& forms = stages.forms;
          ASSERT_EQ(forms.stages.front().d, d);
          ASSERT_EQ(forms.stages.back().d, elastic ? d + 8 : d);
          (is_compiled(d) ? compiled : generic) += 1;
          const Eigen::MatrixXd Phi = dense_map(forms);
          Eigen::MatrixXd X = normal_numbers(random, forms.variables, 2);
          Eigen::MatrixXd phi(forms.size, 2);
          forms.apply(X, phi);
          EXPECT_LT(difference(phi, Phi * X), 1e-13) << d << ' ' << k;
          Eigen::MatrixXd g = normal_numbers(random, forms.size, 2);
          Eigen::MatrixXd sum = X;
          const Eigen::MatrixXd expected = X + Phi.transpose() * g;
          forms.add_transposed(g, sum);
          EXPECT_LT(difference(sum, expected), 1e-13) << d << ' ' << k;
          const Eigen::VectorXd theta = Eigen::VectorXd::NullaryExpr(
              forms.size, [&](Eigen::Index) { return random.uniform(0.1, 10); });
          matrix.reserve(forms);
          matrix.factor(forms, theta, 1e-15);
          Eigen::MatrixXd solved = X;
          matrix.solve(forms, solved);
          const Eigen::MatrixXd H = Phi.transpose() * theta.asDiagonal() * Phi;
          EXPECT_LT((H * solved - X).norm(), 1e-14 * H.norm() * solved.norm()) << d << ' ' << k;
        }
      }
    }
  }
  EXPECT_GT(compiled, 50);
  EXPECT_GT(generic, 50);
}

/// The table of docs/algorithms/solvers/ipm.md: columns of the wrench and actuators to spare.
TEST(NormalMatrix, TasksInTimeTakeThePathThatTheTableSays) {
  const std::map<std::string, std::pair<int, int>> sizes = {
      {"planar", {2, 4}}, {"mobile", {2, 7}}, {"uvms", {3, 8}}};
  int tasks = 0;
  for (const std::string& name : shipped_problems()) {
    const Problem problem = load_problem(name);
    if (!problem.motion) continue;
    ++tasks;
    const auto [pure, any] = sizes.at(name.substr(0, name.find('/')));
    for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
      Random random(2);
      TrajectoryRecipe recipe;
      recipe.wrench = wrench;
      const TrajectoryProgram program = random_trajectory(problem, recipe, random);
      Forms forms;
      forms.build(program);
      const int d = wrench == Wrench::kPure ? pure : any;
      for (const Forms::Stage& at : forms.stages) EXPECT_EQ(at.d, d) << name;
      EXPECT_EQ(is_compiled(d), d != 7) << name;
    }
  }
  EXPECT_EQ(tasks, 7);
}

}  // namespace
}  // namespace maxwrench
