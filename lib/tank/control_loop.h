#pragma once

#include "lib/math/random.h"
#include "lib/tank/effort_tracking.h"
#include "maxwrench/integrator.h"
#include "maxwrench/tank.h"

namespace maxwrench {

class TankOde;
struct Problem;
struct Robot;

/// The control periods of an experiment: in each the tracking program answers what a controller
/// asks for, and the simulated robot carries that out.
class ControlLoop {
 public:
  /// Keeps references to all of them.
  ControlLoop(const Problem& problem, const TankOptions& options, Integrator& integrator,
              TankOde& ode, EffortTracker& tracker);
  ControlLoop(const Problem&&, const TankOptions&, Integrator&, TankOde&, EffortTracker&) = delete;

  EffortRequest request;  ///< of the next step
  TankRun run;

  /// From efforts u_0 at t_0 to those that answer the request at t_1; h_0 and h_1 are exerted on
  /// the support of a load. Returns where it ended, before t_1 if the integrator gave up.
  double step(double t_0, const Eigen::VectorXd& u_0, double t_1, const Vector6d& h_0,
              const Vector6d& h_1);

  /// What the last step, from t_0 to t, says of efforts and their limits.
  TankSample sample(double t_0, double t) const;

  /// Of the last sample: the posture was lost (see kLost).
  bool lost() const;
  bool accepts_starts() const { return run.status == Status::kReached && !lost(); }

  /// The run with what it took, but without its summary.
  TankRun& finish();

 private:
  void draw_noise();
  double violation(double dt, const Eigen::VectorXd& u) const;

  const Robot& robot_;
  const TankOptions& options_;
  Integrator& integrator_;
  TankOde& ode_;
  EffortTracker& tracker_;
  Random random_;
  Eigen::VectorXd u_0_;
  EffortAnswer answer_;
  OdeSolution path_;
};

}  // namespace maxwrench
