#pragma once

#include <Eigen/Dense>
#include <vector>

namespace maxwrench {

/// The rows of B that have one nonzero entry, in a column that has no other (a directly driven
/// joint), each with its column; and all other rows and columns, in increasing order.
struct DirectDrives {
  std::vector<int> rows, columns, other_rows, other_columns;
};

DirectDrives direct_drives(const Eigen::MatrixXd& B);

}  // namespace maxwrench
