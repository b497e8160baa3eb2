#include "lib/math/decompositions.h"

#include <Eigen/Eigenvalues>

namespace maxwrench {

using Eigen::MatrixXd;

bool LeastSquares6::is_singular(double threshold) const {
  const auto pivots = qr_.matrixQTZ().diagonal().cwiseAbs();
  return pivots.size() > 0 && !(pivots.minCoeff() >= threshold * pivots.maxCoeff());
}

Vector6N LeastSquares6::solve(const Vector6N& b) const { return qr_.solve(b); }

Vector6N LeastSquares6::solve_transposed(const Vector6N& b) const {
  return qr_.transpose().solve(b);
}

Vector6N damped_step(const Matrix6N& A, const Vector6N& b, double damping) {
  Matrix6N normal = A.transpose().lazyProduct(A);
  normal.diagonal().array() += damping;
  return normal.ldlt().solve(Vector6N(A.transpose().lazyProduct(b)));
}

Split split(const MatrixXd& A, double threshold) {
  if (A.cols() == 0) return {A, MatrixXd::Identity(A.rows(), A.rows())};
  Eigen::ColPivHouseholderQR<MatrixXd> qr(A.rows(), A.cols());
  if (threshold >= 0) qr.setThreshold(threshold);
  qr.compute(A);
  const MatrixXd Q = qr.householderQ();
  return {Q.leftCols(qr.rank()), Q.rightCols(Q.cols() - qr.rank())};
}

MatrixXd pseudo_inverse(const MatrixXd& A) {
  return Eigen::CompleteOrthogonalDecomposition<MatrixXd>(A).pseudoInverse();
}

Svd svd(const MatrixXd& A) {
  const Eigen::JacobiSVD<MatrixXd> found(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {found.matrixU(), found.singularValues(), found.matrixV()};
}

Eigen::Index Svd::rank(double threshold) const {
  return values.size() == 0 || values[0] == 0 ? 0
                                              : (values.array() >= threshold * values[0]).count();
}

Eigen::VectorXd singular_values(const MatrixXd& A) {
  return Eigen::JacobiSVD<MatrixXd>(A).singularValues();
}

SymmetricEigen symmetric_eigen(const MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(A);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

}  // namespace maxwrench
