#pragma once

#include "lib/math/random.h"
#include "lib/tank/effort_tracking.h"
#include "maxwrench/integrator.h"
#include "maxwrench/tank.h"

namespace maxwrench {

class TankOde;
struct Problem;
struct Robot;

/// The control periods of an experiment. In each period the tracking program computes efforts for
/// the controller's request, and the simulated robot applies them.
class ControlLoop {
 public:
  /// Keeps references to all arguments.
  ControlLoop(const Problem& problem, const TankOptions& options, Integrator& integrator,
              TankOde& ode, EffortTracker& tracker);
  ControlLoop(const Problem&&, const TankOptions&, Integrator&, TankOde&, EffortTracker&) = delete;

  EffortRequest request;  ///< for the next step
  TankRun run;

  /// Lets the actuators fail whose time has come. Call it first in the period that begins at t.
  void begin(double t);

  /// Moves the efforts from u_0 at t_0 to the answer to the request at t_1. h_0 and h_1 are exerted
  /// on the support of a load. Returns the time at which the step ended, which is before t_1 if the
  /// integrator failed.
  double step(double t_0, const Eigen::VectorXd& u_0, double t_1, const Vector6d& h_0,
              const Vector6d& h_1);

  /// The efforts and limit violations of the last step, from t_0 to t.
  TankSample sample(double t_0, double t) const;

  /// Whether the posture was lost at the last sample (see kLost).
  bool lost() const;
  /// Whether another step may follow: nothing failed, the posture is held and nobody interrupts,
  /// which concludes the run.
  bool goes_on();

  /// The run with its counts and times, but without its summary.
  TankRun& finish();

 private:
  void leave_out_dead();
  void draw_noise();
  double violation(double dt, const Eigen::VectorXd& u) const;

  const Robot& robot_;
  const TankOptions& options_;
  Integrator& integrator_;
  TankOde& ode_;
  EffortTracker& tracker_;
  Random random_;
  double t_ = 0;  ///< when the present period began
  Eigen::VectorXd u_0_;
  EffortAnswer answer_;
  OdeSolution path_;
};

}  // namespace maxwrench
