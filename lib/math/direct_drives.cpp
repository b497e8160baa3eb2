#include "lib/math/direct_drives.h"

namespace maxwrench {

DirectDrives direct_drives(const Eigen::MatrixXd& B) {
  DirectDrives drives;
  std::vector<char> driven(static_cast<std::size_t>(B.cols()), 0);
  for (int i = 0; i < B.rows(); ++i) {
    int column = -1;
    for (int j = 0; j < B.cols(); ++j) {
      const bool alone = B(i, j) != 0 && (B.row(i).array() != 0).count() == 1 &&
                         (B.col(j).array() != 0).count() == 1;
      if (alone) column = j;
    }
    if (column < 0) {
      drives.other_rows.push_back(i);
      continue;
    }
    drives.rows.push_back(i);
    drives.columns.push_back(column);
    driven[static_cast<std::size_t>(column)] = 1;
  }
  for (int j = 0; j < B.cols(); ++j) {
    if (!driven[static_cast<std::size_t>(j)]) drives.other_columns.push_back(j);
  }
  return drives;
}

}  // namespace maxwrench
