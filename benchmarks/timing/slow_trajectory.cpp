#include "benchmarks/timing/slow_trajectory.h"

#include "maxwrench/posture.h"

namespace maxwrench {
namespace {

Eigen::VectorXd drawn(const Problem& problem, Random& random) {
  Eigen::VectorXd theta_r(problem.redundancy());
  for (int j = 0; j < problem.redundancy(); ++j) {
    theta_r[j] = random.uniform(problem.theta_r_min[j], problem.theta_r_max[j]);
  }
  return theta_r;
}

}  // namespace

TrajectoryProgram slow_trajectory(const Problem& problem, Wrench wrench, int instants,
                                  double duration, Random& random) {
  const Zonotope& set = problem.robot.actuation;
  TrajectoryProgram program;
  program.first_min = set.u_min;
  program.first_max = set.u_max;
  program.du_max.resize(set.actuators(), instants - 1);
  if (instants > 1) {
    program.du_max.colwise() = problem.robot.u_rate_max * (duration / (instants - 1));
  }
  WrenchProgram at = make_wrench_program(problem, wrench);
  PostureEvaluator model(problem, false);
  const Eigen::VectorXd from = drawn(problem, random);
  const Eigen::VectorXd way = 0.2 * (drawn(problem, random) - from);
  for (int i = 0; i < instants; ++i) {
    const double s = instants == 1 ? 0 : static_cast<double>(i) / (instants - 1);
    set_posture(model.evaluate(from + s * way), at);
    program.instants.push_back(at);
  }
  return program;
}

}  // namespace maxwrench
