#pragma once

#include <Eigen/Cholesky>
#include <string>

#include "lib/robot/dynamics.h"
#include "maxwrench/types.h"

namespace maxwrench {

struct Posture;
struct Problem;

/// Why measures of accelerations do not support a task: "KEY: got VALUE, expected ..." or a
/// sentence like it. Empty if they do.
std::string why_no_acceleration(const Problem& problem);

/// What the acceleration of the end effector depends on at rest without contact. With
/// M v_dot + tau_d = B u, the acceleration on the axes W of the task (`Problem::W_any`) is
///
///     W'a = T v_dot = X'(B u - tau_d),   T = W'J (k×n),   X = M^-1 T' (n×k).
///
/// M is factored once for each posture. Evaluation allocates nothing after the first call.
class TaskDynamics {
 public:
  /// The problem must outlive this object. Throws std::invalid_argument, with the name of the
  /// measure, if `why_no_acceleration`.
  TaskDynamics(const Problem& problem, const std::string& measure);

  /// Computes W, T, M and X at a posture. Returns null, or why there are none.
  const char* set(const Posture& posture);

  const Matrix6Xd& W() const { return W_; }        ///< turned with the end effector (6×k)
  const Eigen::MatrixXd& T() const { return T_; }  ///< k×n
  const Eigen::MatrixXd& M() const { return M_; }  ///< n×n
  const Eigen::MatrixXd& X() const { return X_; }  ///< n×k
  /// x (n) becomes M^-1 x.
  void divide(Eigen::VectorXd& x) const { llt_.solveInPlace(x); }
  /// d(x'M y)/dq for all joints.
  void mass_slopes(const Eigen::VectorXd& x, const Eigen::VectorXd& y, Eigen::VectorXd& slopes) {
    dynamics_.mass_slopes(x, y, slopes);
  }

 private:
  bool factor();

  Dynamics dynamics_;
  Eigen::Index joints_;
  Matrix6Xd W_0_, W_;  ///< before and after the turn with the end effector
  Eigen::MatrixXd T_, M_, X_;
  Eigen::LLT<Eigen::MatrixXd> llt_;
};

}  // namespace maxwrench
