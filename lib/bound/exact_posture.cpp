#include "lib/bound/exact_posture.h"

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
  const Matrix3<Extended> R_base = problem_.pose.R.cast<Extended>() * R_e.transpose();
  kinematics_.jacobian(tip, R_base, J_);
  kinematics_.gravity_and_buoyancy(R_base, tau_d_);
}

Coordinates all_coordinates(const Problem& problem) {
  Coordinates all;
  all.index.resize(problem.redundant.size());
  std::iota(all.index.begin(), all.index.end(), 0);
  for (const int joint : problem.redundant) {
    const Joint& at = problem.robot.joints[static_cast<std::size_t>(joint)];
    all.turns.push_back(at.type == JointType::kRevolute);
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
  if (problem.free.count() > 0) refuse("free coordinates of the pose");
  if (!problem.dependent.empty()) refuse("joints that follow from theta_r");
}

MultiAffine pure_rows(const Problem& problem, const Eigen::MatrixXd& K) {
  ExactPosture posture(problem);
  const Vector6<Extended> c = problem.c.cast<Extended>();
  const MatrixX<Extended> into = K.cast<Extended>();
  return {all_coordinates(problem), problem.theta_r_default, [&](const ExtendedVector& theta_r) {
            posture.set(theta_r);
            ExtendedVector rows(2 * K.rows());
            rows.head(K.rows()).noalias() = into * posture.tau_d();
            const ExtendedVector a = posture.J().transpose() * c;
            rows.tail(K.rows()).noalias() = into * a;
            return rows;
          }};
}

}  // namespace maxwrench
