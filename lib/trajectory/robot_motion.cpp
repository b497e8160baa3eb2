#include "lib/trajectory/robot_motion.h"

#include "lib/robot/chain.h"

namespace maxwrench {
namespace {

/// The number of derivatives that a number carries.
template <class T>
constexpr std::size_t kDirections = 0;
template <int N>
constexpr std::size_t kDirections<Dual<N>> = N;

double value_of(double x) { return x; }
template <int N>
double value_of(const Dual<N>& x) {
  return x.v;
}

template <class T>
Vector6d values_of(const Vector6<T>& x) {
  return Vector6d::NullaryExpr([&](Eigen::Index i) { return value_of(x[i]); });
}

/// The derivatives in one direction.
template <int N>
Vector6d along(const Vector6<Dual<N>>& x, std::size_t direction) {
  return Vector6d::NullaryExpr([&](Eigen::Index i) { return x[i].d[direction]; });
}

}  // namespace

template <class T>
RobotMotion<T>::RobotMotion(const Problem& problem)
    : problem_(&problem),
      kinematics_(problem.robot),
      chain_(chain_to(problem.robot, problem.end_effector)),
      q_(resting_joints(problem.robot).cast<T>()),
      v_(VectorX<T>::Constant(problem.robot.velocities(), T(0.0))),
      v_dot_(v_) {
  if (problem.dependent.empty()) return;
  const auto axes = static_cast<int>(problem.robot.base_axes.size());
  for (int axis = 0; axis < axes; ++axis) columns_.push_back(axis);
  for (const int joint : problem.dependent) columns_.push_back(axes + joint);
  J_.resize(6, problem.robot.velocities());
}

template <class T>
const EndEffector& RobotMotion<T>::tool() const {
  return problem_->robot.end_effectors[static_cast<std::size_t>(problem_->end_effector)];
}

/// Writes theta_r into a vector whose joints begin at `first`.
template <class T>
void RobotMotion<T>::set_theta_r(const VectorX<T>& values, Eigen::Index first,
                                 VectorX<T>& all) const {
  for (std::size_t k = 0; k < problem_->redundant.size(); ++k) {
    all[first + problem_->redundant[k]] = values[static_cast<Eigen::Index>(k)];
  }
}

/// A frame at r that another frame carries, both relative to the base. With the axis a of the joint
/// between them, which moves with the carrying frame,
///     v += w x r (+ a q_dot),   v_dot += w_dot x r + w x (w x r) (+ 2 w x a q_dot + a q_ddot),
///     w += a q_dot,             w_dot += w x a q_dot + a q_ddot.
template <class T>
auto RobotMotion<T>::along_chain(const Vector3<T>& p_e) const -> Relative {
  const Robot& robot = problem_->robot;
  const auto axes = static_cast<Eigen::Index>(robot.base_axes.size());
  Relative body;
  Vector3<T> origin = Vector3<T>::Zero();
  const auto carry = [&](const Vector3<T>& to) {
    const Vector3<T> r = to - origin;
    const Vector3<T> swept = body.w.cross(r);
    body.v += swept;
    body.v_dot += Vector3<T>(body.w_dot.cross(r)) + Vector3<T>(body.w.cross(swept));
    origin = to;
  };
  for (const int joint : chain_) {
    const auto i = static_cast<std::size_t>(joint);
    carry(kinematics_.links()[i + 1].p);
    const Vector3<T> axis = kinematics_.joint_axis(i);
    const Vector3<T> rate = axis * v_[axes + joint];
    const Vector3<T> bend = axis * v_dot_[axes + joint];
    const Vector3<T> turned = body.w.cross(rate);
    if (robot.joints[i].type == JointType::kRevolute) {
      body.w += rate;
      body.w_dot += turned + bend;
    } else {
      body.v += rate;
      body.v_dot += turned * T(2.0) + bend;
    }
  }
  carry(p_e);
  return body;
}

template <class T>
void RobotMotion<T>::set(const PathPoint& x, const VectorX<T>& theta_r, const VectorX<T>& rate,
                         const VectorX<T>& acceleration) {
  const Robot& robot = problem_->robot;
  const auto axes = static_cast<Eigen::Index>(robot.base_axes.size());
  set_theta_r(theta_r, 0, q_);
  set_theta_r(rate, axes, v_);
  set_theta_r(acceleration, axes, v_dot_);
  kinematics_.set_joints(q_);
  const Pose<T> e = kinematics_.end_effector(tool());
  base_ = x.pose * e.inverse();
  const Relative hand = along_chain(e.p);
  // The end effector's own motion in base axes. Its components also change because the base turns.
  const Matrix3<T> into = base_.R.transpose();
  const Vector3<T> v_e = into * Vector3<double>(x.twist.head<3>());
  const Vector3<T> w_e = into * Vector3<double>(x.twist.tail<3>());
  const Vector3<T> w = w_e - hand.w;
  const Vector3<T> v = v_e - hand.v - Vector3<T>(w.cross(e.p));
  const Vector3<T> w_dot =
      into * Vector3<double>(x.acceleration.tail<3>()) - Vector3<T>(w.cross(w_e)) - hand.w_dot;
  const Vector3<T> v_dot = into * Vector3<double>(x.acceleration.head<3>()) -
                           Vector3<T>(w.cross(v_e)) - hand.v_dot - Vector3<T>(w_dot.cross(e.p)) -
                           Vector3<T>(w.cross(hand.v));
  for (Eigen::Index i = 0; i < axes; ++i) {
    const int axis = robot.base_axes[static_cast<std::size_t>(i)];
    v_[i] = axis < 3 ? v[axis] : w[axis - 3];
    v_dot_[i] = axis < 3 ? v_dot[axis] : w_dot[axis - 3];
  }
}

template <class T>
void RobotMotion<T>::set(const VectorX<T>& theta_r, const VectorX<T>& rate,
                         const VectorX<T>& acceleration) {
  const Robot& robot = problem_->robot;
  const auto axes = static_cast<Eigen::Index>(robot.base_axes.size());
  set_theta_r(theta_r, 0, q_);
  set_theta_r(rate, axes, v_);
  set_theta_r(acceleration, axes, v_dot_);
  kinematics_.set_joints(q_);
  base_ = {robot.mount.R.cast<T>(), robot.mount.p.cast<T>()};
}

template <class T>
ToolMotion<T> RobotMotion<T>::tool_motion() const {
  const Vector3<T> p = kinematics_.end_effector_position(tool());
  Vector6<T> base = Vector6<T>::Constant(T(0.0));
  const auto& axes = problem_->robot.base_axes;
  for (std::size_t i = 0; i < axes.size(); ++i) base[axes[i]] = v_[static_cast<Eigen::Index>(i)];
  const Relative hand = along_chain(p);
  const Vector3<T> v = base.template head<3>(), w = base.template tail<3>();
  ToolMotion<T> motion;
  motion.R = tool_pose().R;
  motion.twist << base_.R * Vector3<T>(v + Vector3<T>(w.cross(p)) + hand.v),
      base_.R * Vector3<T>(w + hand.w);
  motion.acceleration = acceleration();
  return motion;
}

/// Sets J_ at q_ and base_.
template <class T>
void RobotMotion<T>::read_jacobian() {
  kinematics_.set_joints(q_);
  kinematics_.jacobian(tool(), base_.R, J_);
}

/// Sets the derivatives of the base and the dependent joints, which are constants at first: J_d^+
/// times the derivatives of the gap between the pose x and the end effector's pose.
template <class T>
void RobotMotion<T>::correct(const Pose<double>& x) {
  const Robot& robot = problem_->robot;
  const Pose<T> e = base_ * kinematics_.end_effector(tool());
  const Matrix3<T> S = x.R * e.R.transpose();  // the identity plus derivatives [turn]x
  Vector6<T> gap, twist = Vector6<T>::Constant(T(0.0));
  gap << x.p - e.p, S(2, 1), S(0, 2), S(1, 0);
  if constexpr (kDirections < T >> 0) {
    for (std::size_t k = 0; k < kDirections<T>; ++k) {
      const Vector6N y = J_d_.solve(along(gap, k));
      for (std::size_t c = 0; c < columns_.size(); ++c) {
        const std::size_t axes = robot.base_axes.size();
        T& moved = c < axes ? twist[robot.base_axes[c]] : q_[problem_->dependent[c - axes]];
        moved.d[k] = y[static_cast<Eigen::Index>(c)];
      }
    }
  }
  base_.p += Vector3<T>(base_.R * twist.template head<3>());
  base_.R += Matrix3<T>(base_.R * skew(Vector3<T>(twist.template tail<3>())));
}

/// The derivative of the end effector's twist at v_ and v_dot_, in the world.
template <class T>
Vector6<T> RobotMotion<T>::acceleration() const {
  const auto& axes = problem_->robot.base_axes;
  Vector6<T> base = Vector6<T>::Constant(T(0.0)), rate = base, result;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    base[axes[i]] = v_[static_cast<Eigen::Index>(i)];
    rate[axes[i]] = v_dot_[static_cast<Eigen::Index>(i)];
  }
  const Vector3<T> p = kinematics_.end_effector_position(tool());
  const Relative hand = along_chain(p);
  const Vector3<T> v = base.template head<3>(), w = base.template tail<3>();
  const Vector3<T> v_e = v + Vector3<T>(w.cross(p)) + hand.v, w_e = w + hand.w;
  const Vector3<T> w_dot = rate.template tail<3>();
  result << base_.R * Vector3<T>(rate.template head<3>() + Vector3<T>(w_dot.cross(p)) + hand.v_dot +
                                 Vector3<T>(w.cross(hand.v)) + Vector3<T>(w.cross(v_e))),
      base_.R * Vector3<T>(w_dot + hand.w_dot + Vector3<T>(w.cross(w_e)));
  return result;
}

/// Sets the dependent velocities to J_d^+ twist. Returns the largest remaining entry of the twist.
template <class T>
double RobotMotion<T>::solve(const Vector6<T>& twist, VectorX<T>& velocities) const {
  const Vector6N values = J_d_.solve(values_of(twist));
  Vector6<T> left = twist;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const double value = values[static_cast<Eigen::Index>(c)];
    velocities[columns_[c]] = value;
    left -= J_.col(columns_[c]) * T(value);
  }
  if constexpr (kDirections < T >> 0) {
    for (std::size_t k = 0; k < kDirections<T>; ++k) {
      const Vector6N slopes = J_d_.solve(along(left, k));
      for (std::size_t c = 0; c < columns_.size(); ++c) {
        velocities[columns_[c]].d[k] = slopes[static_cast<Eigen::Index>(c)];
      }
    }
  }
  return values_of(left).template lpNorm<Eigen::Infinity>();
}

template <class T>
void RobotMotion<T>::set(const PathPoint& x, const Pose<double>& base, const Eigen::VectorXd& q,
                         const VectorX<T>& theta_r, const VectorX<T>& rate,
                         const VectorX<T>& acceleration) {
  const auto axes = static_cast<Eigen::Index>(problem_->robot.base_axes.size());
  base_ = {base.R.cast<T>(), base.p.cast<T>()};
  q_ = q.cast<T>();
  set_theta_r(theta_r, 0, q_);
  read_jacobian();
  Matrix6N J_d(6, static_cast<Eigen::Index>(columns_.size()));
  for (Eigen::Index c = 0; c < J_d.cols(); ++c) {
    const auto column = J_.col(columns_[static_cast<std::size_t>(c)]);
    for (Eigen::Index i = 0; i < 6; ++i) J_d(i, c) = value_of(column[i]);
  }
  J_d_.compute(J_d);
  if (kDirections < T >> 0) {
    correct(x.pose);
    read_jacobian();
  }
  for (VectorX<T>* each : {&v_, &v_dot_}) each->setConstant(T(0.0));
  set_theta_r(rate, axes, v_);
  twist_missed_ = solve(Vector6<T>(x.twist - Vector6<T>(J_.lazyProduct(v_))), v_);
  set_theta_r(acceleration, axes, v_dot_);
  acceleration_missed_ = solve(Vector6<T>(x.acceleration - this->acceleration()), v_dot_);
}

template class RobotMotion<double>;
template class RobotMotion<Dual<4>>;

RobotMotionTracker::RobotMotionTracker(const Problem& problem)
    : problem_(problem), follower_(problem), q_(problem.robot.joints.size()) {
  if (!problem.dependent.empty()) ik_solution_.emplace(problem);
  transfer_ = problem.motion && problem.motion->transfer;
}

const char* RobotMotionTracker::place(const Pose<double>& x, const Eigen::VectorXd& theta_r) {
  if (!ik_solution_) return nullptr;
  if (!started_) {
    started_ = true;
    const char* const reason = ik_solution_->follow(theta_r);
    if (reason || (x.p == problem_.pose.p && x.R == problem_.pose.R)) return reason;
  }
  return ik_solution_->go_on(theta_r, x);
}

const char* RobotMotionTracker::set(const PathPoint& x, const Eigen::VectorXd& theta_r,
                                    const Eigen::VectorXd& rate,
                                    const Eigen::VectorXd& acceleration) {
  if (transfer_) {
    follower_.set(theta_r, rate, acceleration);
    return nullptr;
  }
  if (!ik_solution_) {
    follower_.set(x, theta_r, rate, acceleration);
    return nullptr;
  }
  const char* const reason = place(x.pose, theta_r);
  q_ = ik_solution_->z().tail(q_.size());
  const Pose<double> base = base_pose(problem_.robot, ik_solution_->z().head<4>());
  follower_.set(x, base, q_, theta_r, rate, acceleration);
  return reason;
}

}  // namespace maxwrench
