#include <Eigen/Dense>

/// The sum of the squares of size x size ones, by a product that is too large for the stack.
double plain(int size) {
  const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(size, size);
  Eigen::MatrixXd product = ones * ones;
  product.conservativeResize(size, size + 1);
  return product.leftCols(size).sum() / size;
}
