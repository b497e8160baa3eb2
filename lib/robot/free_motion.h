#pragma once

#include <functional>

#include "lib/robot/dynamics.h"
#include "maxwrench/integrator.h"

namespace maxwrench {

// The state y of a moving robot in an Ode, in this order:
//
//   p   3  position of the base in the world [m]
//   e   4  its orientation as a quaternion (w, x, y, z)
//   q      joint positions
//   v   n  velocities (see lib/robot/dynamics.h)
//
// The orientation is that of e/|e|, so the length of e does not affect the motion. The rate of e
// has a term along e that pulls the length back to one, so it stays close to one.

/// The configuration and velocity of a robot.
struct Motion {
  Pose<double> base;
  Eigen::VectorXd q, v;
};

/// The number of entries that a motion takes in a state.
int motion_size(const Robot& robot);
/// Write a motion to, or read it from, the first entries of y.
void write_motion(const Motion& motion, Eigen::VectorXd& y);
void read_motion(const Eigen::VectorXd& y, Motion& motion);
/// Writes the rates of p, e and q of a motion that was read from y to the first entries of y_dot:
///   p_dot = R v_lin,  e_dot = e * (0, w)/2 + k (1 - |e|^2) e,  k = 1/s,  q_dot.
void configuration_rates(const Robot& robot, const Motion& motion, const Eigen::VectorXd& y,
                         Eigen::VectorXd& y_dot);

/// The derivatives of these rates by v, c×n for the c entries of p, e and q.
void configuration_slopes(const Robot& robot, const Motion& motion, const Eigen::VectorXd& y,
                          Eigen::MatrixXd& slopes);
/// The velocities, n×c, that change p, e and q by one per unit of time, for a base on its axes. A
/// change of the length of e is no motion.
void configuration_shifts(const Robot& robot, const Motion& motion, const Eigen::VectorXd& y,
                          Eigen::MatrixXd& shifts);

/// The configuration after `seconds` at the motion's constant velocities.
Motion advanced(const Robot& robot, Motion motion, double seconds);

/// A robot without contact under actuator forces tau(t) (eq:dynamics with h_e = 0). Its residual
/// form needs no factorisation of M.
class FreeMotion final : public Ode {
 public:
  /// The robot must outlive this object. `tau` fills n numbers [N, N m].
  FreeMotion(const Robot& robot, const Motion& start,
             std::function<void(double t, Eigen::VectorXd& tau)> tau);
  FreeMotion(const Robot&&, const Motion&, std::function<void(double, Eigen::VectorXd&)>) = delete;

  const Eigen::VectorXd& initial() const override { return start_; }
  bool derivative(double t, const Eigen::VectorXd& y, Eigen::VectorXd& y_dot) override;
  bool residual(double t, const Eigen::VectorXd& y, const Eigen::VectorXd& y_dot,
                Eigen::VectorXd& F) override;

 private:
  const Robot& robot_;
  Dynamics dynamics_;
  std::function<void(double, Eigen::VectorXd&)> effort_;
  Eigen::VectorXd start_, tau_, v_d_, tau_d_;
  Motion motion_;
};

}  // namespace maxwrench
