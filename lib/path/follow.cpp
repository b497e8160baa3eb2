#include "lib/path/follow.h"

#include "lib/robot/chain.h"

namespace maxwrench {

template <class T>
Follower<T>::Follower(const Problem& problem)
    : problem_(&problem),
      kinematics_(problem.robot),
      chain_(chain_to(problem.robot, problem.end_effector)),
      q_(resting_joints(problem.robot).cast<T>()),
      v_(VectorX<T>::Constant(problem.robot.velocities(), T(0.0))),
      v_dot_(v_) {}

/// A frame at r from another that carries it, both relative to the base: with the axis a of the
/// joint between them, which the carrier takes along,
///     v += w x r (+ a q_dot),   v_dot += w_dot x r + w x (w x r) (+ 2 w x a q_dot + a q_ddot),
///     w += a q_dot,             w_dot += w x a q_dot + a q_ddot.
template <class T>
auto Follower<T>::along_chain(const Vector3<T>& p_e) const -> Relative {
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
void Follower<T>::set(const PathPoint& x, const VectorX<T>& theta_r, const VectorX<T>& rate,
                      const VectorX<T>& acceleration) {
  const Robot& robot = problem_->robot;
  const auto axes = static_cast<Eigen::Index>(robot.base_axes.size());
  for (std::size_t k = 0; k < problem_->redundant.size(); ++k) {
    const int joint = problem_->redundant[k];
    const auto i = static_cast<Eigen::Index>(k);
    q_[joint] = theta_r[i];
    v_[axes + joint] = rate[i];
    v_dot_[axes + joint] = acceleration[i];
  }
  kinematics_.set_joints(q_);
  const Pose<T> e = kinematics_.end_effector(
      robot.end_effectors[static_cast<std::size_t>(problem_->end_effector)]);
  base_ = x.pose * e.inverse();
  const Relative tool = along_chain(e.p);
  // The end effector's own, in base axes; their components change as the base turns, too.
  const Matrix3<T> into = base_.R.transpose();
  const Vector3<T> v_e = into * Vector3<double>(x.twist.head<3>());
  const Vector3<T> w_e = into * Vector3<double>(x.twist.tail<3>());
  const Vector3<T> w = w_e - tool.w;
  const Vector3<T> v = v_e - tool.v - Vector3<T>(w.cross(e.p));
  const Vector3<T> w_dot =
      into * Vector3<double>(x.acceleration.tail<3>()) - Vector3<T>(w.cross(w_e)) - tool.w_dot;
  const Vector3<T> v_dot = into * Vector3<double>(x.acceleration.head<3>()) -
                           Vector3<T>(w.cross(v_e)) - tool.v_dot - Vector3<T>(w_dot.cross(e.p)) -
                           Vector3<T>(w.cross(tool.v));
  for (Eigen::Index i = 0; i < axes; ++i) {
    const int axis = robot.base_axes[static_cast<std::size_t>(i)];
    v_[i] = axis < 3 ? v[axis] : w[axis - 3];
    v_dot_[i] = axis < 3 ? v_dot[axis] : w_dot[axis - 3];
  }
}

template class Follower<double>;
template class Follower<Dual<4>>;

}  // namespace maxwrench
