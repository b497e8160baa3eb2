#pragma once

#include <optional>
#include <string>
#include <vector>

#include "maxwrench/carried.h"
#include "maxwrench/types.h"

/// @file
/// Tasks in time: paths of an end effector, schemes and impulses.

namespace maxwrench {

/// The progress phi(s) along a path, from 0 to 1, at s = t/T in [0, 1].
enum class Timing {
  kCubic,    ///< phi(s) = 3 s^2 - 2 s^3: at rest at both ends
  kQuintic,  ///< phi(s) = 10 s^3 - 15 s^4 + 6 s^5: at rest and without acceleration at both ends
  kLinear    ///< phi(s) = s
};

/// The end effector at one instant of a path.
struct PathPoint {
  Pose<double> pose;  ///< pose in the world
  /// Twist [linear; angular] at its origin, in world axes [m/s; rad/s].
  Vector6d twist = Vector6d::Zero();
  Vector6d acceleration = Vector6d::Zero();  ///< derivative of the twist [m/s^2; rad/s^2]
};

/// The data of a path that rotates about an axis and translates; see `Path::screw`.
struct ScrewPath {
  Pose<double> start;                               ///< the pose at t = 0
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ(),  ///< the axis, a unit vector
      centre = Eigen::Vector3d::Zero(),             ///< a point on the axis [m]
      displacement = Eigen::Vector3d::Zero();       ///< the translation [m]
  double angle = 0;                                 ///< the rotation [rad]
  Timing timing = Timing::kCubic;                   ///< how both progress
};

/// The poses of an end effector over time, 0 <= t <= duration.
///
/// Earlier and later times give the values at the ends.
class Path {
 public:
  /// Makes a path that rotates about an axis and translates: a rotation in place, an arc, a line or
  /// a screw.
  ///
  /// All arguments are in the world.
  ///
  /// @param start         the pose at t = 0
  /// @param axis          the axis, a unit vector
  /// @param centre        a point on the axis [m]
  /// @param angle         the rotation is `angle` times phi [rad]
  /// @param displacement  the translation is `displacement` times phi [m]
  /// @param timing        phi
  /// @param duration      the duration [s], positive
  static Path screw(const Pose<double>& start, const Eigen::Vector3d& axis,
                    const Eigen::Vector3d& centre, double angle,
                    const Eigen::Vector3d& displacement, Timing timing, double duration);
  /// Makes a path that rests at one pose for `duration` seconds.
  static Path constant(const Pose<double>& pose, double duration);
  /// Makes a path through given poses.
  ///
  /// It is the clamped cubic spline (at rest at both ends) of the positions and of the quaternions,
  /// which are then normalised.
  ///
  /// @param times  at least two times that increase from 0 [s]
  /// @param poses  one pose for each time, each rotated by less than pi from the previous one
  /// @throws std::invalid_argument otherwise.
  static Path spline(const std::vector<double>& times, const std::vector<Pose<double>>& poses);

  /// Returns the end effector at the time t [s].
  ///
  /// Twist and acceleration are exact derivatives of the pose.
  PathPoint at(double t) const;
  /// Returns the pose at the time t [s].
  Pose<double> pose(double t) const { return at(t).pose; }
  /// Returns the duration [s].
  double duration() const { return duration_; }
  /// Returns the rotation about one axis from start to end [rad]; 0 for splines and lines.
  double angle() const { return angle_; }
  /// Returns the data of a path that `screw` or `constant` made; nothing for a spline.
  std::optional<ScrewPath> as_screw() const {
    if (!times_.empty()) return std::nullopt;
    return ScrewPath{start_, axis_, centre_, displacement_, angle_, timing_};
  }

 private:
  friend struct PathMembers;  ///< stores paths
  Path() = default;
  PathPoint on_spline(double t) const;

  Pose<double> start_;
  Eigen::Vector3d axis_ = Eigen::Vector3d::UnitZ(), centre_ = Eigen::Vector3d::Zero(),
                  displacement_ = Eigen::Vector3d::Zero();
  double angle_ = 0, duration_ = 1;
  Timing timing_ = Timing::kCubic;
  // Of a spline: values [p; quaternion] 7×N at the times, and their second derivatives.
  std::vector<double> times_;
  Eigen::Matrix<double, 7, Eigen::Dynamic> values_, bends_;
};

/// How knots of theta_r become a motion at instants.
enum class Scheme {
  kForward,      ///< rates are forward differences of the knots; for paths and impulses
  kEnds,         ///< as kForward, and at rest at both ends; for paths only
  kSpline,       ///< the clamped cubic spline through the knots; for paths and impulses
  kBackward,     ///< rates are backward differences of the knots; for impulses only
  kBackwardStop  ///< as kBackward, and at rest at the end; for impulses only
};
/// Returns the name of a scheme, such as "backward_stop".
const char* to_string(Scheme scheme);
/// Returns the scheme with this name.
///
/// @throws std::invalid_argument that lists all names.
Scheme parse_scheme(const std::string& name);
/// Returns the names of the schemes for impulses (true) or for paths (false).
std::vector<std::string> scheme_names(bool impulse);

/// The start of an impulse: efforts u_0 and a wrench w_0 >= 0 along c at theta_0.
enum class Start {
  kStatic,  ///< in balance, w_0 at most the static capability
  kRest,    ///< in balance, w_0 = 0
  kZero,    ///< u_0 = 0, without balance
  kFree     ///< any u_0 within its limits
};
/// Returns the name of a start: "static", "rest", "zero" or "free".
const char* to_string(Start start);
/// Returns the start with this name.
///
/// @throws std::invalid_argument that lists all names.
Start parse_start(const std::string& name);

/// A task in time.
///
/// It is a wrench along a path ("Wrench Maximisation over a Trajectory"), or a peak wrench in an
/// impulse at a pose ("Maximum Wrench Impulse"). Or it is a transfer of a payload from one posture
/// to another, at rest at both, with free motion in between.
struct MotionTask {
  bool impulse = false;               ///< whether the task is an impulse
  bool transfer = false;              ///< whether the task is a transfer
  Path path = Path::constant({}, 1);  ///< the path; at rest for an impulse
  std::string path_file;              ///< file with the poses of the path; empty if there is none
  double T = 1;                       ///< duration [s]
  /// Number of knots of theta_r, without knot 0 of an impulse, with both ends of a transfer.
  int k = 1;
  Scheme scheme = Scheme::kSpline;  ///< how the knots become a motion
  int instants_per_interval = 4;    ///< for the scheme `spline`; 16 in an impulse
  bool rates = true;                ///< whether the rate limits of efforts apply
  /// Whether a collision at any instant counts, not only at knots. `solve_proven` sets it where
  /// bodies come too close to each other between knots.
  bool clear_at_instants = false;
  /// Time constant of the thrusters for which their commands must be within the limits [s]. Zero:
  /// the thrust equals the command.
  double thruster_lag = 0;
  /// Whether c and W_any turn with the end effector. Those of the problem are valid at the start.
  bool c_turns = false;
  int t_h = 0;  ///< impulse only: the knot of the peak, 1 .. k; 0: the best one is chosen
  Start start = Start::kStatic;  ///< impulse only: how it starts
  Eigen::VectorXd theta_0;       ///< of an impulse or a transfer: theta_r at the start (r)
  Eigen::VectorXd theta_T;       ///< of a transfer: theta_r at the end (r)
  /// The payload of a path or a transfer, whose mass [kg] is the value: one mass at all instants.
  std::optional<CarriedBody> payload;
  /// Wrenches over time in place of c. The value is the factor by which all of them are exerted:
  /// one factor at all instants.
  std::optional<WrenchTable> table;

  /// Returns whether one factor holds at all instants.
  bool has_factor() const { return payload.has_value() || table.has_value(); }
};

}  // namespace maxwrench
