#pragma once

#include <optional>
#include <string>
#include <vector>

#include "maxwrench/problem.h"
#include "verify/trajectory/knot_curve.h"

namespace maxwrench {

/// Throws std::invalid_argument, in one line, unless the task is one that proofs in time support: a
/// trajectory or impulse of one contact with at least two knots, a base whose pose has a closed
/// form, a path that rotates about an axis and translates, a wrench along c, and B of full row
/// rank.
void require_provable(const Problem& problem);

/// The same for a task that may have a list of scenarios: each is a task of its own, with a wrench.
void require_provable_task(const Problem& problem);

/// All that the balance of a motion depends on, as jets at a place of the motion.
template <int N>
struct MotionLoads {
  std::vector<Jet<N>> tau_d;    ///< n: forces of the full dynamics [N, N m] (eq:dynamics)
  std::vector<Jet<N>> along_c;  ///< n: J'c
  /// Coordinates of the base that vanish while it is on its free axes; none with six free axes.
  std::vector<Jet<N>> off_axes;
};

/// The motion of a robot on the clamped spline through a table of knots, and its forces.
///
/// The poses of all links in the world are jets. They follow from the end effector's pose inward,
/// and from the base outward. Velocities and accelerations are derivatives of these poses. The
/// force on a link is the rate of its momentum, with the momentum of the water that it moves, and
/// its torque the rate of the angular momentum about a fixed point. No recursion of velocities and
/// no formula for accelerations is needed, so this shares nothing with the dynamics of `lib`.
class TrajectoryModel {
 public:
  /// Keeps a reference to the problem.
  ///
  /// @param problem  a task for which `require_provable` does not throw
  /// @param table    its knots (k×r), without theta_0 of an impulse
  TrajectoryModel(const Problem& problem, const Eigen::MatrixXd& table);
  TrajectoryModel(const Problem&&, const Eigen::MatrixXd&) = delete;

  const Problem& problem() const { return problem_; }
  const KnotCurve& curve() const { return curve_; }
  /// [s] The time of a place.
  double time(int interval, double x) const {
    return problem_.motion->T * (interval + x) / curve_.intervals();
  }

  /// Encloses the loads for all x of an interval, in [0, 1]. N is the order of the joints' jets: 3
  /// gives loads with their rate, 4 also with half of their second derivative.
  template <int N>
  MotionLoads<N - 2> loads(int interval, const Narrow& x) const;

  /// Poses of all links relative to the base, in ordinary arithmetic.
  std::vector<Pose<double>> links(int interval, double x) const;
  /// The coordinate of theta_r that each joint is; -1: it rests at `rest`.
  const std::vector<int>& coordinate_of() const { return coordinate_of_; }
  const std::vector<double>& rest() const { return rest_; }

 private:
  template <int N>
  struct Frame {
    JetMatrix<N> R;
    JetVector<N> p;
  };
  template <int N>
  struct Motion {
    std::vector<Frame<N>> links;  ///< in the world, from the start of the path
    Frame<N> tool;
    JetVector<N> c_force, c_torque;  ///< c in the world
  };
  /// A wrench in world axes, about the origin of the end effector at the start of the path.
  template <int N>
  struct Wrenches {
    JetVector<N> force, torque;
  };

  template <int N>
  Motion<N> move(int interval, const Narrow& x) const;
  template <int N>
  void move_tool(int interval, const Narrow& x, Motion<N>& motion) const;
  template <int N>
  Frame<N> joint_frame(std::size_t joint, int interval, const Narrow& x) const;
  template <int N>
  Wrenches<N - 2> force_on(std::size_t link, const Frame<N>& at) const;
  template <int N>
  std::vector<Jet<N>> project(std::vector<Wrenches<N>> on_links,
                              const std::vector<Frame<N>>& links) const;
  template <int N>
  std::vector<Jet<N>> off_axes(const Frame<N>& base) const;

  const Problem& problem_;
  ScrewPath path_;
  KnotCurve curve_;
  std::vector<int> coordinate_of_;
  std::vector<double> rest_;
  std::vector<int> inward_;  ///< links from that of the end effector to the base
};

}  // namespace maxwrench
