#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "maxwrench/integrator.h"
#include "maxwrench/path.h"
#include "maxwrench/types.h"

namespace maxwrench {

class TrajectorySolver;
struct Instant;
struct Trajectory;
struct Posture;
struct Problem;

/// What holds the end effector. Stiffness and damping of each world axis, all three forces and all
/// three torques alike. A commercial six-axis sensor has about 1e7 N/m and 1e5 N m/rad; the frame
/// that carries it yields more. The damping is the stiffness times 1 ms.
struct LoadCell {
  double stiffness_linear = 1e6;   ///< N/m: 0.1 mm at 100 N
  double stiffness_angular = 1e5;  ///< N m/rad: 0.06 degrees at 100 N m
  double damping_linear = 1e3;     ///< N s/m
  double damping_angular = 100;    ///< N m s/rad
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
  /// rad/s, of the posture's errors, critically damped: a fifth of what the thrusters follow,
  /// 1/thruster_lag.
  double bandwidth = 2;
  /// Share of the planned wrench that is not asked for, so that efforts are left to hold the
  /// posture: a quarter of kHeldWrenchError.
  double margin = 0.005;
  /// kg. Positive: nothing holds the end effector, which carries this point mass. It displaces no
  /// water.
  double load = 0;
  /// Ends the experiment after the hold.
  bool until_hold = false;
  LoadCell cell;
  Imperfections imperfections;
  IntegratorOptions integrator{1e-6, 1e-8, 100000, 1e-4};
};

/// Throws std::invalid_argument, with one line that names the key, unless all times, the lag and
/// the stiffness are positive (the hold may be zero), nothing is negative, infinite or NaN, the
/// margin is below 1, and the experiment has at most ten million periods.
void check(const TankOptions& options);

/// What the robot is to exert.
struct TargetWrench {
  Vector6d h;                     ///< [N; N m] in world axes; with a load its weight
  Eigen::VectorXd u;              ///< m, efforts to stay close to at the full share
  Wrench wrench = Wrench::kPure;  ///< kAny: the cell may take any of W_any across c
};

/// One instant, at the end of a control period or where the integrator gave up within one.
struct TankSample {
  double t = 0;          ///< s
  double planned = 0;    ///< c'h of the trajectory [N, N m]
  double reading = 0;    ///< c'h_e
  Vector6d h_e;          ///< the cell's reading, or what carries and accelerates the load
  Eigen::VectorXd u;     ///< m, efforts before the imperfections
  double shortfall = 0;  ///< see EffortAnswer
  bool saturated = false, relaxed = false;
  double theta_r_error = 0;        ///< max |theta_r - its reference| [rad, m]
  double configuration_error = 0;  ///< the same of all joints, and of the base [rad, m]
  double position_error = 0;       ///< of the end effector [m]
  double deflection_error = 0;  ///< likewise [m, rad], from where the trajectory bends the cell to
  double violation = 0;         ///< how far efforts or rates leave their limits [N, N m, N/s]
  // Of a task in time only.
  double off_axis_force = 0,
         off_axis_torque = 0;  ///< of h_e across c, from the trajectory [N, N m]
  double speed = 0;            ///< how far joints are beyond their speed limits [rad/s, m/s]
  double angle = 0;            ///< that the end effector has turned by [rad]
  Eigen::VectorXd theta_r;     ///< r
};

/// What a task in time was like; times are those of samples [s].
struct MotionSummary {
  double t_low = 0, t_high = 0;  ///< of the lowest and the highest reading
  double at_peak = 0;            ///< of an impulse: the reading at t_h; else NaN
  double deviation = 0;          ///< largest of the reading from the trajectory [N, N m]
  double off_axis_force = 0,
         off_axis_torque = 0;  ///< largest across c from the trajectory, if not free
  double speed = 0;            ///< largest of the samples [rad/s, m/s]
  int violations = 0;          ///< samples beyond a limit of effort, rate or speed
};

/// What the hold was like; NaN where there was no hold. If the posture was lost, how far it is from
/// its reference reaches to that instant.
struct TankSummary {
  double planned = 0;                  ///< c'h [N, N m]
  double mean = 0, low = 0, high = 0;  ///< c'h_e
  Vector6d across;                     ///< mean of h_e less its part along c [N; N m]
  double theta_r_error = 0, configuration_error = 0;  ///< largest [rad, m]
  double position_error = 0;                          ///< largest [m]
  double deflection_error = 0;                        ///< largest [m, rad]
  double violation = 0;                               ///< largest of the whole experiment
  double saturated = 0, relaxed = 0;                  ///< shares of the periods
  double shortfall = 0;                               ///< mean [N, N m]
  bool lost = false;                                  ///< it ended there, see kLost
  bool held = false;
  std::string missed;                   ///< why not, each value with what is allowed
  std::optional<MotionSummary> motion;  ///< of a task in time, whose hold is all of it
};

/// kReached: the experiment ran to its end, or until the posture was lost.
struct TankRun : Verdict {
  std::vector<TankSample> samples;
  TankSummary summary;
  long requests = 0, active_set_iterations = 0, evaluations = 0;
  /// Time in derivatives, in tau_c, in the tracking program, in all; the rest is the integrator's.
  double model_s = 0, controller_s = 0, qp_s = 0, total_s = 0;
};

/// Held is a wrench whose mean over the hold is this close to the trajectory, along c and, unless
/// the task leaves them to the environment, in all components across c, while the whole posture
/// stays this close to its reference, the end effector this close to where the trajectory bends the
/// cell to, and efforts and rates within their limits. Of a load the wrench is what carries and
/// accelerates it: what falls is not held.
inline constexpr double kHeldWrenchError = 0.02;  ///< of the planned c'h
inline constexpr double kHeldThetaRError = 0.01;  ///< rad, m: 0.6 degrees
inline constexpr double kHeldPosition = 0.01;     ///< m, rad
inline constexpr double kHeldViolation = 1e-3;    ///< N, N m, N/s: of what the integrator leaves
/// m: beside a planned force a torque counts as the force at this lever, about the size of a hand,
/// and beside a planned torque a force as the torque that it has there.
inline constexpr double kHeldLever = 0.1;
/// This far from its reference the posture is lost, which ends the experiment [rad, m].
inline constexpr double kLost = 0.5;

/// The experiment at `posture`: a share s of the wrench grows from zero to one in the ramp, stays,
/// and shrinks. Efforts follow the trajectory u* = (1 - s) u_0 + s u, u_0 those at rest, by the
/// tracking program (see EffortTracker) for
///
///     tau_c = C v + D v + g + s J'h + M a,   a = A_r (omega^2 e_r - 2 omega theta_r_dot)
///
/// where e_r are the errors of theta_r and omega the bandwidth; what A_r accelerates leaves the end
/// effector alone, so the reading is that of the trajectory. With kAny the rows of the balance are
/// those combinations in which the wrenches across c have no part.
///
/// A load is part of the robot's mass matrix and weight from the start; what holds it up lets go in
/// the ramp. Then a = omega^2 e - 2 omega v acts on all velocities, e the errors of base and
/// joints. Throws as `check`.
TankRun run_tank(const Problem& problem, const Posture& posture, const TargetWrench& target,
                 Integrator& integrator, const TankOptions& options);

/// What joins the instants of a trajectory.
enum class Interpolation {
  kLinear,  ///< the scheme's own instants; theta_r and efforts are linear in between, as in the
            ///< paper
  kSpline   ///< the clamped spline through the knots, with efforts at the instants of
            ///< `value_between_knots`
};
const char* to_string(Interpolation interpolation);
/// By its name. Throws std::invalid_argument that names both.
Interpolation parse_interpolation(const std::string& name);

/// What the tank carries out: a trajectory joined in time. Not all of a trajectory: a wrench is
/// asked for that is smaller by the margin, and the efforts are those that the lower level finds
/// for it. Its use needs maxwrench/trajectory.h.
struct TankScript : Verdict {
  Path path = Path::constant({}, 1);  ///< of what holds the end effector
  std::vector<Instant> instants;      ///< t from 0 to T; u and h as asked for
  Interpolation interpolation = Interpolation::kSpline;
  Wrench wrench = Wrench::kPure;
  double planned = 0;  ///< along c, of an impulse at t_h [N, N m]
  double margin = 0;   ///< share of it that is not asked for
  double t_h = std::numeric_limits<double>::quiet_NaN();  ///< s, of an impulse
  double slack = 0;  ///< largest of the balance of the efforts [N, N m]: 0 if they reach it
};

struct ScriptOptions {
  Interpolation interpolation = Interpolation::kSpline;
  double planned = 0;     ///< zero: value, or `value_between_knots` on the spline
  double margin = 0.005;  ///< as in TankOptions
};
/// Throws std::invalid_argument unless `planned` is finite and not negative and the margin is from
/// 0 to below 1.
void check(const ScriptOptions& options);

/// Efforts for exactly the wrench that is asked for: along a path c'h = (1 - margin) planned at all
/// instants, in an impulse at t_h, by the elastic program of the trajectory,
///
///     B u_i - J_i'h_i (+ s_i) = tau_d,i,   u_min <= u_i <= u_max,   |u_i+1 - u_i| <= du_max dt.
///
/// `trajectory` was evaluated, on the spline as well. Knots of `forward` along a path are T/(k-1)
/// apart here as their poses are; one knot is held where the path starts. kInfeasible: the
/// trajectory has no value to ask for, and none was given. Throws as `check`.
TankScript make_script(const Problem& problem, const Trajectory& trajectory, Wrench wrench,
                       TrajectorySolver& solver, const ScriptOptions& options);

/// As held counts a reading in time that is this close to the trajectory, all along a path or at
/// t_h, while the whole posture stays this close to its reference, no sample is beyond a limit of
/// effort, rate or joint speed, and the end effector is as close as in a hold to where the
/// trajectory bends the cell to.
inline constexpr double kTrackedWrenchError = 0.03;         ///< of the planned c'h
inline constexpr double kTrackedConfigurationError = 0.02;  ///< rad, m: twice that of a hold

/// The experiment along a script, of its duration. What holds the end effector moves along the path
/// and reads the wrench, in axes that turn with it and are those of the world at the start. At the
/// start the load is on: the end effector is where it bends the cell to, theta_r at rest at its
/// first value, and the efforts those of the first instant. Efforts follow those of the script by
/// the tracking program for
///
///     tau_c = M a + C v + D v + g + J'h,   theta_r_ddot = that of the script + omega^2 e + 2 omega
///     e_dot
///
/// where a is the acceleration of all velocities that keeps the end effector on the path with that
/// theta_r_ddot, e the errors of theta_r and omega the bandwidth. Of the options ramp, hold,
/// margin, load and until_hold mean nothing here. Throws as `check`, and unless the script
/// has at least two instants with efforts.
TankRun run_tank(const Problem& problem, const TankScript& script, Integrator& integrator,
                 const TankOptions& options);

}  // namespace maxwrench
