#pragma once

#include <Eigen/Core>

// How the interior point method of trajectories stores its numbers: small blocks, one for each
// instant.

namespace maxwrench {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Columns = Eigen::Ref<Eigen::MatrixXd>;

/// Calls body with the number of variables of a stage. It is a compile-time constant for a vehicle
/// with eight thrusters and six base axes (3 with a pure wrench, 8 with any), for one with four
/// thrusters in the plane (2 and 4), and for a pure wrench without redundant actuators (1).
template <class Body>
void with_dimension(int d, Body&& body) {
  switch (d) {
    case 1:
      return body.template operator()<1>();
    case 2:
      return body.template operator()<2>();
    case 3:
      return body.template operator()<3>();
    case 4:
      return body.template operator()<4>();
    case 8:
      return body.template operator()<8>();
    default:
      return body.template operator()<Eigen::Dynamic>();
  }
}

/// Whether `with_dimension` has a compile-time constant for d.
inline bool is_compiled(int d) {
  bool compiled = false;
  with_dimension(d, [&]<int D>() { compiled = D != Eigen::Dynamic; });
  return compiled;
}

}  // namespace maxwrench
