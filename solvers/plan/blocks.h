#pragma once

#include <Eigen/Core>

// How the interior point method of plans keeps its numbers: small blocks, one for each instant.

namespace maxwrench {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Columns = Eigen::Ref<Eigen::MatrixXd>;

/// Calls body with the number of a stage's variables, known to the compiler where it is that of the
/// robots with eight thrusters and six base axes.
template <class Body>
void with_dimension(int d, Body&& body) {
  switch (d) {
    case 1:
      return body.template operator()<1>();
    case 3:
      return body.template operator()<3>();
    case 8:
      return body.template operator()<8>();
    default:
      return body.template operator()<Eigen::Dynamic>();
  }
}

}  // namespace maxwrench
