// A linear program: max 3 x + 5 y  subject to  x <= 4, 2 y <= 12, 3 x + 2 y <= 18, x, y >= 0. All
// rows are equations, so each inequality gets a column for its slack.
#include <cstdio>
#include <vector>

#include "maxwrench/strategies.h"

using namespace maxwrench;

int main() {
  LinearProgram program;
  const std::vector<Eigen::Triplet<double>> entries = {{0, 0, 1}, {1, 1, 2}, {2, 0, 3}, {2, 1, 2},
                                                       {0, 2, 1}, {1, 3, 1}, {2, 4, 1}};
  program.A.resize(3, 5);
  program.A.setFromTriplets(entries.begin(), entries.end());
  program.b = Eigen::Vector3d(4, 12, 18);
  program.c = Eigen::VectorXd{{3, 5, 0, 0, 0}};
  program.l = Eigen::VectorXd::Zero(5);
  program.u = Eigen::VectorXd::Constant(5, kInfinity);

  for (const LpEntry& solver : lp_solvers()) {
    LpSolution solution;
    solver.make()->solve(program, solution);
    std::printf("%-8s %s %.4f at (%.4f, %.4f), multipliers %.4f %.4f %.4f, %s\n", solver.name,
                to_string(solution.status), solution.objective, solution.x[0], solution.x[1],
                solution.lambda[0], solution.lambda[1], solution.lambda[2],
                verified(program, solution) ? "verified" : "not verified");
  }
}
