#pragma once

#include "maxwrench/types.h"

// Dense decompositions. Eigen's templates for them take longer to compile than most files that use
// them, so they are compiled once, here.

namespace maxwrench {

/// Matrices of up to six rows and columns are on the stack. Functions that take or return them
/// allocate nothing unless A is rank deficient.
using Matrix6N = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 6, 6>;
using Vector6N = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 6, 1>;

/// A^+ b for matrices A r×d, r and d <= 6, by Householder reflections with column pivoting.
class LeastSquares6 {
 public:
  LeastSquares6() = default;
  explicit LeastSquares6(const Matrix6N& A) { compute(A); }

  void compute(const Matrix6N& A) { qr_.compute(A); }
  /// Whether a pivot is smaller than `threshold` times the largest pivot.
  bool is_singular(double threshold) const;
  /// b with r rows -> A^+ b with d rows.
  Vector6N solve(const Vector6N& b) const;
  /// b with d rows -> (A')^+ b with r rows.
  Vector6N solve_transposed(const Vector6N& b) const;

 private:
  Eigen::CompleteOrthogonalDecomposition<Matrix6N> qr_;
};

/// [m; rad] Residuals of a pose. Below `kArrived` Newton's method has converged; one more step must
/// then reach `kExact`.
inline constexpr double kArrived = 1e-9;
inline constexpr double kExact = 1e-12;

/// J_d (6×d, the dependent columns of J) is singular if a pivot of its QR decomposition is below
/// this share of the largest pivot.
inline constexpr double kSingularShare = 1e-4;

/// The Levenberg-Marquardt step (A'A + damping I)^-1 A'b; A r×d, r and d <= 6, damping > 0.
Vector6N damped_step(const Matrix6N& A, const Vector6N& b, double damping);

/// Orthonormal columns: `range` spans the column space of a matrix, `complement` its orthogonal
/// complement.
struct Split {
  Eigen::MatrixXd range, complement;
};

/// Pivots below `threshold` times the largest count as zero. At -1 the threshold is that of
/// rounding.
Split split(const Eigen::MatrixXd& A, double threshold = -1);

/// The Moore-Penrose inverse A^+.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& A);

/// A = U S V', A m×n: U m×m, V n×n, and the diagonal of S in decreasing order.
struct Svd {
  Eigen::MatrixXd U;
  Eigen::VectorXd values;
  Eigen::MatrixXd V;

  /// The number of singular values above this share of the largest.
  Eigen::Index rank(double threshold) const;
};

Svd svd(const Eigen::MatrixXd& A);

/// In decreasing order.
Eigen::VectorXd singular_values(const Eigen::MatrixXd& A);

/// A = V diag(values) V', the values in increasing order.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd V;
};

SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& A);

}  // namespace maxwrench
