#include "verify/trajectory/trajectory_model.h"

// The forces on the links of a moving robot, and what the actuators exert against them.

namespace maxwrench {
namespace {

template <int N>
JetVector<N> componentwise(const Eigen::Vector3d& a, const JetVector<N>& x) {
  return {Narrow(a[0]) * x[0], Narrow(a[1]) * x[1], Narrow(a[2]) * x[2]};
}

/// The rotation rate w in a body's own axes: the skew matrix of R'R_dot.
template <int N>
JetVector<N> skew_part(const JetMatrix<N>& W) {
  return {W[2][1], W[0][2], W[1][0]};
}

/// The twist or momentum of a body in its own axes.
template <int N>
struct LinkScrew {
  JetVector<N> linear, angular;
};

/// The twist of a frame that is fixed in a link.
template <int N>
LinkScrew<N> twist_of(const Pose<double>& frame, const LinkScrew<N>& link) {
  const JetMatrix<N> into = transposed(constant_jets<N>(frame.R));
  return {into * (link.linear + cross(link.angular, constant_jets<N>(frame.p))),
          into * link.angular};
}

/// Adds a momentum or a wrench at a frame of a link, to one at the link's origin.
template <int N>
void add_at(const Pose<double>& frame, const LinkScrew<N>& at, LinkScrew<N>& sum) {
  const JetMatrix<N> R = constant_jets<N>(frame.R);
  const JetVector<N> linear = R * at.linear;
  sum.linear = sum.linear + linear;
  sum.angular = sum.angular + R * at.angular + cross(constant_jets<N>(frame.p), linear);
}

/// The momentum of a link and of the water that it moves.
template <int N>
LinkScrew<N> momentum_of(const Link& link, const LinkScrew<N>& twist) {
  LinkScrew<N> sum;
  const LinkScrew<N> at_com = twist_of<N>({Eigen::Matrix3d::Identity(), link.com}, twist);
  const LinkScrew<N> own = {Jet<N>(link.mass) * at_com.linear,
                            constant_jets<N>(link.inertia) * at_com.angular};
  add_at<N>({Eigen::Matrix3d::Identity(), link.com}, own, sum);
  for (const HydrodynamicBody& body : link.hydrodynamics) {
    const LinkScrew<N> at = twist_of(body.frame, twist);
    const LinkScrew<N> water = {componentwise<N>(body.added_mass.head<3>(), at.linear),
                                componentwise<N>(body.added_mass.tail<3>(), at.angular)};
    add_at(body.frame, water, sum);
  }
  return sum;
}

/// What the actuators exert against the drag of a link.
template <int N>
LinkScrew<N> drag_of(const Link& link, const LinkScrew<N>& twist) {
  LinkScrew<N> sum;
  for (const HydrodynamicBody& body : link.hydrodynamics) {
    const LinkScrew<N> at = twist_of(body.frame, twist);
    const auto drag = [&](const JetVector<N>& x, Eigen::Index first) {
      JetVector<N> force;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto axis = first + static_cast<Eigen::Index>(i);
        force[i] = Narrow(body.damping_linear[axis]) * x[i] +
                   Narrow(body.damping_quadratic[axis]) * signed_square(x[i]);
      }
      return force;
    };
    add_at<N>(body.frame, {drag(at.linear, 0), drag(at.angular, 3)}, sum);
  }
  return sum;
}

template <int N>
JetVector<N> upward(const Narrow& force) {
  return {Jet<N>(0.0), Jet<N>(0.0), Jet<N>(force)};
}

}  // namespace

/// Against weight, buoyancy, inertia and drag. With a current v_c, momentum is that of the twist
/// relative to the water: in axes that move with it, a fixed point moves at -v_c.
template <int N>
auto TrajectoryModel::force_on(std::size_t link, const Frame<N>& at) const -> Wrenches<N - 2> {
  const Robot& robot = problem_.robot;
  const Link& body = robot.links[link];
  const JetMatrix<N - 1> R = shortened<N - 1>(at.R), back = transposed(R);
  const JetVector<N - 1> current = constant_jets<N - 1>(robot.current);
  const LinkScrew<N - 1> twist = {back * (derivative(at.p) - current),
                                  skew_part(back * derivative(at.R))};
  const LinkScrew<N - 1> momentum = momentum_of(body, twist);
  const JetVector<N - 1> P = R * momentum.linear;
  const JetVector<N - 1> H = R * momentum.angular + cross(shortened<N - 1>(at.p), P);
  Wrenches<N - 2> sum{derivative(P), derivative(H)};
  if (!robot.current.isZero(0)) {
    // H is about a fixed point, which the water passes.
    sum.torque = sum.torque - cross(constant_jets<N - 2>(robot.current), shortened<N - 2>(P));
  }
  const JetMatrix<N - 2> turn = shortened<N - 2>(at.R);
  const JetVector<N - 2> origin = shortened<N - 2>(at.p);
  const auto add = [&sum](const JetVector<N - 2>& place, const JetVector<N - 2>& force) {
    sum.force = sum.force + force;
    sum.torque = sum.torque + cross(place, force);
  };
  if (!body.hydrodynamics.empty()) {
    const LinkScrew<N - 2> drag =
        drag_of<N - 2>(body, {shortened<N - 2>(twist.linear), shortened<N - 2>(twist.angular)});
    add(origin, turn * drag.linear);
    sum.torque = sum.torque + turn * drag.angular;
  }
  const auto add_weight = [&](const Eigen::Vector3d& place, const Narrow& mass) {
    if (mass.is_zero()) return;
    add(origin + turn * constant_jets<N - 2>(place), upward<N - 2>(mass * Narrow(robot.gravity)));
  };
  add_weight(body.com, Narrow(body.mass));
  if (body.volume != 0 && robot.water_density != 0) {
    add_weight(body.cob, -(Narrow(robot.water_density) * Narrow(body.volume)));
  }
  if (link == 0 && robot.trim.buoyancy_mass != 0) {
    add_weight(robot.trim.position, -Narrow(robot.trim.buoyancy_mass));
  }
  return sum;
}

template auto TrajectoryModel::force_on<3>(std::size_t, const Frame<3>&) const -> Wrenches<1>;
template auto TrajectoryModel::force_on<4>(std::size_t, const Frame<4>&) const -> Wrenches<2>;

/// Each wrench loads the base and all joints between it and the base.
template <int N>
std::vector<Jet<N>> TrajectoryModel::project(std::vector<Wrenches<N>> on_links,
                                             const std::vector<Frame<N>>& links) const {
  const Robot& robot = problem_.robot;
  const std::size_t axes = robot.base_axes.size();
  std::vector<Jet<N>> rows(axes + robot.joints.size());
  const auto about = [&](std::size_t link) {
    return on_links[link].torque - cross(links[link].p, on_links[link].force);
  };
  for (std::size_t i = robot.joints.size(); i > 0; --i) {
    const Joint& joint = robot.joints[i - 1];
    const JetVector<N> axis = links[i].R * constant_jets<N>(joint.axis);
    const bool turns = joint.type == JointType::kRevolute;
    rows[axes + i - 1] = turns ? dot(axis, about(i)) : dot(axis, on_links[i].force);
    Wrenches<N>& parent = on_links[static_cast<std::size_t>(joint.parent)];
    parent.force = parent.force + on_links[i].force;
    parent.torque = parent.torque + on_links[i].torque;
  }
  const JetMatrix<N> into = transposed(links[0].R);
  const JetVector<N> force = into * on_links[0].force, torque = into * about(0);
  for (std::size_t k = 0; k < axes; ++k) {
    const auto axis = static_cast<std::size_t>(robot.base_axes[k]);
    rows[k] = axis < 3 ? force[axis] : torque[axis - 3];
  }
  return rows;
}

template std::vector<Jet<1>> TrajectoryModel::project(std::vector<Wrenches<1>>,
                                                      const std::vector<Frame<1>>&) const;
template std::vector<Jet<2>> TrajectoryModel::project(std::vector<Wrenches<2>>,
                                                      const std::vector<Frame<2>>&) const;

}  // namespace maxwrench
