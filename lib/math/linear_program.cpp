#include "maxwrench/linear_program.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lib/math/farkas.h"

namespace maxwrench {
namespace {

/// Entries of a certificate below this share of the largest count as rounding.
constexpr double kNegligible = 1e-12;

constexpr double kRayTolerance = 1e-9;

bool finite_lower(double l) { return l > -kInfiniteBound; }
bool finite_upper(double u) { return u < kInfiniteBound; }

/// Calls f(row, value) for the entries of column j. A need not be compressed.
template <class F>
void for_column(const Eigen::SparseMatrix<double>& A, int j, F&& f) {
  const int begin = A.outerIndexPtr()[j];
  const int end = A.isCompressed() ? A.outerIndexPtr()[j + 1] : begin + A.innerNonZeroPtr()[j];
  for (int k = begin; k < end; ++k) f(A.innerIndexPtr()[k], A.valuePtr()[k]);
}

/// sum = A x, size_i = max_j |a_ij x_j|.
void multiply(const Eigen::SparseMatrix<double>& A, const Eigen::VectorXd& x, LpScratch& scratch) {
  scratch.sum.setZero(A.rows());
  scratch.size.setZero(A.rows());
  for (int j = 0; j < A.cols(); ++j) {
    const double x_j = x[j];
    if (x_j == 0) continue;
    for_column(A, j, [&](int i, double a) {
      const double term = a * x_j;
      scratch.sum[i] += term;
      scratch.size[i] = std::max(scratch.size[i], std::abs(term));
    });
  }
}

/// Raises `worst` to `value`; NaN counts as infinity.
void raise(double& worst, double value) {
  if (!(value <= worst)) worst = std::isnan(value) ? kInfinity : value;
}

/// a_j'y
TermSum column_product(const LinearProgram& program, int j, const Eigen::VectorXd& y) {
  TermSum sum;
  for_column(program.A, j, [&](int i, double a) { sum.add(a * y[i]); });
  return sum;
}

void primal_residuals(const LinearProgram& program, const Eigen::VectorXd& x, LpScratch& scratch,
                      Residual& result) {
  multiply(program.A, x, scratch);
  for (int i = 0; i < program.rows(); ++i) {
    const double size = std::max(scratch.size[i], std::abs(program.b[i]));
    raise(result.balance, std::abs(scratch.sum[i] - program.b[i]) / (1 + size));
  }
  for (int j = 0; j < program.cols(); ++j) {
    if (x[j] >= program.l[j] && x[j] <= program.u[j]) continue;
    const double bound = x[j] >= program.l[j] ? program.u[j] : program.l[j];
    const double violation = std::abs(x[j] - bound);
    raise(result.bounds, violation / (1 + std::max(std::abs(bound), std::abs(x[j]))));
  }
}

void dual_residuals(const LinearProgram& program, const LpSolution& solution, Residual& result) {
  TermSum gap;
  for (int i = 0; i < program.rows(); ++i) gap.add(solution.lambda[i] * program.b[i]);
  for (int j = 0; j < program.cols(); ++j) {
    TermSum d = column_product(program, j, solution.lambda);
    d.value = -d.value;
    d.add(program.c[j]);
    gap.add(-program.c[j] * solution.x[j]);
    if (std::abs(d.value) <= kRounding * d.magnitudes) continue;
    const double bound = d.value > 0 ? program.u[j] : program.l[j];
    const bool finite = d.value > 0 ? finite_upper(bound) : finite_lower(bound);
    if (finite) {
      gap.add(d.value * bound);
    } else {
      raise(result.dual, std::abs(d.value) / (1 + d.largest));
    }
  }
  raise(result.gap, std::abs(gap.value) / (1 + gap.largest));
}

bool same_sizes(const LinearProgram& program) {
  return program.b.size() == program.rows() && program.c.size() == program.cols() &&
         program.l.size() == program.cols() && program.u.size() == program.cols();
}

bool crossing(const LinearProgram& program) {
  return (program.l.array() > program.u.array()).any();
}

bool proves_infeasible(const LinearProgram& program, const Eigen::VectorXd& y) {
  if (crossing(program)) return true;
  if (y.size() != program.rows() || !y.allFinite()) return false;
  Farkas farkas;
  for (int i = 0; i < program.rows(); ++i) farkas.add_row(y[i] * program.b[i]);
  for (int j = 0; j < program.cols(); ++j) {
    farkas.add_column(column_product(program, j, y), program.l[j], program.u[j]);
  }
  return farkas.holds();
}

bool improving_ray(const LinearProgram& program, const Eigen::VectorXd& ray, LpScratch& scratch) {
  if (ray.size() != program.cols() || !ray.allFinite()) return false;
  const double largest = ray.size() == 0 ? 0 : ray.cwiseAbs().maxCoeff();
  multiply(program.A, ray, scratch);
  for (int i = 0; i < program.rows(); ++i) {
    if (!(std::abs(scratch.sum[i]) <= kRayTolerance * scratch.size[i])) return false;
  }
  TermSum gain;
  for (int j = 0; j < program.cols(); ++j) {
    if (finite_lower(program.l[j]) && ray[j] < -kRayTolerance * largest) return false;
    if (finite_upper(program.u[j]) && ray[j] > kRayTolerance * largest) return false;
    gain.add(program.c[j] * ray[j]);
  }
  return gain.value > kRayTolerance * gain.magnitudes;
}

}  // namespace

void validate(const LinearProgram& program) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(std::string("linear program: ") + what);
  };
  require(program.b.size() == program.rows(), "b needs one entry for each row of A");
  require(program.c.size() == program.cols(), "c needs one entry for each column of A");
  require(program.l.size() == program.cols(), "l needs one entry for each column of A");
  require(program.u.size() == program.cols(), "u needs one entry for each column of A");
  const auto names_fit = [](const std::vector<std::string>& names, int count) {
    return names.empty() || static_cast<int>(names.size()) == count;
  };
  require(names_fit(program.row_names, program.rows()), "row_names is neither empty nor complete");
  require(names_fit(program.col_names, program.cols()), "col_names is neither empty nor complete");
  for (int j = 0; j < program.cols(); ++j) {
    for_column(program.A, j,
               [&](int, double a) { require(std::isfinite(a), "an entry of A is not finite"); });
    require(std::isfinite(program.c[j]), "an entry of c is not finite");
    require(program.l[j] < kInfinity, "an entry of l is NaN or +infinity");
    require(program.u[j] > -kInfinity, "an entry of u is NaN or -infinity");
  }
  require(program.b.allFinite(), "an entry of b is not finite");
}

Residual residuals(const LinearProgram& program, const LpSolution& solution, LpScratch& scratch) {
  Residual result;
  if (!same_sizes(program) || solution.x.size() != program.cols() || !solution.x.allFinite()) {
    return {kInfinity, kInfinity, kInfinity, kInfinity};
  }
  primal_residuals(program, solution.x, scratch, result);
  if (solution.lambda.size() == program.rows() && solution.lambda.allFinite()) {
    dual_residuals(program, solution, result);
  } else {
    result.dual = result.gap = kInfinity;
  }
  return result;
}

Residual residuals(const LinearProgram& program, const LpSolution& solution) {
  LpScratch scratch;
  return residuals(program, solution, scratch);
}

bool verified(const LinearProgram& program, const LpSolution& solution, double tolerance,
              LpScratch& scratch) {
  if (!same_sizes(program)) return false;
  if (solution.status == Status::kOptimal) {
    if (crossing(program)) return false;
    return residuals(program, solution, scratch).within(tolerance);
  }
  if (solution.status == Status::kInfeasible) {
    return proves_infeasible(program, solution.certificate);
  }
  if (solution.status == Status::kUnbounded) {
    if (solution.x.size() != program.cols() || !solution.x.allFinite()) return false;
    Residual r;
    primal_residuals(program, solution.x, scratch, r);
    return r.within(tolerance) && improving_ray(program, solution.certificate, scratch);
  }
  return false;
}

bool verified(const LinearProgram& program, const LpSolution& solution, double tolerance) {
  LpScratch scratch;
  return verified(program, solution, tolerance, scratch);
}

void drop_rounding(Eigen::VectorXd& certificate) {
  if (certificate.size() == 0) return;
  const double smallest = kNegligible * certificate.cwiseAbs().maxCoeff();
  for (double& entry : certificate) {
    if (std::abs(entry) < smallest) entry = 0;
  }
}

}  // namespace maxwrench
