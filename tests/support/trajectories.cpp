#include "tests/support/trajectories.h"

#include "maxwrench/posture.h"

namespace maxwrench {
namespace {

Eigen::VectorXd any_theta_r(const Problem& problem, Random& random) {
  Eigen::VectorXd theta_r(problem.redundancy());
  for (int j = 0; j < problem.redundancy(); ++j) {
    theta_r[j] = random.uniform(problem.theta_r_min[j], problem.theta_r_max[j]);
  }
  return theta_r;
}

TrajectoryProgram empty_trajectory(const Problem& problem, int instants) {
  const Zonotope& set = problem.robot.actuation;
  TrajectoryProgram program;
  program.first_min = set.u_min;
  program.first_max = set.u_max;
  program.du_max = Eigen::MatrixXd::Constant(set.actuators(), instants - 1, kInfinity);
  return program;
}

void add_border(const Problem& problem, int p, Random& random, TrajectoryProgram& program) {
  const int n = problem.robot.velocities();
  for (int i = 0; i < program.size(); ++i) {
    program.G.push_back(
        Eigen::MatrixXd::NullaryExpr(n, p, [&](Eigen::Index) { return 5 * random.normal(); }));
  }
  program.y_min = Eigen::VectorXd::Constant(p, -0.1);
  program.y_max = Eigen::VectorXd::Constant(p, 0.2);
  const int rows = 2 * p;
  Eigen::MatrixXd R(rows, p);
  for (double& a : R.reshaped()) a = random.uniform() < 0.3 ? random.normal() : 0;
  program.R = R.sparseView();
  program.R.makeCompressed();
  program.r_min = Eigen::VectorXd::Constant(rows, -0.15);
  program.r_max = Eigen::VectorXd::Constant(rows, 0.15);
  if (rows > 2) program.r_min[1] = -kInfinity;
}

}  // namespace

TrajectoryProgram random_trajectory(const Problem& problem, const TrajectoryRecipe& recipe,
                                    Random& random) {
  TrajectoryProgram program = empty_trajectory(problem, recipe.instants);
  const Zonotope& set = problem.robot.actuation;
  WrenchProgram at = make_wrench_program(problem, recipe.wrench);
  PostureEvaluator model(problem, false);
  for (int i = 0; i < recipe.instants; ++i) {
    set_posture(model.evaluate(any_theta_r(problem, random)), at);
    const Eigen::VectorXd u =
        set.u_max.unaryExpr([&](double most) { return recipe.load * most * random.normal(); });
    at.tau_d += set.B * u;
    program.instants.push_back(at);
  }
  for (int j = 0; recipe.rates && j < set.actuators(); ++j) {
    if (problem.robot.u_rate_max[j] < kInfinity) {
      program.du_max.row(j).setConstant(recipe.du * set.u_max[j]);
    }
  }
  program.peak = recipe.peak;
  program.common = recipe.common;
  program.rho = recipe.rho;
  if (recipe.border > 0) add_border(problem, recipe.border, random, program);
  return program;
}

}  // namespace maxwrench
