#pragma once

#include <string>

#include "maxwrench/motion_table.h"

namespace maxwrench {

/// The coordinates of a table and their derivatives at all instants, K instants of d coordinates.
struct CoordinateSeries {
  std::vector<double> t;                         ///< (K)
  Eigen::MatrixXd values, rates, accelerations;  ///< K×d
  int per_row = 1;                               ///< instants for each row of the table
};

/// "line 3" of a file, or "row 2" of a table that is not from a file.
std::string row_name(const MotionTable& table, std::size_t row);

/// Checks sizes, numbers and times of a table, and computes the derivatives that it lacks. Angles
/// of the base are continued beyond whole turns.
CoordinateSeries make_series(MotionTable table);

}  // namespace maxwrench
