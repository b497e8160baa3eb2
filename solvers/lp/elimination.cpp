#include "solvers/lp/elimination.h"

#include <algorithm>
#include <cmath>

namespace maxwrench {
namespace {

/// Smaller pivots, relative to the largest entry, make J_b'W near singular.
constexpr double kSingular = 1e-7;

bool all_free(const WrenchProgram& program) {
  for (int j = 0; j < program.columns(); ++j) {
    if (program.w_min[j] > -kInfinity || program.w_max[j] < kInfinity) return false;
  }
  return true;
}

}  // namespace

void Elimination::split(const Eigen::MatrixXd& B) {
  B_ = B;
  driven_rows_.clear();
  drives_.clear();
  base_rows_.clear();
  thrusters_.clear();
  std::vector<char> is_drive(B.cols(), 0);
  for (int i = 0; i < B.rows(); ++i) {
    int drive = -1;
    for (int j = 0; j < B.cols(); ++j) {
      if (B(i, j) != 0 && (B.row(i).array() != 0).count() == 1 &&
          (B.col(j).array() != 0).count() == 1) {
        drive = j;
      }
    }
    if (drive < 0) {
      base_rows_.push_back(i);
      continue;
    }
    driven_rows_.push_back(i);
    drives_.push_back(drive);
    is_drive[drive] = 1;
  }
  for (int j = 0; j < B.cols(); ++j) {
    if (!is_drive[j]) thrusters_.push_back(j);
  }
  B_b_ = B(base_rows_, thrusters_);
}

/// P by elimination on [J_b'W, I] with row exchanges.
bool Elimination::invert(const WrenchProgram& program) {
  const int k = program.columns();
  RowMajor& A = elimination_;
  A.resize(k, 2 * k);
  double largest = 0;
  for (int i = 0; i < k; ++i) {
    for (int j = 0; j < k; ++j) {
      A(i, j) = program.JtW(base_rows_[i], j);
      A(i, k + j) = i == j;
      largest = std::max(largest, std::abs(A(i, j)));
    }
  }
  for (int step = 0; step < k; ++step) {
    int pivot = step;
    for (int i = step + 1; i < k; ++i) {
      if (std::abs(A(i, step)) > std::abs(A(pivot, step))) pivot = i;
    }
    if (!(std::abs(A(pivot, step)) > kSingular * largest)) return false;
    double* const row = &A(step, 0);
    if (pivot != step) std::swap_ranges(row, row + 2 * k, &A(pivot, 0));
    const double inverse = 1 / row[step];
    for (int j = step; j < 2 * k; ++j) row[j] *= inverse;
    for (int i = 0; i < k; ++i) {
      double* const other = &A(i, 0);
      const double factor = other[step];
      if (i == step || factor == 0) continue;
      for (int j = step; j < 2 * k; ++j) other[j] -= factor * row[j];
    }
  }
  P_.resize(k, k);
  for (int i = 0; i < k; ++i) {
    for (int j = 0; j < k; ++j) P_(i, j) = A(i, k + j);
  }
  return true;
}

bool Elimination::load(const WrenchProgram& program, Tableau& tableau) {
  const Zonotope& set = *program.actuation;
  const bool known = B_.rows() == set.B.rows() && B_.cols() == set.B.cols() &&
                     std::equal(B_.data(), B_.data() + B_.size(), set.B.data());
  if (!known) split(set.B);
  const int k = program.columns();
  const int m = static_cast<int>(thrusters_.size());
  const int f = static_cast<int>(driven_rows_.size());
  if (k == 0 || m == 0 || k != static_cast<int>(base_rows_.size())) return false;
  if (!all_free(program) || !invert(program)) return false;
  tableau.resize(f, m);
  base_row_.resize(k);
  row_.resize(m);
  // p = (left) P, then p B_b: for each joint's row of J'W, and last for the objective.
  for (int joint = 0; joint <= f; ++joint) {
    base_row_.setZero();
    for (int i = 0; i < k; ++i) {
      const double left = joint < f ? program.JtW(driven_rows_[joint], i) : program.c_w[i];
      if (left == 0) continue;
      const double* const p = &P_(i, 0);
      for (int j = 0; j < k; ++j) base_row_[j] += left * p[j];
    }
    row_.setZero();
    double offset = 0;
    for (int i = 0; i < k; ++i) {
      const double* const b = &B_b_(i, 0);
      for (int j = 0; j < m; ++j) row_[j] += base_row_[i] * b[j];
      offset -= base_row_[i] * program.tau_d[base_rows_[i]];
    }
    if (joint == f) {
      tableau.c = row_;
      break;
    }
    for (int j = 0; j < m; ++j) tableau.entry(joint, j) = row_[j];
    offset += program.tau_d[driven_rows_[joint]];
    const int drive = drives_[joint];
    const double gain = set.B(driven_rows_[joint], drive);
    const double first = gain * set.u_min[drive];
    const double second = gain * set.u_max[drive];
    tableau.low[joint] = std::min(first, second) - offset;
    tableau.high[joint] = std::max(first, second) - offset;
  }
  for (int j = 0; j < m; ++j) {
    tableau.low[f + j] = set.u_min[thrusters_[j]];
    tableau.high[f + j] = set.u_max[thrusters_[j]];
  }
  return true;
}

void Elimination::fill(const WrenchProgram& program, const Tableau& tableau, bool efforts,
                       Capability& capability) {
  const int k = program.columns();
  const int m = static_cast<int>(thrusters_.size());
  const int f = static_cast<int>(driven_rows_.size());
  // w = P (B_b u_b - tau_b), with one step of refinement.
  tau_b_.resize(k);
  for (int i = 0; i < k; ++i) {
    tau_b_[i] = -program.tau_d[base_rows_[i]];
    const double* const b = &B_b_(i, 0);
    for (int j = 0; j < m; ++j) tau_b_[i] += b[j] * tableau.w[j];
  }
  capability.w.setZero(k);
  capability.lambda.setZero(program.tau_d.size());
  for (int step = 0; step < 2; ++step) {
    for (int i = 0; i < k; ++i) {
      double left = tau_b_[i];
      for (int j = 0; step > 0 && j < k; ++j) {
        left -= program.JtW(base_rows_[i], j) * capability.w[j];
      }
      base_row_[i] = left;
    }
    for (int i = 0; i < k; ++i) {
      const double* const p = &P_(i, 0);
      for (int j = 0; j < k; ++j) capability.w[i] += p[j] * base_row_[j];
    }
  }
  for (int i = 0; i < m; ++i) {
    if (tableau.basis[i] < f) capability.lambda[driven_rows_[tableau.basis[i]]] = -tableau.y[i];
  }
  for (int step = 0; step < 2; ++step) {
    // base_row_ = c_w + (J'W)'lambda; at the first step the base's lambda is zero.
    for (int j = 0; j < k; ++j) {
      const double* const column = program.JtW.data() + j * program.JtW.rows();
      double left = program.c_w[j];
      for (Eigen::Index i = 0; i < program.tau_d.size(); ++i) {
        left += column[i] * capability.lambda[i];
      }
      base_row_[j] = left;
    }
    for (int j = 0; j < k; ++j) {
      const double* const p = &P_(j, 0);
      for (int i = 0; i < k; ++i) capability.lambda[base_rows_[i]] -= p[i] * base_row_[j];
    }
  }
  capability.beta = program.c_w.dot(capability.w);
  if (!efforts) return;
  capability.u.setZero(program.actuation->actuators());
  for (int j = 0; j < m; ++j) capability.u[thrusters_[j]] = tableau.w[j];
  for (int joint = 0; joint < f; ++joint) {
    const int row = driven_rows_[joint];
    capability.u[drives_[joint]] = (program.tau_d[row] + program.JtW.row(row).dot(capability.w)) /
                                   program.actuation->B(row, drives_[joint]);
  }
}

}  // namespace maxwrench
