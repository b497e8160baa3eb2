#include "benchmarks/timing/lp_forms.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lib/math/decompositions.h"
#include "lib/math/direct_drives.h"

namespace maxwrench {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

LinearProgram from_dense(const MatrixXd& A, const VectorXd& b, const VectorXd& c, const VectorXd& l,
                         const VectorXd& u) {
  LinearProgram program;
  program.A = A.sparseView();
  program.b = b;
  program.c = c;
  program.l = l;
  program.u = u;
  return program;
}

/// Columns (u, h): B u - J'h = tau_d, (W W^+ - I) h = 0. J' acts only on the span of W, to which
/// the second rows restrict h. A second contact keeps its columns w_2, whose bounds give its
/// directions.
LinearProgram paper_form(const WrenchProgram& program) {
  const Zonotope& set = *program.actuation;
  const int n = set.dimension();
  const int m = set.actuators();
  const auto own = static_cast<int>(program.W.cols());
  const int l = program.columns() - own;
  const bool all = own == 6;
  const MatrixXd W_pinv = pseudo_inverse(program.W);
  MatrixXd A = MatrixXd::Zero(n + (all ? 0 : 6), m + 6 + l);
  A.topLeftCorner(n, m) = set.B;
  A.block(0, m, n, 6) = -program.JtW.leftCols(own) * W_pinv;
  A.topRightCorner(n, l) = -program.JtW.rightCols(l);
  if (!all) A.block(n, m, 6, 6) = program.W * W_pinv - MatrixXd::Identity(6, 6);
  VectorXd b = VectorXd::Zero(A.rows());
  b.head(n) = program.tau_d;
  VectorXd c = VectorXd::Zero(m + 6 + l);
  c.segment(m, 6) = W_pinv.transpose() * program.c_w.head(own);
  VectorXd low = VectorXd::Constant(m + 6 + l, -kInfinity);
  VectorXd high = VectorXd::Constant(m + 6 + l, kInfinity);
  low.head(m) = set.u_min;
  high.head(m) = set.u_max;
  low.tail(l) = program.w_min.tail(l);
  high.tail(l) = program.w_max.tail(l);
  return from_dense(A, b, c, low, high);
}

/// One column: the joints' limits bound w.
LinearProgram reduce_pure(const WrenchProgram& program, const DirectDrives& drives) {
  const Zonotope& set = *program.actuation;
  double low = program.w_min[0];
  double high = program.w_max[0];
  for (std::size_t k = 0; k < drives.rows.size(); ++k) {
    const double slope = program.JtW(drives.rows[k], 0);
    const double gain = set.B(drives.rows[k], drives.columns[k]);
    double first = gain * set.u_min[drives.columns[k]] - program.tau_d[drives.rows[k]];
    double second = gain * set.u_max[drives.columns[k]] - program.tau_d[drives.rows[k]];
    if (std::abs(slope) < 1e-14) {
      const bool holds = std::min(first, second) <= 0 && std::max(first, second) >= 0;
      if (!holds) low = kInfinity;
      continue;
    }
    first /= slope;
    second /= slope;
    low = std::max(low, std::min(first, second));
    high = std::min(high, std::max(first, second));
  }
  // Lower bounds must not be infinity, so crossing bounds get finite numbers.
  if (low == kInfinity) low = high + 1;
  const int m = static_cast<int>(drives.other_columns.size());
  MatrixXd A(drives.other_rows.size(), m + 1);
  A << set.B(drives.other_rows, drives.other_columns), -program.JtW(drives.other_rows, Eigen::all);
  VectorXd l(m + 1);
  VectorXd u(m + 1);
  l << set.u_min(drives.other_columns), low;
  u << set.u_max(drives.other_columns), high;
  VectorXd c = VectorXd::Zero(m + 1);
  c[m] = program.c_w[0];
  return from_dense(A, program.tau_d(drives.other_rows), c, l, u);
}

/// w = P (B u - tau_d) with P = (J'W)^-1 over the rows without direct drive, v = B_ij u_j:
/// v - J_j'W P B u = tau_d,j - J_j'W P tau_d.
Reduced eliminate_w(const WrenchProgram& program, const DirectDrives& drives) {
  const Zonotope& set = *program.actuation;
  const MatrixXd P = pseudo_inverse(program.JtW(drives.other_rows, Eigen::all));
  const MatrixXd PB = P * set.B(drives.other_rows, drives.other_columns);
  const VectorXd Ptau = P * program.tau_d(drives.other_rows);
  const MatrixXd loads = program.JtW(drives.rows, Eigen::all);
  const auto m = static_cast<Eigen::Index>(drives.other_columns.size());
  const auto joints = static_cast<Eigen::Index>(drives.rows.size());
  MatrixXd A(joints, m + joints);
  A << -loads * PB, MatrixXd(set.B(drives.rows, drives.columns));
  VectorXd l(m + joints);
  VectorXd u(m + joints);
  l << set.u_min(drives.other_columns), set.u_min(drives.columns);
  u << set.u_max(drives.other_columns), set.u_max(drives.columns);
  VectorXd c = VectorXd::Zero(m + joints);
  c.head(m) = PB.transpose() * program.c_w;
  return {from_dense(A, program.tau_d(drives.rows) - loads * Ptau, c, l, u),
          -program.c_w.dot(Ptau)};
}

}  // namespace

const char* to_string(ProgramForm form) {
  return form == ProgramForm::kPaper ? "F1" : form == ProgramForm::kSubstituted ? "F2" : "F3";
}

Reduced reduce(const WrenchProgram& program) {
  const DirectDrives drives = direct_drives(program.actuation->B);
  if (program.columns() == 1) return {reduce_pure(program, drives), 0};
  const bool free =
      (program.w_min.array() == -kInfinity).all() && (program.w_max.array() == kInfinity).all();
  if (free && static_cast<int>(drives.other_rows.size()) == program.columns()) {
    const VectorXd gains = singular_values(program.JtW(drives.other_rows, Eigen::all));
    if (gains.minCoeff() > 1e-8 * gains.maxCoeff()) return eliminate_w(program, drives);
  }
  return {assemble(program), 0};
}

LinearProgram make_form(const WrenchProgram& program, ProgramForm form) {
  if (form == ProgramForm::kPaper) return paper_form(program);
  return form == ProgramForm::kSubstituted ? assemble(program) : reduce(program).program;
}

}  // namespace maxwrench
