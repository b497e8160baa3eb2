#pragma once

#include <string>
#include <vector>

#include "maxwrench/types.h"

namespace maxwrench {

/// How far along a path the end effector is at s = t/T in [0, 1]: phi(s), from 0 to 1.
enum class Timing {
  kCubic,    ///< 3 s^2 - 2 s^3: at rest at both ends
  kQuintic,  ///< 10 s^3 - 15 s^4 + 6 s^5: without acceleration there either
  kLinear    ///< s
};

/// The end effector at an instant: its pose in the world, its twist [linear; angular] at its origin
/// in world axes, and the derivative of that twist.
struct PathPoint {
  Pose<double> pose;
  Vector6d twist = Vector6d::Zero();         ///< m/s, rad/s
  Vector6d acceleration = Vector6d::Zero();  ///< m/s^2, rad/s^2
};

/// Poses of an end effector in time, 0 <= t <= duration; before and after it is as at the ends.
class Path {
 public:
  /// From `start` turned by `angle` phi about the axis (unit vector) through `centre`, and moved by
  /// `displacement` phi, all in the world: a rotation in place, an arc, a line or a screw.
  static Path screw(const Pose<double>& start, const Eigen::Vector3d& axis,
                    const Eigen::Vector3d& centre, double angle,
                    const Eigen::Vector3d& displacement, Timing timing, double duration);
  /// At rest.
  static Path constant(const Pose<double>& pose, double duration);
  /// Through poses at times that rise from 0: the clamped cubic spline (at rest at both ends) of
  /// the positions and of the quaternions, which are normalised. At least two, each turned by less
  /// than pi from the one before. Throws std::invalid_argument otherwise.
  static Path spline(const std::vector<double>& times, const std::vector<Pose<double>>& poses);

  /// Twist and acceleration are exact derivatives of the pose.
  PathPoint at(double t) const;
  Pose<double> pose(double t) const { return at(t).pose; }
  double duration() const { return duration_; }
  /// Turned by from start to end about one axis [rad]; 0 of splines and lines.
  double angle() const { return angle_; }

 private:
  Path() = default;
  PathPoint on_spline(double t) const;

  Pose<double> start_;
  Eigen::Vector3d axis_ = Eigen::Vector3d::UnitZ(), centre_ = Eigen::Vector3d::Zero(),
                  displacement_ = Eigen::Vector3d::Zero();
  double angle_ = 0, duration_ = 1;
  Timing timing_ = Timing::kCubic;
  // Of a spline: values [p; quaternion] 7×N at the times, and the second derivatives there.
  std::vector<double> times_;
  Eigen::Matrix<double, 7, Eigen::Dynamic> values_, bends_;
};

/// How knots of theta_r become motion at instants. `ends` serves paths only, `backward` and
/// `backward_stop` impulses only.
enum class Scheme { kForward, kEnds, kSpline, kBackward, kBackwardStop };
const char* to_string(Scheme scheme);
/// By its name, such as "backward_stop". Throws std::invalid_argument that names all.
Scheme parse_scheme(const std::string& name);
/// The names of those that serve an impulse, or a path.
std::vector<std::string> scheme_names(bool impulse);

/// What an impulse begins with: efforts u_0 and a wrench w_0 >= 0 along c at theta_0.
enum class Start {
  kStatic,  ///< in balance, w_0 at most the static capability
  kRest,    ///< in balance, w_0 = 0
  kZero,    ///< u_0 = 0, without balance
  kFree     ///< any u_0 within its limits
};
const char* to_string(Start start);
/// As `parse_scheme`.
Start parse_start(const std::string& name);

/// A task in time: a wrench along a path ("Wrench Maximisation over a Trajectory"), or a peak
/// wrench in an impulse at a pose ("Maximum Wrench Impulse").
struct MotionTask {
  bool impulse = false;
  Path path = Path::constant({}, 1);  ///< of an impulse: at rest
  std::string path_file;              ///< of its poses, if it was read from one
  double T = 1;                       ///< s
  int k = 1;                          ///< knots of theta_r, without knot 0 of an impulse
  Scheme scheme = Scheme::kSpline;
  int instants_per_interval = 4;  ///< of `spline`; 16 in an impulse
  bool rates = true;              ///< limits of the rates of efforts hold
  /// c and W_any turn with the end effector; those of the problem hold at the start.
  bool c_turns = false;
  // Of an impulse.
  int t_h = 0;  ///< the knot of the peak, 1 .. k; 0: the best one
  Start start = Start::kStatic;
  Eigen::VectorXd theta_0;  ///< r
};

}  // namespace maxwrench
