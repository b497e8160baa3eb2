#include "lib/bound/exact_posture.h"

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "lib/robot/chain.h"

namespace maxwrench {

ExactPosture::ExactPosture(const Problem& problem)
    : problem_(problem),
      kinematics_(problem.robot),
      q_(resting_joints(problem.robot).cast<Extended>()) {}

void ExactPosture::set(const ExtendedVector& theta_r) {
  const EndEffector& tip =
      problem_.robot.end_effectors[static_cast<std::size_t>(problem_.end_effector)];
  for (std::size_t i = 0; i < problem_.redundant.size(); ++i) {
    q_[problem_.redundant[i]] = theta_r[static_cast<Eigen::Index>(i)];
  }
  kinematics_.set_joints(q_);
  const Matrix3<Extended> R_e = kinematics_.end_effector(tip).R;
  const Pose<Extended> pose = exact_pose(problem_, theta_r);
  const Matrix3<Extended> R_base = pose.R * R_e.transpose();
  kinematics_.jacobian(tip, R_base, J_);
  kinematics_.gravity_and_buoyancy(R_base, tau_d_);
  c_ = exact_direction(problem_, pose);
}

Pose<Extended> exact_pose(const Problem& problem, const ExtendedVector& x) {
  using std::cos;
  using std::sin;
  const Matrix3<Extended> R_0 = problem.pose.R.cast<Extended>();
  Vector3<Extended> shift = Vector3<Extended>::Zero();
  Matrix3<Extended> turn = Matrix3<Extended>::Identity();
  auto next = static_cast<Eigen::Index>(problem.redundant.size());
  for (const int axis : problem.free.axes) {
    const Extended s = x[next++];
    if (axis < 3) {
      shift[axis] = s;
      continue;
    }
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;  // roll first, yaw last
    Matrix3<Extended> one = Matrix3<Extended>::Identity();
    one(i, i) = one(j, j) = cos(s);
    one(j, i) = sin(s);
    one(i, j) = -one(j, i);
    turn = one * turn;
  }
  const Matrix3<Extended> R = R_0 * turn;
  const Matrix3<Extended>& along = problem.free.along_tool ? R : R_0;
  return {R, problem.pose.p.cast<Extended>() + along * shift};
}

Vector6<Extended> exact_direction(const Problem& problem, const Pose<Extended>& pose) {
  Vector6<Extended> c = problem.c.cast<Extended>();
  if (!problem.free.wrench_turns) return c;
  const Matrix3<Extended> turn = pose.R * problem.pose.R.cast<Extended>().transpose();
  const Vector3<Extended> force = turn * c.head<3>(), torque = turn * c.tail<3>();
  c << force, torque;
  return c;
}

Coordinates all_coordinates(const Problem& problem) {
  Coordinates all;
  all.index.resize(problem.redundant.size());
  std::iota(all.index.begin(), all.index.end(), 0);
  for (const int joint : problem.redundant) {
    const Joint& at = problem.robot.joints[static_cast<std::size_t>(joint)];
    all.turns.push_back(at.type == JointType::kRevolute);
  }
  for (const int axis : problem.free.axes) {
    all.index.push_back(all.count());
    all.turns.push_back(axis >= 3);
  }
  return all;
}

void require_closed_form(const Problem& problem) {
  const auto refuse = [&](const std::string& got) {
    throw std::invalid_argument(problem.name + ": got " + got +
                                ", expected a static task with one contact and a given pose, whose "
                                "base follows from theta_r in closed form, for a proof");
  };
  if (problem.motion) refuse(std::string("a task in time (") + problem.type() + ")");
  if (problem.contact) refuse("a second contact");
}

MultiAffine pure_rows(const Problem& problem, const Eigen::MatrixXd& K) {
  ExactPosture posture(problem);
  const MatrixX<Extended> into = K.cast<Extended>();
  return {all_coordinates(problem), problem.theta_r_default, [&](const ExtendedVector& theta_r) {
            posture.set(theta_r);
            ExtendedVector rows(2 * K.rows());
            rows.head(K.rows()).noalias() = into * posture.tau_d();
            const ExtendedVector a = posture.J().transpose() * posture.c();
            rows.tail(K.rows()).noalias() = into * a;
            return rows;
          }};
}

}  // namespace maxwrench
