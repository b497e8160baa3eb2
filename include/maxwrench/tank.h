#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "maxwrench/integrator.h"
#include "maxwrench/path.h"
#include "maxwrench/tank_options.h"
#include "maxwrench/types.h"

/// @file
/// The virtual tank: simulated experiments with a controller, thruster lag and a load cell.

namespace maxwrench {

struct DataFault;
struct Robot;
class TrajectorySolver;
struct Instant;
struct Trajectory;
struct Posture;
struct Problem;

/// The first thing that keeps a robot out of the tank: a gear, which its equation of motion lacks,
/// or a link that no body can be (`Robot::no_dynamics`). Nothing if it can move there.
std::optional<DataFault> unmodelled(const Robot& robot);
/// Rejects a robot with such a fault.
///
/// @throws std::invalid_argument with key, value and what was expected.
void check(const Robot& robot);

/// The wrench that the robot is to exert, with its efforts.
struct TargetWrench {
  Vector6d h;                     ///< wrench in world axes [N; N m]; with a load, its weight
  Eigen::VectorXd u;              ///< efforts to stay close to at the full wrench (m)
  Wrench wrench = Wrench::kPure;  ///< kAny: the cell may take any wrench of W_any across c
  /// The wrench to which errors of the reading are relative [N, N m]; 0: the planned one.
  double reference = 0;
};

/// One sample, at the end of a control period or where the integrator failed within one.
///
/// The last five members are filled for a task in time only.
struct TankSample {
  double t = 0;        ///< time [s]
  double planned = 0;  ///< planned wrench c'h [N, N m]
  double reading = 0;  ///< reading along c, c'h_e [N, N m]
  Vector6d h_e;        ///< reading of the cell, or the wrench that carries and accelerates the load
  Eigen::VectorXd u;   ///< efforts without the imperfections (m)
  double shortfall = 0;    ///< max |B u - tau_c|, the part of the requested forces that the efforts
                           ///< do not exert [N, N m]
  bool saturated = false,  ///< whether an effort is at a limit
      relaxed = false;     ///< whether no efforts within the limits meet the request
  double theta_r_error = 0;        ///< max |theta_r - its reference| [rad, m]
  double configuration_error = 0;  ///< the same for all joints and the base [rad, m]
  double position_error = 0;       ///< distance of the end effector from its place [m]
  double deflection_error = 0;     ///< distance of the end effector from where the planned wrench
                                   ///< bends the cell to [m, rad]
  double violation = 0;            ///< how far efforts or rates exceed their limits [N, N m, N/s]
  double off_axis_force = 0,       ///< force of h_e across c: deviation from the planned one [N]
      off_axis_torque = 0;         ///< torque of h_e across c, likewise [N m]
  double speed = 0;                ///< how far joints exceed their speed limits [rad/s, m/s]
  double angle = 0;                ///< rotation of the end effector since the start [rad]
  Eigen::VectorXd theta_r;         ///< redundant coordinates (r)
};

/// The summary of an experiment in time. Times are those of samples [s].
struct MotionSummary {
  double t_low = 0,           ///< time of the lowest reading
      t_high = 0;             ///< time of the highest reading
  double at_peak = 0;         ///< of an impulse: the reading at t_h; otherwise NaN
  double deviation = 0;       ///< largest difference of reading and planned wrench [N, N m]
  double off_axis_force = 0,  ///< largest deviation of the force across c, if it is not free [N]
      off_axis_torque = 0;    ///< largest deviation of the torque across c, likewise [N m]
  double speed = 0;           ///< largest `TankSample::speed` [rad/s, m/s]
  int violations = 0;         ///< samples that exceed a limit of effort, rate or speed
};

/// What the cell reads after the last actuator failed, to the end of the hold or of the motion.
struct AfterDeaths {
  double t = 0;     ///< when it failed [s]
  double mean = 0,  ///< mean of c'h_e after the transient [N, N m]; NaN: none is left
      low = 0,      ///< lowest c'h_e, in the transient as well
      high = 0,     ///< highest c'h_e
      last = 0;     ///< c'h_e at the end
  double configuration_error = 0;  ///< largest `TankSample::configuration_error` [rad, m]
};

/// The summary of the hold of an experiment.
///
/// Numbers are NaN if there was no hold, and leave out transients (kTransient). If the posture was
/// lost, the largest errors include that instant. For a task in time the hold is the whole
/// experiment.
struct TankSummary {
  double planned = 0;           ///< planned wrench c'h [N, N m]
  double mean = 0,              ///< mean of c'h_e [N, N m]
      low = 0,                  ///< lowest c'h_e
      high = 0;                 ///< highest c'h_e
  Vector6d across;              ///< mean of h_e less its part along c [N; N m]
  double theta_r_error = 0,     ///< largest `TankSample::theta_r_error` [rad, m]
      configuration_error = 0;  ///< largest `TankSample::configuration_error` [rad, m]
  double position_error = 0;    ///< largest `TankSample::position_error` [m]
  double deflection_error = 0;  ///< largest `TankSample::deflection_error` [m, rad]
  double violation = 0;  ///< largest `TankSample::violation` of the whole experiment [N, N m, N/s]
  double saturated = 0,  ///< fraction of the periods with an effort at a limit
      relaxed = 0;       ///< fraction of the periods in which no efforts meet the request
  double shortfall = 0;  ///< mean `TankSample::shortfall` [N, N m]
  bool lost = false;     ///< whether the posture was lost, which ended it (see kLost)
  bool held = false;     ///< whether the wrench was held
  std::string missed;    ///< why not, each value with the largest that is allowed
  std::optional<MotionSummary> motion;  ///< summary of a task in time; none for a static one
  /// What follows the last death; none without one, or if it comes after the hold.
  std::optional<AfterDeaths> after;
};

/// The record of an experiment.
///
/// The status is kReached if the experiment ran to its end, or until the posture was lost.
/// Otherwise the reason says why it ended early: kBudgetExhausted after an interruption.
struct TankRun : Verdict {
  std::vector<TankSample> samples;  ///< one for each period
  TankSummary summary;              ///< summary of the hold
  long requests = 0,                ///< number of tracking programs
      active_set_iterations = 0,    ///< iterations of their active-set method
      evaluations = 0;              ///< evaluations of the derivative
  double model_s = 0,               ///< time in derivatives [s]
      controller_s = 0,             ///< time in tau_c [s]
      qp_s = 0,                     ///< time in the tracking program [s]
      total_s = 0;                  ///< time in all [s]; the rest is that of the integrator
};

/// The largest error of the mean reading of a wrench that counts as held, relative to the planned
/// c'h.
///
/// It applies along c. Unless the task leaves them to the environment, it also applies to all
/// components across c (see kHeldLever). The posture must satisfy kHeldThetaRError, the end
/// effector kHeldPosition, and efforts and rates kHeldViolation. The wrench of a load is the wrench
/// that carries and accelerates it: a load that falls is not held.
inline constexpr double kHeldWrenchError = 0.02;
/// The largest error of the whole posture of a wrench that counts as held: 0.6 degrees [rad, m].
inline constexpr double kHeldThetaRError = 0.01;
/// The largest distance of the end effector from where the planned wrench bends the cell to, of a
/// wrench that counts as held [m, rad].
inline constexpr double kHeldPosition = 0.01;
/// The largest violation of effort and rate limits of a wrench that counts as held: the error that
/// the integrator leaves [N, N m, N/s].
inline constexpr double kHeldViolation = 1e-3;
/// The length of the transient after an actuator failed, times the bandwidth of the controller.
///
/// It begins with the failure, and its length counts from when the controller notices it. An error
/// that falls with critical damping is then 0.3 % of what it was. Readings and errors of the
/// transient do not count for the hold, unless the posture is lost; those after it do.
inline constexpr double kTransient = 8;
/// The lever that compares forces and torques across c [m]: about the size of a hand.
///
/// Beside a planned force, a torque counts as the force at this lever. Beside a planned torque, a
/// force counts as its torque at this lever.
inline constexpr double kHeldLever = 0.1;
/// The distance [rad, m] from its reference at which the posture is lost, which ends the
/// experiment.
inline constexpr double kLost = 0.5;

/// Runs a static experiment.
///
/// A fraction s of the wrench increases from zero to one in the ramp, remains, and decreases. The
/// efforts follow the planned u* by the tracking program (lib/tank/effort_tracking.h) for tau_c:
///
///     u* = (1 - s) u_0 + s u
///     tau_c = C v + D v + g + s J'h + M a,   a = A_r (omega^2 e_r - 2 omega theta_r_dot)
///
/// where u_0 are the efforts at rest, e_r the errors of theta_r and omega the bandwidth.
/// Accelerations along A_r leave the end effector in place, so the reading is the planned wrench.
/// With kAny the rows of the balance are those combinations to which the wrenches across c do not
/// contribute.
///
/// A load is part of the mass matrix and the weight of the robot from the start; its support
/// releases it during the ramp. Then a = omega^2 e - 2 omega v acts on all velocities, with e the
/// errors of base and joints.
///
/// @param problem     the task
/// @param posture     the posture to hold
/// @param target  the wrench to exert, and its efforts
/// @param integrator  a stiff integrator
/// @param options     ramp, hold, load and others
/// @return samples and summary
/// @throws std::invalid_argument as both `check`.
TankRun run_tank(const Problem& problem, const Posture& posture, const TargetWrench& target,
                 Integrator& integrator, const TankOptions& options);

/// How the instants of a trajectory are joined.
enum class Interpolation {
  kLinear,  ///< the instants of the scheme; theta_r and efforts are linear in between, as in the
            ///< paper
  kSpline   ///< the clamped spline through the knots, with efforts at the instants of
            ///< `value_between_knots`
};
/// Returns the name of an interpolation: "linear" or "spline".
const char* to_string(Interpolation interpolation);
/// Returns the interpolation with this name.
///
/// @throws std::invalid_argument that lists both names.
Interpolation parse_interpolation(const std::string& name);

/// What the tank carries out: a trajectory joined in time.
///
/// The requested wrench is smaller than that of the trajectory by the margin. The efforts are those
/// that the lower level finds for this wrench. Include maxwrench/trajectory.h to use it.
struct TankScript : Verdict {
  Path path = Path::constant({}, 1);  ///< path of the load cell that holds the end effector
  std::vector<Instant> instants;      ///< instants, t from 0 to T; u and h as requested
  Interpolation interpolation = Interpolation::kSpline;  ///< how the instants are joined
  Wrench wrench = Wrench::kPure;                         ///< the allowed wrenches
  double planned = 0;  ///< planned wrench along c, of an impulse at t_h [N, N m]
  double margin = 0;   ///< fraction of it that is not requested
  double t_h = std::numeric_limits<double>::quiet_NaN();  ///< time of the peak of an impulse [s]
  double slack = 0;  ///< largest slack of the balance [N, N m]; 0 if efforts exert the wrench
};

/// The options of `make_script`.
struct ScriptOptions {
  Interpolation interpolation = Interpolation::kSpline;  ///< how the instants are joined
  double planned = 0;     ///< wrench along c [N, N m]; zero: the value, or on the spline
                          ///< `value_between_knots`
  double margin = 0.005;  ///< as `TankOptions::margin`
  /// Time constant of the thrusters for which the commands of the efforts must be within their
  /// limits [s], if it is longer than that of the task.
  double thruster_lag = 0;
};
/// Checks the options of a script.
///
/// @throws std::invalid_argument unless `planned` and `thruster_lag` are finite and not negative,
/// and
///         0 <= margin < 1.
void check(const ScriptOptions& options);

/// Returns the planned wrench along c of a script: that of the options, or the value of the
/// trajectory. Of a list of scenarios it is a factor. NaN if there is none.
double planned_wrench(const Trajectory& trajectory, const ScriptOptions& options);

/// Finds efforts that exert exactly the requested wrench.
///
/// The request is c'h = (1 - margin) planned: along a path at all instants, in an impulse at t_h.
/// The efforts solve the elastic program of the trajectory,
///
///     B u_i - J_i'h_i (+ s_i) = tau_d,i,   u_min <= u_i <= u_max,   |u_i+1 - u_i| <= du_max dt.
///
/// Along a path, the knots of the scheme `forward` are T/(k-1) apart here, as their poses are.
/// With a single knot the end effector stays where the path starts.
///
/// @param problem     the task in time
/// @param trajectory  an evaluated trajectory; for kSpline, `evaluate_between_knots` was called too
/// @param wrench      the allowed wrenches
/// @param solver      solves the elastic program
/// @param options     interpolation, planned wrench and margin
/// @return the script; kInfeasible if the trajectory has no value and no wrench was given
/// @throws std::invalid_argument as `check`.
TankScript make_script(const Problem& problem, const Trajectory& trajectory, Wrench wrench,
                       TrajectorySolver& solver, const ScriptOptions& options);

/// The largest error of the reading in time that counts as held, relative to the planned c'h.
///
/// It applies all along a path, or at t_h of an impulse. The whole posture must satisfy
/// kTrackedConfigurationError, and the end effector kHeldPosition. No sample may exceed a limit of
/// effort, rate or joint speed.
inline constexpr double kTrackedWrenchError = 0.03;
/// The largest error [rad, m] of the whole posture in time that counts as held: twice that of a
/// hold.
inline constexpr double kTrackedConfigurationError = 0.02;

/// Runs an experiment in time along a script, for the duration of the script.
///
/// The load cell that holds the end effector moves along the path. It reads the wrench in axes that
/// turn with it, which are those of the world at the start. The load is on at the start: the end
/// effector is where the wrench bends the cell to, theta_r is at its first value and at rest, and
/// the efforts are those of the first instant. Later efforts follow those of the script by the
/// tracking program for
///
///     tau_c = M a + C v + D v + g + J'h
///     theta_r_ddot = that of the script + omega^2 e + 2 omega e_dot
///
/// where a is the acceleration of all velocities that keeps the end effector on the path with this
/// theta_r_ddot, e the errors of theta_r and omega the bandwidth.
///
/// @param problem     the task in time
/// @param script      the script
/// @param integrator  a stiff integrator
/// @param options     of these, ramp, hold, margin, load and until_hold have no effect
/// @return samples and summary
/// @throws std::invalid_argument as both `check`, and if the script has fewer than two instants
/// with
///         efforts.
TankRun run_tank(const Problem& problem, const TankScript& script, Integrator& integrator,
                 const TankOptions& options);

}  // namespace maxwrench
