#pragma once

#include <optional>
#include <string>
#include <vector>

#include "maxwrench/problem.h"
#include "verify/trajectory/knot_curve.h"
#include "verify/trajectory/narrow_box.h"

namespace maxwrench {

/// Why a motion does not satisfy its limits; `reason` is empty if it does.
struct MotionFault {
  std::string reason;
  double t = -1;  ///< the instant [s]
};

/// The reason of a fault.
inline constexpr const char* kNotEnclosed = "the dependent joints may have no solution or several";

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
///
/// Dependent joints solve equations: the base stays on its free axes. A tube of boxes in time
/// contains one continuous solution, by Krawczyk's test in each box. The jets of the joints then
/// follow from those of the equations, coefficient by coefficient.
class TrajectoryModel {
 public:
  /// Keeps a reference to the problem.
  ///
  /// @param problem    a task for which `require_provable` does not throw
  /// @param table      its knots (k×r), without theta_0 of an impulse
  /// @param dependent  near which the dependent joints are (joints×places), at places that cut
  ///                   each interval into equal parts; empty without such joints
  explicit TrajectoryModel(const Problem& problem, const Eigen::MatrixXd& table,
                           const Eigen::MatrixXd& dependent = {});
  TrajectoryModel(const Problem&&, const Eigen::MatrixXd&, const Eigen::MatrixXd& = {}) = delete;

  /// Where the dependent joints could not be enclosed; nothing else is valid then.
  const MotionFault& lost() const { return lost_; }

  const Problem& problem() const { return problem_; }
  const KnotCurve& curve() const { return curve_; }
  /// [s] The time of a place.
  double time(int interval, double x) const {
    return problem_.motion->T * (interval + x) / curve_.intervals();
  }

  /// Encloses the loads for all x of an interval, in [0, 1]. N is the order of the joints' jets: 3
  /// gives loads with their rate, 4 also with half of their second derivative. Empty if the
  /// dependent joints are not enclosed; narrower x may be.
  template <int N>
  std::optional<MotionLoads<N - 2>> loads(int interval, const Narrow& x) const;

  /// Poses of all links relative to the base, in ordinary arithmetic, near where they are at x.
  std::vector<Pose<double>> links(int interval, double x) const;
  /// Whether a joint is one of theta_r or depends on it; the others rest at `rest`.
  bool moves(std::size_t joint) const {
    return coordinate_of_[joint] >= 0 || dependent_of_[joint] >= 0;
  }
  const std::vector<double>& rest() const { return rest_; }
  /// [rad or m] How far each joint can be, between x_0 and x_1, from where `links` has it in the
  /// middle. Infinite where dependent joints are not enclosed.
  std::vector<double> moved_from_middle(int interval, double x_0, double x_1) const;
  /// The dependent joints for all x of an interval: position, rate and more. Empty if they are not
  /// enclosed; narrower x may be.
  std::optional<std::vector<Jet<3>>> dependent(int interval, const Narrow& x) const {
    return dependent_jets<3>(interval, x);
  }

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
  std::optional<Motion<N>> move(int interval, const Narrow& x) const;
  template <int N>
  void move_tool(int interval, const Narrow& x, Motion<N>& motion) const;
  /// The jets of all joints. `joints_of_theta_r` leaves the dependent ones at rest.
  template <int N>
  std::vector<Jet<N>> joints_of_theta_r(int interval, const Narrow& x) const;
  template <int N>
  std::optional<std::vector<Jet<N>>> joints(int interval, const Narrow& x) const;
  /// The positions of all joints.
  NarrowBox positions(int interval, const Narrow& x) const;
  template <int N>
  Frame<N> joint_frame(std::size_t joint, const Jet<N>& q) const;
  /// The outer frame, from a frame at `in` inside it.
  template <int N>
  static Frame<N> outer(const Frame<N>& inner, const Frame<N>& in) {
    Frame<N> frame;
    frame.R = inner.R * transposed(in.R);
    frame.p = inner.p - frame.R * in.p;
    return frame;
  }
  template <int N>
  Frame<N> tool_link(const Frame<N>& tool) const;
  template <int N>
  Frame<N> base_of(const Frame<N>& tool, const std::vector<Jet<N>>& q) const;
  /// The base's pose in the axes of its mount.
  template <int N>
  Frame<N> from_mount(const Frame<N>& base) const;
  template <int N>
  Wrenches<N - 2> force_on(std::size_t link, const Frame<N>& at) const;
  template <int N>
  std::vector<Jet<N>> project(std::vector<Wrenches<N>> on_links,
                              const std::vector<Frame<N>>& links) const;
  template <int N>
  std::vector<Jet<N>> off_axes(const Frame<N>& base) const;

  /// Part of an interval, and the box in which the dependent joints are there.
  struct TubeCell {
    double from, to;
    NarrowBox q;
  };
  /// The end effector and the joints at any one place of a stretch of time.
  struct Place {
    Frame<1> tool;
    std::vector<Jet<1>> q;
  };

  Place place_at(int interval, const Narrow& x) const;
  /// The equations at the given dependent joints: numbers that vanish while the base is on its free
  /// axes.
  template <int N>
  std::vector<Jet<N>> equations(const Frame<N>& tool, std::vector<Jet<N>> q,
                                const std::vector<Jet<N>>& dependent) const;
  std::vector<NarrowBox> equation_slopes(const Place& at, const NarrowBox& X) const;
  std::optional<NarrowBox> krawczyk(const Place& at, const NarrowBox& X) const;
  std::optional<NarrowBox> enclose(const Place& at, const Eigen::VectorXd& near) const;
  Eigen::VectorXd newton(const Place& at, Eigen::VectorXd q) const;
  bool is_upright(const Place& at, const NarrowBox& X) const;
  void make_tube(const Eigen::MatrixXd& dependent);
  bool make_cells(int interval, double from, double to, const Eigen::VectorXd& near, int halvings);
  void join_cells();
  /// A box that contains the dependent joints at all x, which are those of `at`.
  NarrowBox dependent_box(int interval, const Narrow& x, const Place& at) const;
  template <int N>
  std::optional<std::vector<Jet<N>>> dependent_jets(int interval, const Narrow& x) const;

  const Problem& problem_;
  ScrewPath path_;
  KnotCurve curve_;
  std::vector<int> coordinate_of_, dependent_of_;  ///< of each joint; -1: none
  std::vector<double> rest_;
  std::vector<int> inward_;                  ///< links from that of the end effector to the base
  std::vector<std::vector<TubeCell>> tube_;  ///< of each interval
  MotionFault lost_;
};

}  // namespace maxwrench
