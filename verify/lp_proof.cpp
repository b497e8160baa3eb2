#include "verify/lp_proof.h"

namespace maxwrench {
namespace {

constexpr double kInfiniteBound = 1e20;

bool has_lower(const LinearProgram& p, int j) { return p.l[j] > -kInfiniteBound; }
bool has_upper(const LinearProgram& p, int j) { return p.u[j] < kInfiniteBound; }

/// Column j of A times v.
mpq_class column_times(const LinearProgram& p, int j, const RationalVector& v) {
  mpq_class sum;
  for (Eigen::SparseMatrix<double>::InnerIterator it(p.A, j); it; ++it) {
    sum += mpq_class(it.value()) * v[static_cast<std::size_t>(it.row())];
  }
  return sum;
}

/// A x - rhs, or A x if there is no `rhs`.
RationalVector balance(const LinearProgram& p, const RationalVector& x,
                       const Eigen::VectorXd* rhs) {
  RationalVector sum(static_cast<std::size_t>(p.rows()));
  if (rhs != nullptr) {
    for (std::size_t i = 0; i < sum.size(); ++i) {
      sum[i] = -mpq_class((*rhs)[static_cast<Eigen::Index>(i)]);
    }
  }
  for (int j = 0; j < p.cols(); ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(p.A, j); it; ++it) {
      sum[static_cast<std::size_t>(it.row())] +=
          mpq_class(it.value()) * x[static_cast<std::size_t>(j)];
    }
  }
  return sum;
}

bool is_zero(const RationalVector& v) {
  for (const mpq_class& each : v) {
    if (each != 0) return false;
  }
  return true;
}

std::string reject_point(const LinearProgram& p, const RationalVector& x) {
  if (!is_zero(balance(p, x, &p.b))) return "A x = b does not hold";
  for (int j = 0; j < p.cols(); ++j) {
    const mpq_class& at = x[static_cast<std::size_t>(j)];
    if ((has_lower(p, j) && at < p.l[j]) || (has_upper(p, j) && at > p.u[j])) {
      return "x violates a bound";
    }
  }
  return "";
}

std::string reject_optimum(const LinearProgram& p, const LpProof& proof) {
  for (int j = 0; j < p.cols(); ++j) {
    const mpq_class d = p.c[j] - column_times(p, j, proof.lambda);
    const mpq_class& at = proof.x[static_cast<std::size_t>(j)];
    const bool blocked =
        d == 0 || (d > 0 ? has_upper(p, j) && at == p.u[j] : has_lower(p, j) && at == p.l[j]);
    if (!blocked) return "a reduced cost improves x";
  }
  return "";
}

std::string reject_contradiction(const LinearProgram& p, const RationalVector& y) {
  for (int j = 0; j < p.cols(); ++j) {
    if (p.l[j] > p.u[j]) return "";
  }
  mpq_class most;
  for (int j = 0; j < p.cols(); ++j) {
    const mpq_class slope = column_times(p, j, y);
    if (slope == 0) continue;
    if (!(slope > 0 ? has_upper(p, j) : has_lower(p, j))) return "y'A x has no supremum";
    most += slope * (slope > 0 ? p.u[j] : p.l[j]);
  }
  mpq_class right;
  for (int i = 0; i < p.rows(); ++i) right += y[static_cast<std::size_t>(i)] * p.b[i];
  return most < right ? "" : "y'A x may be y'b";
}

std::string reject_ray(const LinearProgram& p, const RationalVector& r) {
  if (!is_zero(balance(p, r, nullptr))) return "A r = 0 does not hold";
  for (int j = 0; j < p.cols(); ++j) {
    const mpq_class& along = r[static_cast<std::size_t>(j)];
    if ((along < 0 && has_lower(p, j)) || (along > 0 && has_upper(p, j))) {
      return "the ray violates a bound";
    }
  }
  return exact_objective(p, r) > 0 ? "" : "the ray does not improve";
}

}  // namespace

mpq_class exact_objective(const LinearProgram& program, const RationalVector& x) {
  mpq_class sum;
  for (int j = 0; j < program.cols(); ++j) sum += program.c[j] * x[static_cast<std::size_t>(j)];
  return sum;
}

std::string reject_lp_proof(const LinearProgram& program, const LpProof& proof) {
  const auto rows = static_cast<std::size_t>(program.rows());
  const auto cols = static_cast<std::size_t>(program.cols());
  const bool infeasible = proof.status == Status::kInfeasible;
  const bool optimal = proof.status == Status::kOptimal;
  if (!infeasible && !optimal && proof.status != Status::kUnbounded)
    return "its status is not a verdict";
  if (infeasible ? proof.certificate.size() != rows
                 : proof.x.size() != cols ||
                       (optimal ? proof.lambda.size() != rows : proof.certificate.size() != cols)) {
    return "its sizes are not those of the program";
  }
  if (infeasible) return reject_contradiction(program, proof.certificate);
  const std::string rejection = reject_point(program, proof.x);
  if (!rejection.empty()) return rejection;
  return optimal ? reject_optimum(program, proof) : reject_ray(program, proof.certificate);
}

}  // namespace maxwrench
