#include "tests/reference.h"

#include <bit>

namespace maxwrench {

std::optional<double> brute_force(const WrenchProgram& program) {
  const Zonotope& set = *program.actuation;
  const int n = set.dimension();
  const int m = set.actuators();
  const int k = program.columns();
  constexpr double kTolerance = 1e-9;
  std::optional<double> best;
  Eigen::MatrixXd basis(n, n);
  Eigen::VectorXd u(m);
  for (unsigned basic = 0; basic < (1U << m); ++basic) {
    if (std::popcount(basic) != n - k) continue;
    int column = 0;
    for (int j = 0; j < m; ++j) {
      if (basic >> j & 1U) basis.col(column++) = set.B.col(j);
    }
    for (int j = 0; j < k; ++j) basis.col(column++) = -program.JtW.col(j);
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(basis);
    if (lu.rcond() < 1e-12) continue;
    for (unsigned upper = 0; upper < (1U << m); ++upper) {
      if (upper & basic) continue;  // nonbasic columns only
      u.setZero();
      for (int j = 0; j < m; ++j) {
        if (!(basic >> j & 1U)) u[j] = upper >> j & 1U ? set.u_max[j] : set.u_min[j];
      }
      const Eigen::VectorXd x = lu.solve(program.tau_d - set.B * u);
      column = 0;
      for (int j = 0; j < m; ++j) {
        if (basic >> j & 1U) u[j] = x[column++];
      }
      if (((u - set.u_max).array() > kTolerance).any()) continue;
      if (((set.u_min - u).array() > kTolerance).any()) continue;
      const double value = program.c_w.dot(x.tail(k));
      if (!best || value > *best) best = value;
    }
  }
  return best;
}

}  // namespace maxwrench
