#pragma once

#include <vector>

#include "lib/math/extended.h"
#include "lib/robot/chain.h"
#include "lib/robot/spatial.h"
#include "maxwrench/path.h"
#include "maxwrench/problem.h"
#include "solvers/certify/trajectory/interval_matrix.h"

namespace maxwrench {

/// What the actuators exert because the robot moves, tau_d less that of rest, while the end
/// effector moves as a given path: from the end effector inward to the base, each link's twist and
/// its rate in the link's own axes; then from link to link towards the base, the forces.
///
/// Tau is the sum of
///
/// * linear terms, M v_dot at v = 0 and linear drag. In base axes they are multi-affine in cosines
///   and sines of theta_r, and linear in the path's motion, in the rates and in the accelerations
///   of theta_r;
/// * quadratic terms, those with products of velocities and quadratic drag.
///
/// A template on the scalar: a number, or an interval.
template <class T>
class InstantLoads {
 public:
  /// What counts: the path's own motion, and the kinds of terms.
  struct Terms {
    bool path = true, linear = true, quadratic = true;
  };

  /// Keeps a reference to the problem, whose base's pose follows in closed form.
  InstantLoads(const Problem& problem, const PathPoint& x)
      : problem_(problem), R_(problem.robot.joints.size()), p_(R_.size()) {
    const Robot& robot = problem.robot;
    for (const Link& link : robot.links) inertia_.push_back(link_inertia(link));
    moving_.assign(R_.size(), -1);
    for (std::size_t k = 0; k < problem.redundant.size(); ++k) {
      moving_[static_cast<std::size_t>(problem.redundant[k])] = static_cast<int>(k);
    }
    const Eigen::VectorXd rest = resting_joints(robot);
    for (std::size_t i = 0; i < R_.size(); ++i) place(i, T(rest[static_cast<Eigen::Index>(i)]));
    twist_.resize(robot.links.size());
    rate_.resize(robot.links.size());
    force_.resize(robot.links.size());
    set_tool(x);
  }

  void set(const VectorX<T>& theta_r) {
    for (std::size_t k = 0; k < problem_.redundant.size(); ++k) {
      place(static_cast<std::size_t>(problem_.redundant[k]), theta_r[static_cast<Eigen::Index>(k)]);
    }
  }

  /// Computes the sum, n numbers, at the rates and accelerations of theta_r.
  void evaluate(const Terms& terms, const VectorX<T>& rates, const VectorX<T>& bends,
                VectorX<T>& tau) {
    move_links(terms, rates, bends);
    for (std::size_t i = 0; i < force_.size(); ++i) force_[i] = force_on(i, terms);
    const Robot& robot = problem_.robot;
    const auto axes = static_cast<Eigen::Index>(robot.base_axes.size());
    tau.resize(robot.velocities());
    for (std::size_t i = R_.size(); i > 0; --i) {
      const Joint& joint = robot.joints[i - 1];
      const Vector3<T> axis = joint.axis.cast<T>();
      const bool turns = joint.type == JointType::kRevolute;
      tau[axes + static_cast<Eigen::Index>(i) - 1] =
          axis.dot(turns ? force_[i].angular : force_[i].linear);
      Screw<T>& parent = force_[static_cast<std::size_t>(joint.parent)];
      const Vector3<T> linear = R_[i - 1] * force_[i].linear;
      parent.linear += linear;
      parent.angular += Vector3<T>(R_[i - 1] * force_[i].angular) + cross(p_[i - 1], linear);
    }
    for (Eigen::Index k = 0; k < axes; ++k) {
      tau[k] = component(force_[0], robot.base_axes[static_cast<std::size_t>(k)]);
    }
  }

 private:
  static Vector3<T> cross(const Vector3<T>& a, const Vector3<T>& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  /// Sets the pose of a joint's link relative to the link that carries it.
  void place(std::size_t i, const T& q) {
    const Joint& joint = problem_.robot.joints[i];
    const Matrix3<T> placed = joint.placement.R.cast<T>();
    const Vector3<T> at = joint.placement.p.cast<T>();
    if (joint.type != JointType::kRevolute) {
      const Vector3<T> axis = joint.axis.cast<T>();
      R_[i] = placed;
      p_[i] = at + Vector3<T>(placed * Vector3<T>(axis * q));
      return;
    }
    const auto [c, s] = cos_sin_of(q);
    const Eigen::Matrix3d K = skew(joint.axis), KK = K * K;
    const T v = T(1.0) - c;
    Matrix3<T> turn = Eigen::Matrix3d(Eigen::Matrix3d::Identity()).cast<T>();
    for (Eigen::Index a = 0; a < 3; ++a) {
      for (Eigen::Index b = 0; b < 3; ++b) turn(a, b) += s * T(K(a, b)) + v * T(KK(a, b));
    }
    R_[i] = placed * turn;
    p_[i] = at;
  }

  /// The twist and its rate of the end effector's link, in its axes; `swept_` is the part of the
  /// rate that is quadratic: components in moving axes change because the axes turn.
  void set_tool(const PathPoint& x) {
    const EndEffector& tip =
        problem_.robot.end_effectors[static_cast<std::size_t>(problem_.end_effector)];
    const Matrix3<T> into = x.pose.R.transpose().cast<T>();
    const auto in_tool = [&](const Vector6d& of) -> Screw<T> {
      return {Vector3<T>(into * Vector3<T>(of.head<3>().cast<T>())),
              Vector3<T>(into * Vector3<T>(of.tail<3>().cast<T>()))};
    };
    const Matrix3<T> R = tip.placement.R.cast<T>();
    const Vector3<T> p = tip.placement.p.cast<T>();
    const auto in_link = [&](const Screw<T>& of) { return outward(R, p, of); };
    const Screw<T> twist = in_tool(x.twist);
    const Vector3<T> swept = cross(twist.linear, twist.angular);
    tool_twist_ = in_link(twist);
    tool_rate_ = in_link(in_tool(x.acceleration));
    swept_ = in_link({swept, Vector3<T>::Zero()});
  }

  /// A twist at the origin p and in the axes R of a frame, at the origin and in the axes that the
  /// frame is relative to.
  static Screw<T> outward(const Matrix3<T>& R, const Vector3<T>& p, const Screw<T>& twist) {
    const Vector3<T> angular = R * twist.angular;
    return {Vector3<T>(R * twist.linear) + cross(p, angular), angular};
  }
  /// The inverse.
  static Screw<T> inward(const Matrix3<T>& R, const Vector3<T>& p, const Screw<T>& twist) {
    const Matrix3<T> back = R.transpose();
    return {Vector3<T>(back * Vector3<T>(twist.linear + cross(twist.angular, p))),
            Vector3<T>(back * twist.angular)};
  }

  /// With the twist nu of a joint's link in its axes and the joint's unit twist S, the link that
  /// carries it has, in the same axes, the twist nu - S q_dot and the rate nu_dot - S q_ddot + [S
  /// q_dot, nu].
  void move_links(const Terms& terms, const VectorX<T>& rates, const VectorX<T>& bends) {
    const Robot& robot = problem_.robot;
    const EndEffector& tip = robot.end_effectors[static_cast<std::size_t>(problem_.end_effector)];
    const Screw<T> still;
    auto link = static_cast<std::size_t>(tip.link);
    std::vector<char>& known = known_;
    known.assign(robot.links.size(), 0);
    twist_[link] = terms.path ? tool_twist_ : still;
    rate_[link] = terms.path && terms.linear ? tool_rate_ : still;
    if (terms.path && terms.quadratic) {
      rate_[link].linear += swept_.linear;
      rate_[link].angular += swept_.angular;
    }
    known[link] = 1;
    while (link != 0) {
      const Joint& joint = robot.joints[link - 1];
      Screw<T> twist = twist_[link], rate = rate_[link];
      if (const int k = moving_[link - 1]; k >= 0) {
        const Vector3<T> axis = joint.axis.cast<T>();
        const Vector3<T> speed = axis * rates[k], bend = axis * bends[k];
        const bool turns = joint.type == JointType::kRevolute;
        if (terms.quadratic) {
          rate.linear += cross(speed, turns ? twist.linear : twist.angular);
          if (turns) rate.angular += cross(speed, twist.angular);
        }
        (turns ? twist.angular : twist.linear) -= speed;
        if (terms.linear) (turns ? rate.angular : rate.linear) -= bend;
      }
      const auto parent = static_cast<std::size_t>(joint.parent);
      twist_[parent] = outward(R_[link - 1], p_[link - 1], twist);
      rate_[parent] = outward(R_[link - 1], p_[link - 1], rate);
      known[parent] = 1;
      link = parent;
    }
    for (std::size_t i = 1; i < known.size(); ++i) {
      if (known[i] != 0) continue;
      const auto parent = static_cast<std::size_t>(robot.joints[i - 1].parent);
      twist_[i] = inward(R_[i - 1], p_[i - 1], twist_[parent]);
      rate_[i] = inward(R_[i - 1], p_[i - 1], rate_[parent]);
    }
  }

  Screw<T> momentum_of(std::size_t i, const Screw<T>& twist) const {
    const Inertia<double>& of = inertia_[i];
    const Matrix3<T> A = of.A.cast<T>(), B = of.B.cast<T>(), C = of.C.cast<T>();
    return {Vector3<T>(A * twist.linear) + Vector3<T>(B * twist.angular),
            Vector3<T>(B.transpose() * twist.linear) + Vector3<T>(C * twist.angular)};
  }

  /// The force on a link in its axes: the rate of its momentum, and drag.
  Screw<T> force_on(std::size_t i, const Terms& terms) const {
    Screw<T> force = momentum_of(i, rate_[i]);
    if (terms.quadratic) {
      const Screw<T> P = momentum_of(i, twist_[i]);
      const Screw<T>& nu = twist_[i];
      force.linear += cross(nu.angular, P.linear);
      force.angular += cross(nu.angular, P.angular) + cross(nu.linear, P.linear);
    }
    for (const HydrodynamicBody& body : problem_.robot.links[i].hydrodynamics) {
      const Matrix3<T> R = body.frame.R.cast<T>();
      const Vector3<T> p = body.frame.p.cast<T>();
      const Screw<T> nu = inward(R, p, twist_[i]);
      const auto drag = [&](const Vector3<T>& x, Eigen::Index first) {
        Vector3<T> sum = Vector3<T>::Zero();
        for (Eigen::Index k = 0; k < 3; ++k) {
          if (terms.linear) sum[k] += T(body.damping_linear[first + k]) * x[k];
          if (terms.quadratic) {
            sum[k] += T(body.damping_quadratic[first + k]) * signed_square_of(x[k]);
          }
        }
        return sum;
      };
      const Vector3<T> linear = R * drag(nu.linear, 0);
      force.linear += linear;
      force.angular += Vector3<T>(R * drag(nu.angular, 3)) + cross(p, linear);
    }
    return force;
  }

  const Problem& problem_;
  std::vector<Inertia<double>> inertia_;
  std::vector<int> moving_;    ///< for each joint its place in theta_r, or -1
  std::vector<Matrix3<T>> R_;  ///< of each joint's link, in the axes of the link that carries it
  std::vector<Vector3<T>> p_;
  Screw<T> tool_twist_, tool_rate_, swept_;
  std::vector<Screw<T>> twist_, rate_, force_;  ///< of each link, in its axes at its origin
  std::vector<char> known_;
};

}  // namespace maxwrench
