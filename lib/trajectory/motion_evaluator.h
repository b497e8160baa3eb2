#pragma once

#include <functional>
#include <vector>

#include "lib/robot/dynamics.h"
#include "lib/robot/dynamics_slopes.h"
#include "lib/trajectory/robot_motion.h"
#include "lib/trajectory/scheme.h"
#include "maxwrench/trajectory.h"

namespace maxwrench {

/// The derivatives of f_i = tau_d,i + J_i'h_i by the motion at instant i, at constant h of the
/// instants. n×r each. In a transfer h_i = m c_i, where c_i depends on the motion and m is
/// constant.
struct MotionSlopes {
  Eigen::MatrixXd place, rate, bend;  ///< by theta_r, theta_r_dot, theta_r_ddot (`spline`)
  Eigen::MatrixXd M;                  ///< n×n, by v_dot
  Eigen::MatrixXd v_place, v_rate;    ///< of v; v_rate is A_r
  Eigen::MatrixXd q_place;  ///< joints×r, of q by theta_r; empty without dependent joints
};

/// Whether the twist of a motion differs from that of the path, or, if the scheme is `smooth` and
/// so defines accelerations, its derivative.
bool leaves_path(const RobotMotion<double>& motion, const PathPoint& x, bool smooth);

/// The motion of a robot at the instants of a scheme, from a table of knots, and its derivatives.
/// `evaluate` and `linearize` allocate nothing after the first call.
class MotionEvaluator {
 public:
  /// The problem must outlive this object.
  MotionEvaluator(const Problem& problem, SchemeMaps maps);
  MotionEvaluator(const Problem&&, SchemeMaps) = delete;

  /// Of a transfer, x is that of the last `evaluate`.
  const SchemeMaps& maps() const { return maps_; }

  /// Moves instant i of the scheme to a time and point of the path.
  void set_instant(std::size_t i, double t, const PathPoint& x) {
    maps_.t[i] = t;
    maps_.x[i] = x;
  }

  /// Q K×r. Fills t, the poses, q, v, v_dot, J and tau_d of the instants. From instant `lost` on,
  /// the values are NaN.
  void evaluate(const Eigen::MatrixXd& Q, std::vector<Instant>& instants);

  /// The first instant of the last `evaluate` that the dependent joints do not reach, or at which
  /// the robot cannot move the end effector along the path; -1 if there is none. `lost_reason`
  /// gives the reason.
  int lost() const { return lost_; }
  const char* lost_reason() const { return lost_reason_; }

  /// Calls see(instant, q, slopes) for the postures of the instants until the dependent joints have
  /// no solution. q: all joints. slopes: the derivative of z by theta_r if there are dependent
  /// joints (`DependentJoints::slopes`), else empty. Returns whether all instants were visited.
  bool visit(const Eigen::MatrixXd& Q,
             const std::function<void(int, const Eigen::VectorXd&, const Eigen::MatrixXd&)>& see);

  /// Call after `evaluate`.
  void linearize(const std::vector<Instant>& instants, std::vector<MotionSlopes>& slopes);

  /// gradient K×r of sum_i lambda_i'f_i, lambda n×N: pulls the slopes back through the scheme.
  void pull_back(const std::vector<MotionSlopes>& slopes, const Eigen::MatrixXd& lambda,
                 Eigen::MatrixXd& gradient) const;
  /// G n×(K r) of f_i by the knots, knot by knot: all coordinates of theta_r_1 first.
  void push_forward(const std::vector<MotionSlopes>& slopes, int instant, Eigen::MatrixXd& G) const;

 private:
  void set_rows(const Eigen::MatrixXd& Q);
  void read_tool(std::size_t i);
  void add_payload(const Instant& instant, const PathPoint& x, MotionSlopes& slopes);
  void lose(int instant, const char* reason, std::vector<Instant>& instants);
  void accelerate_by_differences(std::vector<Instant>& instants) const;
  void follow(const Instant& instant, int i, int first, int count);
  void read_slopes(std::size_t d, Eigen::Index direction);

  const Problem& problem_;
  SchemeMaps maps_;
  RobotMotionTracker tracker_;
  Dynamics dynamics_;
  RobotMotion<Dual<4>> dual_motion_;
  DynamicsSlopes dynamics_slopes_;
  Eigen::MatrixXd place_, rate_, bend_;  ///< r×N: theta_r and its derivatives at the instants
  Eigen::MatrixXd visited_;  ///< the same for `visit`, which must not change those of `linearize`
  VectorX<double> theta_r_, rate_r_, bend_r_, q_;
  const Eigen::MatrixXd no_slopes_;
  /// The payload of a transfer; null: the motion is not one.
  const CarriedBody* transferred_ = nullptr;
  Vector6<Dual<4>> dual_c_;
  int lost_ = -1;
  const char* lost_reason_ = nullptr;
  VectorX<Dual<4>> dual_theta_r_, dual_rate_, dual_bend_, dual_v_, dual_v_dot_;
  /// Of the motion at an instant by (theta_r, theta_r_dot), and of f; 2r columns each.
  Eigen::MatrixXd turn_slopes_, q_slopes_, v_slopes_, v_dot_slopes_, f_slopes_;
  Eigen::MatrixXd c_slopes_,  ///< 6×2r, of the wrench of 1 kg
      mJt_;                   ///< n×6
};

}  // namespace maxwrench
