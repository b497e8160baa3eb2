#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "maxwrench/integrator.h"

/// @file
/// The options of the virtual tank: times, load cell, imperfections and failing actuators.

namespace maxwrench {

struct Robot;

/// The load cell that holds the end effector.
///
/// It has a stiffness and a damping in each world axis: one pair of values for all three forces and
/// one for all three torques. A commercial six-axis sensor has about 1e7 N/m and 1e5 N m/rad. The
/// frame that carries it is more compliant. The damping is the stiffness times 1 ms.
struct LoadCell {
  double stiffness_linear = 1e6;   ///< stiffness of forces [N/m]: 0.1 mm at 100 N
  double stiffness_angular = 1e5;  ///< stiffness of torques [N m/rad]: 0.06 degrees at 100 N m
  double damping_linear = 1e3;     ///< damping of forces [N s/m]
  double damping_angular = 100;    ///< damping of torques [N m s/rad]
};

/// How the simulated robot differs from its model. By default it does not differ.
struct Imperfections {
  double thrust_efficiency = 1;  ///< thrust divided by commanded thrust
  /// Standard deviation of the force of each thruster [N], new in each period.
  double thrust_noise = 0;
  std::uint64_t seed = 1;  ///< seed of the noise
};

/// An actuator that fails during an experiment: a thruster exerts no force any more, the drive of a
/// joint no torque.
struct ActuatorDeath {
  int actuator = 0;  ///< index of its effort
  double t = 0;  ///< time [s]; it exerts nothing from the first period that begins then or later
};

/// The options of an experiment as in the paper: ramp, hold, ramp.
struct TankOptions {
  double ramp = 5,            ///< duration of each ramp [s]
      hold = 5;               ///< duration of the hold [s]
  double period = 0.01;       ///< time between two commands [s]; efforts are linear in between
  double thruster_lag = 0.1;  ///< time constant of the thrusters, first order [s]
  /// Whether the efforts that the tracking program requests are those that the thrusters reach
  /// behind their lag, from commands within the limits. In time the efforts of the script are, too.
  bool invert_lag = false;
  /// Bandwidth of the control of posture errors, critically damped [rad/s]. The default is a fifth
  /// of 1/thruster_lag, which the thrusters can follow.
  double bandwidth = 2;
  /// The fraction of the planned wrench that is not requested, so that efforts remain to hold the
  /// posture. The default is a quarter of kHeldWrenchError.
  double margin = 0.005;
  /// Mass of the load [kg]. If it is positive, nothing holds the end effector, which carries this
  /// point mass. The mass displaces no water.
  double load = 0;
  /// Whether the experiment ends after the hold.
  bool until_hold = false;
  LoadCell cell;                      ///< the load cell
  Imperfections imperfections;        ///< how the robot differs from its model
  std::vector<ActuatorDeath> deaths;  ///< actuators that fail, each at most once
  /// Time after which the controller no longer counts on an actuator that failed [s].
  double noticed_after = 0;
  /// Tolerances and limits of the integration.
  IntegratorOptions integrator{1e-6, 1e-8, 100000, 1e-4};
  /// Asked before each period; once it returns true, the experiment ends early. May be empty.
  std::function<bool()> interrupted;
};

/// Checks the options of an experiment.
///
/// All times, the lag and the stiffness must be positive, except that the hold may be zero. Nothing
/// may be negative, infinite or NaN. The margin must be below 1. The experiment may have at most
/// ten million periods. Of the deaths only the times are checked.
///
/// @throws std::invalid_argument, with one line that names the key, otherwise.
void check(const TankOptions& options);

/// Checks the deaths of an experiment of `duration` [s].
///
/// @throws std::invalid_argument, with one line, unless each is that of an actuator of the robot,
///         at most once, and before the end.
void check_deaths(const TankOptions& options, const Robot& robot, double duration);

}  // namespace maxwrench
