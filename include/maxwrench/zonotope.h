#pragma once

#include <Eigen/Sparse>
#include <vector>

/// @file
/// The zonotope of the generalised forces that the actuators can exert.

namespace maxwrench {

/// The zonotope {B u : u_min <= u <= u_max} of the generalised forces that the actuators can exert,
/// with its facets.
///
/// With facets, tau lies in the set exactly if b_min <= N'tau <= b_max. The two limits of a pair of
/// facets are independent, because the limits of u may be asymmetric. A direction that no actuator
/// reaches is a pair with b_min = b_max = 0.
struct Zonotope {
  Eigen::MatrixXd B;        ///< efforts -> generalised forces (n×m)
  Eigen::VectorXd u_min,    ///< lower limits of u (m) [N or N m]
      u_max;                ///< upper limits of u (m) [N or N m]
  int rank = 0;             ///< rank of B
  Eigen::MatrixXd B_pinv;   ///< pseudo-inverse B^+ (m×n)
  bool has_facets = false;  ///< false if there are too many to enumerate
  /// Unit normals of the pairs of facets, as columns (n×f). It is stored by rows, so that the
  /// products with all normals are vectorised.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> N;
  Eigen::SparseMatrix<double> N_nonzero;  ///< N without its zeros, by columns
  std::vector<int> N_begin,  ///< column j of N is zero before row N_begin[j] (f), not decreasing
      N_end;                 ///< and from row N_end[j] on (f), not decreasing
  Eigen::VectorXd b_min,     ///< lower limits of N'tau (f)
      b_max;                 ///< upper limits of N'tau (f)

  /// Returns n, the number of generalised forces.
  int dimension() const { return static_cast<int>(B.rows()); }
  /// Returns m, the number of actuators.
  int actuators() const { return static_cast<int>(B.cols()); }
  /// Returns f, the number of pairs of parallel facets.
  int facet_pairs() const { return static_cast<int>(N.cols()); }
  /// Returns whether B has full row rank.
  bool full_row_rank() const { return rank == dimension(); }
};

/// Makes a zonotope from B and the limits of u.
///
/// It enumerates the facets block by block: rows and columns of B that no entry connects are
/// independent. In each block it examines all subsets of rank - 1 columns.
///
/// @param B            efforts -> generalised forces (n×m)
/// @param u_min        lower limits of u (m)
/// @param u_max        upper limits of u (m)
/// @param max_subsets  largest number of subsets; beyond it the zonotope has no facets
/// @throws std::invalid_argument if the sizes disagree, an entry of B is not finite, or
///         u_min <= u_max does not hold.
Zonotope make_zonotope(Eigen::MatrixXd B, Eigen::VectorXd u_min, Eigen::VectorXd u_max,
                       long max_subsets = 20000);

/// Returns a zonotope with other limits of u. The facets keep their normals, which serve any
/// limits.
///
/// An infinite limit makes the facets that it moves infinite.
///
/// @param zonotope  the zonotope
/// @param u_min     lower limits of u (m)
/// @param u_max     upper limits of u (m)
/// @throws std::invalid_argument as `make_zonotope`.
Zonotope with_limits(Zonotope zonotope, Eigen::VectorXd u_min, Eigen::VectorXd u_max);

/// Fills N_nonzero, N_begin and N_end from N.
void index_normals(Zonotope& zonotope);

}  // namespace maxwrench
