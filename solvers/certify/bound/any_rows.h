#pragma once

#include <vector>

#include "maxwrench/bound.h"
#include "maxwrench/problem.h"
#include "solvers/certify/bound/multi_affine.h"
#include "solvers/certify/bound/multiplier_program.h"

namespace maxwrench {

/// A posture with any wrenches as rows of numbers. With b base axes, j joints, y_i = (J_b'W)^-T
/// W'c_i and K = J_j'W (J_b'W)^-1, the rows are [o_0; tau_0; y; K column by column], where o_0,i =
/// -y_i'tau_b and tau_0 = tau_j - K tau_b. With thrusts u the wrench is y_i'B_b u + o_0,i along
/// c_i, and the joints exert tau_0 + K B_b u.
///
/// The c_i are the given directions, then axes x_k: the wrenches that are not free. W has these as
/// well, so that it has as many columns as the base has free axes; along x_k the wrench is zero.
struct AnyModel {
  MultiAffine f;
  Eigen::VectorXd sizes;         ///< of the rows
  Eigen::MatrixXd B_b;           ///< b×thrusters
  Eigen::VectorXd u_min, u_max;  ///< of thrusters,
  Eigen::VectorXd j_min, j_max;  ///< and of joints
  Eigen::Index b, j;
  Eigen::Index aims;  ///< number of directions c_i, with
  Eigen::Index held;  ///< that of the axes x_k
};

/// The model for the directions c_i, the columns of C, in axes of `Problem::c`. Throws
/// std::invalid_argument, with one line, unless W has as many columns as the base has free axes, or
/// all axes of the base are free.
AnyModel make_any_model(const Problem& problem, const Matrix6Xd& C);

/// The rows of one direction C d at points Q of the model, as of a robot with more joints, which
/// exert nothing: the wrench along each column of C N, and along each x_k, is zero. N is
/// aims×count.
Eigen::MatrixXd rows_along(const Eigen::MatrixXd& Q, const AnyModel& model,
                           const Eigen::VectorXd& d, const Eigen::MatrixXd& N);

/// The limits of joints, followed by zeros for equations.
Eigen::VectorXd with_zeros(const Eigen::VectorXd& limits, Eigen::Index count);

/// The bound U(mu) of one direction over control points, `make_any_wrench_bound`.
class AnyRows {
 public:
  /// The limits of joints and the sizes of the rows may be those of more joints than the robot has.
  AnyRows(const AnyModel& model, const Eigen::VectorXd& sizes, const Eigen::VectorXd& j_min,
          const Eigen::VectorXd& j_max);

  /// The most that the thrusters exert along c, with the largest lever that a posture can have.
  double ceiling() const;
  /// The rows of one direction at the control points, one point a row. Before `bound`.
  Eigen::MatrixXd& points() { return P_; }
  /// Improves the proof, whose multiplier on entry is that of a larger box or none.
  void bound(double low, BoxProof& proof);

 private:
  static constexpr int kMostRounds = 30;
  static constexpr std::size_t kMostAdded = 16;
  static constexpr int kMostSteps = 60;
  static constexpr double kBelow = 1e-9;  ///< more than rounding can add to U
  /// A share of U's excess over `low`: another round is not useful if U is nearer than this to the
  /// least U of the points so far.
  static constexpr double kClose = 0.01;

  double value();
  void add_points(double least, bool all);
  void add_point(Eigen::Index v);

  const Eigen::Index j_, b_;
  Eigen::MatrixXd B_b_;
  Eigen::VectorXd u_min_, u_max_, j_min_, j_max_;
  MultiplierProgram program_;
  Eigen::MatrixXd P_, d_, g_;
  Eigen::VectorXd u_, force_, mu_, most_, by_mu_;
  std::vector<int> order_;
  double fixed_ = 0, support_ = 0;
  Eigen::Index points_ = 0;
};

}  // namespace maxwrench
