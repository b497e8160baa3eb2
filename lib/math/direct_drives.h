#pragma once

#include <Eigen/Dense>
#include <vector>

namespace maxwrench {

/// The rows of B that one column alone serves, which serves no other row (a directly driven joint),
/// each with its column; and all other rows and columns, in increasing order.
struct DirectDrives {
  std::vector<int> rows, columns, other_rows, other_columns;
};

DirectDrives direct_drives(const Eigen::MatrixXd& B);

}  // namespace maxwrench
