#pragma once

#include <array>
#include <memory>

#include "lib/math/decompositions.h"
#include "lib/robot/kinematics.h"
#include "maxwrench/problem.h"

namespace maxwrench {

/// The inverse kinematics of the arm that ends at a problem's contact: all positions of the joints
/// `contact.follow` with which the end effector reaches a target. The other joints of the arm are
/// at rest.
///
/// The solution has a closed form if the target is a point and the dependent joints are revolute
/// and
///
///  * two, about parallel axes (an arm in a plane), or
///  * three, the last two about parallel axes (a shoulder's yaw, its pitch and an elbow), the
///    first about another axis.
///
/// Let a be the unit axis of a joint and o a point on it at zero positions, R(a, q) the rotation, n
/// the common axis of the last two joints, and p_0 the end effector's origin at zero positions. The
/// first joint must bring the target p into the plane in which the other two move the end effector:
/// n'R(a_1, -q_1)(p - o_1) = n'(p_0 - o_1). This is an equation A cos q_1 + B sin q_1 = C with two
/// solutions. The elbow then sets the distance from the axis of the pitch (two solutions), and the
/// pitch sets the direction. So there are up to four solutions.
///
/// Any other arm uses a damped Newton's method from a fixed set of starting positions within the
/// limits. The distinct results are the solutions.
class ContactArm {
 public:
  static constexpr int kMostSolutions = 16;

  /// Keeps a reference to the problem, which must have a contact.
  explicit ContactArm(const Problem& problem);
  explicit ContactArm(const Problem&& problem) = delete;

  bool closed_form() const { return closed_form_; }

  /// Finds all solutions for a target in base axes and returns their number. Revolute joints are
  /// moved into their limits by whole turns where possible. Allocates nothing after the first call.
  int solve(const Pose<double>& target);

  /// The joints of `contact.follow` in solution i [rad or m].
  const Eigen::VectorXd& solution(int i) const { return solutions_[static_cast<std::size_t>(i)]; }

 private:
  /// A dependent joint, in base axes at zero positions of all dependent joints.
  struct Axis {
    Eigen::Vector3d a, o;
  };

  /// The left side of A cos q + B sin q = C, which equals size cos(q - middle).
  struct Cosine {
    Cosine() = default;
    Cosine(double A, double B);
    template <class Use>
    void solve(double C, Use&& use) const;

    double size = 0, middle = 0;
    double c = 1, s = 0;  ///< cosine and sine of middle
  };

  void read_axes();
  void solve_plane(const Eigen::Vector3d& p, double first);
  void solve_shoulder(const Eigen::Vector3d& p);
  void solve_by_newton(const Pose<double>& target);
  bool newton(const Pose<double>& target);
  void linearise(const Pose<double>& target);
  bool same(const Eigen::VectorXd& solution) const;
  void keep();

  const Problem& problem_;
  const Contact& contact_;
  Kinematics<double> kinematics_;
  bool closed_form_ = false;
  std::array<Axis, 3> axes_;
  Eigen::Vector3d p_0_;
  Eigen::Vector3d upper_, fore_;  ///< from the last axis to the one before it, and to p_0
  Cosine elbow_;                  ///< upper'R(q) fore = lengths - (distance of the target)^2 / 2
  double lengths_ = 0;  ///< (upper^2 + fore^2) / 2, both without their parts along the axes
  int count_ = 0;
  std::array<Eigen::VectorXd, kMostSolutions> solutions_;
  Eigen::VectorXd q_, trial_;  ///< all joints; the dependent joints
  Matrix6Xd J_;
  Vector6N error_;
  Matrix6N J_f_;
};

}  // namespace maxwrench
