#include "solvers/lp/elimination.h"

#include <algorithm>
#include <cmath>

namespace maxwrench {
namespace {

/// Smaller pivots, relative to the largest entry, make J_b'W near singular.
constexpr double kSingular = 1e-7;

/// A diagonal entry of at least this share of its column serves as pivot.
constexpr double kDiagonal = 0.1;

constexpr int kChunk = 4;

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
  const auto m = static_cast<Eigen::Index>(thrusters_.size());
  const auto k = static_cast<Eigen::Index>(base_rows_.size());
  if (k > 6) return;  // no program is of this kind
  B_b_.setZero(6, (m + kChunk - 1) / kChunk * kChunk);
  B_b_.topLeftCorner(k, m) = B(base_rows_, thrusters_);
  row_.resize(B_b_.cols());
}

/// P by Gauss-Jordan elimination on [J_b'W, I].
bool Elimination::invert(const WrenchProgram& program) {
  const int k = program.columns();
  Eigen::Matrix<double, 6, 12, Eigen::RowMajor> A;
  A << Square::Identity(), Square::Identity();
  double largest = 0;
  for (int j = 0; j < k; ++j) {
    for (int i = 0; i < k; ++i) {
      A(i, j) = program.JtW(base_rows_[i], j);
      largest = std::max(largest, std::abs(A(i, j)));
    }
  }
  for (int step = 0; step < k; ++step) {
    double best = 0;
    for (int i = step; i < k; ++i) best = std::max(best, std::abs(A(i, step)));
    if (!(best > kSingular * largest)) return false;
    // A search for the largest entry is a branch that no processor foresees; exchange only what is
    // bad.
    int pivot = step;
    if (std::abs(A(step, step)) < kDiagonal * best) {
      while (std::abs(A(pivot, step)) != best) ++pivot;
      A.row(step).swap(A.row(pivot));
    }
    A.row(step) *= 1 / A(step, step);
    for (int i = 0; i < k; ++i) {
      if (i != step) A.row(i) -= A(i, step) * A.row(step);
    }
  }
  P_ = A.rightCols<6>();
  return true;
}

/// row_ = (P'p)'B_b; returns (P'p)'tau_b.
double Elimination::combine(const Vector6d& p) {
  const Vector6d left = P_.transpose() * p;
  const Eigen::Index width = row_.size();
  for (Eigen::Index j = 0; j < width; j += kChunk) {
    double sum[kChunk] = {};
    const double* b = B_b_.data() + j;
    for (int i = 0; i < 6; ++i, b += width) {
      for (int lane = 0; lane < kChunk; ++lane) sum[lane] += left[i] * b[lane];
    }
    for (int lane = 0; lane < kChunk; ++lane) row_[j + lane] = sum[lane];
  }
  return left.dot(tau_b_);
}

/// v_j = tau_j - (J_j'W P) tau_b + (J_j'W P B_b) u_b between the limits of b_j u_j.
void Elimination::add_joint(const WrenchProgram& program, int joint, Tableau& tableau) {
  const Zonotope& set = *program.actuation;
  const int row = driven_rows_[joint];
  const int drive = drives_[joint];
  Vector6d p = Vector6d::Zero();
  for (int i = 0; i < program.columns(); ++i) p[i] = program.JtW(row, i);
  const double offset = program.tau_d[row] - combine(p);
  for (std::size_t j = 0; j < thrusters_.size(); ++j) {
    tableau.entry(joint, static_cast<int>(j)) = row_[static_cast<Eigen::Index>(j)];
  }
  const double gain = set.B(row, drive);
  const double first = gain * set.u_min[drive];
  const double second = gain * set.u_max[drive];
  tableau.low[joint] = std::min(first, second) - offset;
  tableau.high[joint] = std::max(first, second) - offset;
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
  tau_b_.setZero();
  for (int i = 0; i < k; ++i) tau_b_[i] = program.tau_d[base_rows_[i]];
  for (int joint = 0; joint < f; ++joint) add_joint(program, joint, tableau);
  Vector6d c = Vector6d::Zero();
  c.head(k) = program.c_w;
  combine(c);
  tableau.c = row_.head(m);
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
  // w = P (B_b u_b - tau_b), with one step of refinement; row i of `load` is that of the balance.
  Vector6d load = -tau_b_;
  for (int i = 0; i < k; ++i) {
    for (int j = 0; j < m; ++j) load[i] += B_b_(i, j) * tableau.w[j];
  }
  Vector6d w = P_ * load;
  for (int j = 0; j < k; ++j) {
    for (int i = 0; i < k; ++i) load[i] -= program.JtW(base_rows_[i], j) * w[j];
  }
  w += P_ * load;
  capability.w = w.head(k);
  capability.lambda.setZero(program.tau_d.size());
  for (int i = 0; i < m; ++i) {
    if (tableau.basis[i] < f) capability.lambda[driven_rows_[tableau.basis[i]]] = -tableau.y[i];
  }
  for (int step = 0; step < 2; ++step) {
    // What c_w + (J'W)'lambda lacks to zero, at first all that the base has to give.
    Vector6d left = Vector6d::Zero();
    left.head(k) = program.c_w;
    for (int j = 0; j < k; ++j) {
      const double* const column = program.JtW.data() + j * program.JtW.rows();
      for (Eigen::Index i = 0; i < program.tau_d.size(); ++i) {
        left[j] += column[i] * capability.lambda[i];
      }
    }
    const Vector6d base = P_.transpose() * left;
    for (int i = 0; i < k; ++i) capability.lambda[base_rows_[i]] -= base[i];
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
