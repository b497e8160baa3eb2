#include "lib/linear_program.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace maxwrench {
namespace {

/// Entries of a certificate below this share of the largest are rounding.
constexpr double kNegligible = 1e-12;

constexpr double kInfiniteBound = 1e20;
constexpr double kRounding = 64 * std::numeric_limits<double>::epsilon();
constexpr double kFarkasMargin = 1e-10;
constexpr double kRayTolerance = 1e-9;

bool finite_lower(double l) { return l > -kInfiniteBound; }
bool finite_upper(double u) { return u < kInfiniteBound; }

/// Calls f(row, value) for the entries of column j; A need not be compressed.
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

struct Sum {
  double value = 0;
  double magnitudes = 0;
  double largest = 0;
  void add(double term) {
    const double magnitude = std::abs(term);
    value += term;
    magnitudes += magnitude;
    largest = std::max(largest, magnitude);
  }
};

/// a_j'y
Sum column_product(const LinearProgram& program, int j, const Eigen::VectorXd& y) {
  Sum sum;
  for_column(program.A, j, [&](int i, double a) { sum.add(a * y[i]); });
  return sum;
}

void primal_residuals(const LinearProgram& program, const Eigen::VectorXd& x, LpScratch& scratch,
                      LpResiduals& result) {
  multiply(program.A, x, scratch);
  for (int i = 0; i < program.rows(); ++i) {
    const double size = std::max(scratch.size[i], std::abs(program.b[i]));
    const double residual = std::abs(scratch.sum[i] - program.b[i]) / (1 + size);
    if (!(residual <= result.row)) result.row = residual;
  }
  for (int j = 0; j < program.cols(); ++j) {
    const double below = program.l[j] - x[j], above = x[j] - program.u[j];
    const double violation = std::max(below, above);
    if (violation <= 0) continue;
    const double bound = below > above ? program.l[j] : program.u[j];
    const double residual = violation / (1 + std::max(std::abs(bound), std::abs(x[j])));
    if (!(residual <= result.bound)) result.bound = residual;
  }
}

void dual_residuals(const LinearProgram& program, const LpSolution& solution, LpResiduals& result) {
  Sum gap;
  for (int i = 0; i < program.rows(); ++i) gap.add(solution.lambda[i] * program.b[i]);
  for (int j = 0; j < program.cols(); ++j) {
    Sum d = column_product(program, j, solution.lambda);
    d.value = -d.value;
    d.add(program.c[j]);
    gap.add(-program.c[j] * solution.x[j]);
    if (std::abs(d.value) <= kRounding * d.magnitudes) continue;
    const double bound = d.value > 0 ? program.u[j] : program.l[j];
    const bool finite = d.value > 0 ? finite_upper(bound) : finite_lower(bound);
    if (finite) {
      gap.add(d.value * bound);
    } else {
      const double residual = std::abs(d.value) / (1 + d.largest);
      if (!(residual <= result.reduced_cost)) result.reduced_cost = residual;
    }
  }
  result.gap = std::abs(gap.value) / (1 + gap.largest);
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
  Sum margin;  // y'b - sup
  for (int i = 0; i < program.rows(); ++i) margin.add(y[i] * program.b[i]);
  for (int j = 0; j < program.cols(); ++j) {
    const Sum d = column_product(program, j, y);
    if (std::abs(d.value) <= kRounding * d.magnitudes) continue;
    const double bound = d.value > 0 ? program.u[j] : program.l[j];
    if (d.value > 0 ? finite_upper(bound) : finite_lower(bound)) {
      margin.add(-d.value * bound);
    } else if (std::abs(d.value) > kFarkasMargin * d.magnitudes) {
      return false;
    }
  }
  return margin.value > kFarkasMargin * margin.magnitudes;
}

bool improving_ray(const LinearProgram& program, const Eigen::VectorXd& ray, LpScratch& scratch) {
  if (ray.size() != program.cols() || !ray.allFinite()) return false;
  const double largest = ray.size() == 0 ? 0 : ray.cwiseAbs().maxCoeff();
  multiply(program.A, ray, scratch);
  for (int i = 0; i < program.rows(); ++i) {
    if (std::abs(scratch.sum[i]) > kRayTolerance * scratch.size[i]) return false;
  }
  Sum gain;
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

LpResiduals residuals(const LinearProgram& program, const LpSolution& solution,
                      LpScratch& scratch) {
  LpResiduals result;
  if (!same_sizes(program) || solution.x.size() != program.cols() || !solution.x.allFinite()) {
    return {kInfinity, kInfinity, kInfinity, kInfinity};
  }
  primal_residuals(program, solution.x, scratch, result);
  if (solution.lambda.size() == program.rows() && solution.lambda.allFinite()) {
    dual_residuals(program, solution, result);
  } else {
    result.reduced_cost = result.gap = kInfinity;
  }
  return result;
}

LpResiduals residuals(const LinearProgram& program, const LpSolution& solution) {
  LpScratch scratch;
  return residuals(program, solution, scratch);
}

bool verified(const LinearProgram& program, const LpSolution& solution, double tolerance,
              LpScratch& scratch) {
  if (!same_sizes(program)) return false;
  if (solution.status == Status::kOptimal) {
    if (crossing(program)) return false;
    const LpResiduals r = residuals(program, solution, scratch);
    return r.row <= tolerance && r.bound <= tolerance && r.reduced_cost <= tolerance &&
           r.gap <= tolerance;
  }
  if (solution.status == Status::kInfeasible) {
    return proves_infeasible(program, solution.certificate);
  }
  if (solution.status == Status::kUnbounded) {
    if (solution.x.size() != program.cols() || !solution.x.allFinite()) return false;
    LpResiduals r;
    primal_residuals(program, solution.x, scratch, r);
    return r.row <= tolerance && r.bound <= tolerance &&
           improving_ray(program, solution.certificate, scratch);
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
