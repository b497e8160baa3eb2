#include "solvers/wrench/elimination.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "solvers/wrench/padded.h"

namespace maxwrench {
namespace {

/// Smaller pivots, relative to the largest entry, make J_b'W near singular.
constexpr double kSingular = 1e-7;

/// Above this, P is accurate enough that its products need no refinement.
constexpr double kWellConditioned = 1e-2;

/// A diagonal entry of at least this share of its column is accepted as pivot.
constexpr double kDiagonal = 0.1;

bool first_free(const WrenchProgram& program, int k) {
  for (int j = 0; j < k; ++j) {
    if (program.w_min[j] > -kInfinity || program.w_max[j] < kInfinity) return false;
  }
  return true;
}

}  // namespace

void Elimination::split(const Eigen::MatrixXd& B) {
  B_ = B;
  drives_ = direct_drives(B);
  const auto m = static_cast<Eigen::Index>(drives_.other_columns.size());
  const auto k = static_cast<Eigen::Index>(drives_.other_rows.size());
  if (k > 6) return;  // no program has this form
  extra_ = 0;
  B_b_.setZero(6, padded(static_cast<int>(m)));
  B_b_.topLeftCorner(k, m) = B(drives_.other_rows, drives_.other_columns);
  row_.resize(B_b_.cols());
}

/// Appends the wrench columns that are not eliminated, after the thrusters.
void Elimination::append(const WrenchProgram& program) {
  const int m = static_cast<int>(drives_.other_columns.size());
  const int k = static_cast<int>(drives_.other_rows.size());
  const int extra = program.columns() - k;
  if (extra != extra_) {
    extra_ = extra;
    const Eigen::MatrixXd thrust = B_b_.leftCols(m);
    B_b_.setZero(6, padded(m + extra));
    B_b_.leftCols(m) = thrust;
    row_.resize(B_b_.cols());
  }
  for (int j = 0; j < extra; ++j) {
    for (int i = 0; i < k; ++i) B_b_(i, m + j) = -program.JtW(drives_.other_rows[i], k + j);
  }
}

/// P by Gauss-Jordan elimination in place.
bool Elimination::invert(const WrenchProgram& program) {
  const int k = static_cast<int>(drives_.other_rows.size());
  Square A = Square::Identity();
  double largest = 0;
  for (int j = 0; j < k; ++j) {
    for (int i = 0; i < k; ++i) {
      A(i, j) = program.JtW(drives_.other_rows[i], j);
      largest = std::max(largest, std::abs(A(i, j)));
    }
  }
  int exchanged[6];
  steps_ = 1;
  for (int step = 0; step < 6; ++step) {  // the identity beyond k
    double best = 0;
    for (int i = step; i < 6; ++i) best = std::max(best, std::abs(A(i, step)));
    if (step < k && !(best > kSingular * largest)) return false;
    if (!(best > kWellConditioned * largest)) steps_ = 2;
    // A search for the largest entry needs a conditional jump that processors mispredict, so rows
    // are exchanged only if the pivot is bad.
    int pivot = step;
    if (std::abs(A(step, step)) < kDiagonal * best) {
      while (std::abs(A(pivot, step)) != best) ++pivot;
      A.row(step).swap(A.row(pivot));
    }
    exchanged[step] = pivot;
    const double inverse = 1 / A(step, step);
    A.row(step) *= inverse;
    // Column `step` is written last: a processor stalls if it loads two entries just after one of
    // them was stored.
    for (int i = 0; i < 6; ++i) {
      if (i == step) continue;
      const double factor = A(i, step);
      A.row(i) -= factor * A.row(step);
      A(i, step) = -factor * inverse;
    }
    A(step, step) = inverse;
  }
  for (int step = 6; step-- > 0;) {
    if (exchanged[step] != step) A.col(step).swap(A.col(exchanged[step]));
  }
  P_ = A;
  return true;
}

/// row = (P'p)'B_b; returns (P'p)'tau_b.
double Elimination::combine(const Vector6d& p, double* row) const {
  const Vector6d left = P_.transpose() * p;
  with_length(static_cast<int>(B_b_.cols()), [&](auto width) {
    constexpr int kSize = kLanes<decltype(width)>;
    for (int j = 0; j < width; j += kSize) {
      double sum[kSize] = {};
      const double* b = B_b_.data() + j;
      for (int i = 0; i < 6; ++i, b += width) {
        for (int pack = 0; pack < kSize; ++pack) sum[pack] += left[i] * b[pack];
      }
      for (int pack = 0; pack < kSize; ++pack) row[j + pack] = sum[pack];
    }
  });
  return left.dot(tau_b_);
}

/// v_j = tau_j - (J_j'W P) tau_b + (J_j'W P B_b) u_b between the limits of b_j u_j.
void Elimination::add_joint(const WrenchProgram& program, int joint, Tableau& tableau) {
  const Zonotope& set = *program.actuation;
  const int row = drives_.rows[joint];
  const int drive = drives_.columns[joint];
  Vector6d p = Vector6d::Zero();
  const int k = static_cast<int>(drives_.other_rows.size());
  for (int i = 0; i < k; ++i) p[i] = program.JtW(row, i);
  double* const entries = tableau.row(joint);
  const double offset = program.tau_d[row] - combine(p, entries);
  const int m = static_cast<int>(drives_.other_columns.size());
  for (int j = 0; j < extra_; ++j) entries[m + j] += program.JtW(row, k + j);
  const double gain = set.B(row, drive);
  const double first = gain * set.u_min[drive];
  const double second = gain * set.u_max[drive];
  tableau.low[joint] = std::min(first, second) - offset;
  tableau.high[joint] = std::max(first, second) - offset;
}

bool Elimination::load(const WrenchProgram& program, Tableau& tableau) {
  const Zonotope& set = *program.actuation;
  const std::size_t bytes = sizeof(double) * static_cast<std::size_t>(set.B.size());
  const bool known = B_.rows() == set.B.rows() && B_.cols() == set.B.cols() &&
                     std::memcmp(B_.data(), set.B.data(), bytes) == 0;
  if (!known) split(set.B);
  const int k = static_cast<int>(drives_.other_rows.size());
  const int m = static_cast<int>(drives_.other_columns.size());
  const int f = static_cast<int>(drives_.rows.size());
  if (k == 0 || k > 6 || m == 0 || k > program.columns()) return false;
  if (k < program.columns() && program.W.cols() == program.columns()) return false;
  if (!first_free(program, k)) return false;
  append(program);
  if (!invert(program)) return false;
  tableau.resize(f, m + extra_);
  tau_b_.setZero();
  for (int i = 0; i < k; ++i) tau_b_[i] = program.tau_d[drives_.other_rows[i]];
  for (int joint = 0; joint < f; ++joint) add_joint(program, joint, tableau);
  Vector6d c = Vector6d::Zero();
  c.head(k) = program.c_w.head(k);
  combine(c, row_.data());
  tableau.c = row_.head(m + extra_);
  tableau.c.tail(extra_) += program.c_w.tail(extra_);
  for (int j = 0; j < m; ++j) {
    tableau.low[f + j] = set.u_min[drives_.other_columns[j]];
    tableau.high[f + j] = set.u_max[drives_.other_columns[j]];
  }
  tableau.low.tail(extra_) = program.w_min.tail(extra_);
  tableau.high.tail(extra_) = program.w_max.tail(extra_);
  return true;
}

void Elimination::fill_lambda(const WrenchProgram& program, const Tableau& tableau, double c_share,
                              Eigen::VectorXd& lambda) const {
  const int k = static_cast<int>(drives_.other_rows.size());
  lambda.setZero(program.tau_d.size());
  for (std::size_t joint = 0; joint < drives_.rows.size(); ++joint) {
    lambda[drives_.rows[joint]] = -tableau.multipliers[static_cast<Eigen::Index>(joint)];
  }
  for (int step = 0; step < steps_; ++step) {
    // The residual of c_w + (J'W)'lambda; in the first step, the base must compensate all of it.
    // Most joints are not at their limits.
    Vector6d left = Vector6d::Zero();
    for (int j = 0; j < k; ++j) left[j] = c_share * program.c_w[j];
    const Eigen::Index n = program.tau_d.size();
    for (Eigen::Index i = 0; i < n; ++i) {
      if (lambda[i] == 0) continue;
      const double* const row = program.JtW.data() + i;
      for (int j = 0; j < k; ++j) left[j] += row[j * n] * lambda[i];
    }
    const Vector6d base = P_.transpose() * left;
    for (int i = 0; i < k; ++i) lambda[drives_.other_rows[i]] -= base[i];
  }
}

void Elimination::fill_contradiction(const WrenchProgram& program, const Tableau& tableau,
                                     Eigen::VectorXd& y) const {
  fill_lambda(program, tableau, 0, y);
  y = -y;
}

void Elimination::fill(const WrenchProgram& program, const Tableau& tableau, bool efforts,
                       Capability& capability) {
  const int k = static_cast<int>(drives_.other_rows.size());
  const int m = static_cast<int>(drives_.other_columns.size());
  const int f = static_cast<int>(drives_.rows.size());
  // w = P (B_b u_b - tau_b), refined if necessary; row i of `load` is that of the balance.
  Vector6d load = -tau_b_;
  for (int i = 0; i < k; ++i) {
    for (int j = 0; j < m + extra_; ++j) load[i] += B_b_(i, j) * tableau.x[j];
  }
  Vector6d w = P_ * load;
  if (steps_ > 1) {
    for (int j = 0; j < k; ++j) {
      for (int i = 0; i < k; ++i) load[i] -= program.JtW(drives_.other_rows[i], j) * w[j];
    }
    w += P_ * load;
  }
  capability.w.resize(program.columns());
  capability.w.head(k) = w.head(k);
  capability.w.tail(extra_) = tableau.x.tail(extra_);
  fill_lambda(program, tableau, 1, capability.lambda);
  capability.beta = program.c_w.dot(capability.w);
  if (!efforts) return;
  capability.u.setZero(program.actuation->actuators());
  for (int j = 0; j < m; ++j) capability.u[drives_.other_columns[j]] = tableau.x[j];
  for (int joint = 0; joint < f; ++joint) {
    const int row = drives_.rows[joint];
    capability.u[drives_.columns[joint]] =
        (program.tau_d[row] + program.JtW.row(row).dot(capability.w)) /
        program.actuation->B(row, drives_.columns[joint]);
  }
}

}  // namespace maxwrench
