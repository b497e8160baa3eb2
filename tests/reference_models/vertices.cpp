#include "tests/reference_models/vertices.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

namespace maxwrench {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kTolerance = 1e-9;

/// Sets the columns that are not basic to choice number `choice` of their limits; false if there
/// are fewer choices, or it takes a limit that is infinite.
bool set_limits(const std::vector<int>& nonbasic, unsigned choice, const VectorXd& l,
                const VectorXd& u, VectorXd& x) {
  for (std::size_t i = 0; i < nonbasic.size(); ++i) {
    x[nonbasic[i]] = choice >> i & 1U ? u[nonbasic[i]] : l[nonbasic[i]];
    if (std::isinf(x[nonbasic[i]])) return false;
  }
  return true;
}

}  // namespace

std::optional<double> best_vertex(const MatrixXd& A, const VectorXd& b, const VectorXd& c,
                                  const VectorXd& l, const VectorXd& u) {
  const int n = static_cast<int>(A.rows()), columns = static_cast<int>(A.cols());
  unsigned free = 0;
  for (int j = 0; j < columns; ++j) free |= (std::isinf(l[j]) && std::isinf(u[j]) ? 1U : 0U) << j;
  std::optional<double> best;
  std::vector<int> basic, nonbasic;
  VectorXd x(columns), rest(n), solution(n);
  for (unsigned chosen = 0; chosen < (1U << columns); ++chosen) {
    if ((chosen & free) != free || std::popcount(chosen) != n) continue;
    basic.clear();
    nonbasic.clear();
    for (int j = 0; j < columns; ++j) (chosen >> j & 1U ? basic : nonbasic).push_back(j);
    const Eigen::PartialPivLU<MatrixXd> lu(A(Eigen::all, basic));
    for (unsigned choice = 0; choice < (1U << nonbasic.size()); ++choice) {
      x.setZero();
      if (!set_limits(nonbasic, choice, l, u, x)) continue;
      rest.noalias() = b - A * x;
      solution.noalias() = lu.solve(rest);
      for (int i = 0; i < n; ++i) x[basic[i]] = solution[i];
      rest.noalias() = b - A * x;
      const double outside = std::max((x - u).maxCoeff(), (l - x).maxCoeff());
      // Where the basis is singular x is no number or no solution.
      if (!x.allFinite() || outside > kTolerance) continue;
      if (rest.cwiseAbs().maxCoeff() > kTolerance) continue;
      best = std::max(c.dot(x), best.value_or(-kInfinity));
    }
  }
  return best;
}

std::optional<double> brute_force(const WrenchProgram& program) {
  const Zonotope& set = *program.actuation;
  MatrixXd A(set.dimension(), set.actuators() + program.columns());
  VectorXd c = VectorXd::Zero(A.cols()), l(A.cols()), u(A.cols());
  A << set.B, -program.JtW;
  c.tail(program.columns()) = program.c_w;
  l << set.u_min, program.w_min;
  u << set.u_max, program.w_max;
  return best_vertex(A, program.tau_d, c, l, u);
}

}  // namespace maxwrench
