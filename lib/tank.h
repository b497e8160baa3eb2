#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lib/effort_tracking.h"
#include "lib/integrator.h"
#include "lib/motion.h"
#include "lib/posture.h"

namespace maxwrench {

/// What holds the end effector. Stiffness and damping of each world axis are those of a sensor
/// between a stiff frame and the gripper, all three forces and all three torques alike.
struct LoadCell {
  double stiffness_linear = 1e5;   ///< N/m: 1 mm at 100 N
  double stiffness_angular = 1e4;  ///< N m/rad: 0.4 degrees at 76 N m
  double damping_linear = 1e3;     ///< N s/m
  double damping_angular = 50;     ///< N m s/rad
};

/// How the simulated robot differs from its model. All off by default.
struct Imperfections {
  double thrust_efficiency = 1;  ///< thrust over commanded thrust
  double thrust_noise = 0;       ///< N, standard deviation of each thruster, new each period
  std::uint64_t seed = 1;
};

/// An experiment as in the paper: ramp, hold, ramp.
struct TankOptions {
  double ramp = 5, hold = 5;  ///< s
  double period = 0.01;       ///< s, between two commands; efforts are linear in between
  double thruster_lag = 0.1;  ///< s, first order
  double stiffness = 25;      ///< 1/s^2, of the posture: acceleration per error
  double damping = 10;        ///< 1/s
  bool release = false;       ///< true: nothing holds the end effector, which carries a load
  LoadCell cell;
  Imperfections imperfections;
  IntegratorOptions integrator{1e-6, 1e-8, 100000, 1e-4};
};

/// One instant, at the end of a control period.
struct TankSample {
  double t = 0;          ///< s
  double planned = 0;    ///< c'h that the controller aims at [N, N m]
  Vector6d h_e;          ///< the cell's reading, or the load
  Eigen::VectorXd u;     ///< m, actual efforts without noise
  double shortfall = 0;  ///< see EffortAnswer
  bool saturated = false, relaxed = false;
  double joint_error = 0;     ///< max |theta_r - its reference| [rad, m]
  double position_error = 0;  ///< of the end effector [m]
  double violation = 0;       ///< how far efforts or rates leave their limits [N, N m, N/s]
};

/// What the second half of the hold was like.
struct TankSummary {
  double planned = 0;                  ///< c'h [N, N m]
  double mean = 0, low = 0, high = 0;  ///< c'h_e
  double joint_error = 0;              ///< largest [rad, m]
  double position_error = 0;           ///< m
  double violation = 0;                ///< largest of the whole experiment
  double relaxed = 0;                  ///< share of the periods without efforts for tau_c
  double shortfall = 0;                ///< mean [N, N m]
  bool held = false;
};

struct TankRun {
  Status status = Status::kNumericalError;
  std::string reason;
  std::vector<TankSample> samples;
  TankSummary summary;
  long requests = 0, active_set_iterations = 0, evaluations = 0;
  /// Time in derivatives, in tau_c, in the tracking program, in all; the rest is the integrator's.
  double model_s = 0, controller_s = 0, qp_s = 0, total_s = 0;
};

/// Limits of what counts as held, during the second half of the hold.
inline constexpr double kHeldShare = 0.02;     ///< of the planned c'h
inline constexpr double kHeldJoint = 0.05;     ///< rad, m
inline constexpr double kHeldPosition = 0.03;  ///< m, of an end effector that carries a load

/// The experiment at `posture`: the wrench grows from zero to h in the ramp, stays, and shrinks.
/// Efforts follow the plan u* = (1 - s) u_0 + s u_plan, u_0 those at rest, by the tracking program
/// (see EffortTracker) for
///
///     tau_c = C v + D v + g + s J'h + M a,   a = A_r (k e_r - d theta_r_dot)
///
/// where e_r are the errors of theta_r; what A_r accelerates leaves the end effector alone, so the
/// reading is that of the plan. Released, a = k e - d v acts on all velocities.
TankRun run_tank(const Problem& problem, const Posture& posture, const Vector6d& h,
                 const Eigen::VectorXd& u_plan, Integrator& integrator, const TankOptions& options);

}  // namespace maxwrench
