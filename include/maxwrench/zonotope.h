#pragma once

#include <Eigen/Sparse>

namespace maxwrench {

/// The generalised forces that the actuators can exert: {B u : u_min <= u <= u_max}, and its faces.
///
/// With facets, tau lies in the set exactly if b_min <= N'tau <= b_max. The two bounds of a pair
/// are independent (limits may be asymmetric); a direction that no actuator reaches is a pair with
/// b_min = b_max = 0.
struct Zonotope {
  Eigen::MatrixXd B;             ///< n×m
  Eigen::VectorXd u_min, u_max;  ///< m [N or N m]
  int rank = 0;                  ///< of B
  Eigen::MatrixXd B_pinv;        ///< B^+, m×n
  bool has_facets = false;       ///< false if there are too many to enumerate
  /// n×f, unit columns, stored by rows: products with all normals at once are vector code.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> N;
  Eigen::SparseMatrix<double> N_nonzero;  ///< N without its zeros, by columns
  Eigen::VectorXd b_min, b_max;           ///< f

  int dimension() const { return static_cast<int>(B.rows()); }
  int actuators() const { return static_cast<int>(B.cols()); }
  int facet_pairs() const { return static_cast<int>(N.cols()); }
  bool full_row_rank() const { return rank == dimension(); }
};

/// Completes a zonotope from B and the limits. The facets are enumerated block by block (rows and
/// columns of B that no entry connects are independent), in each block over all subsets of rank - 1
/// columns; beyond `max_subsets` of them the zonotope has no facets. Throws std::invalid_argument
/// if the sizes disagree, an entry of B is not finite, or not u_min <= u_max.
Zonotope make_zonotope(Eigen::MatrixXd B, Eigen::VectorXd u_min, Eigen::VectorXd u_max,
                       long max_subsets = 20000);

}  // namespace maxwrench
