#include "lib/posture/ik/second_arm.h"

#include "lib/math/decompositions.h"
#include "lib/posture/ik/dependent_joints.h"
#include "lib/robot/chain.h"

namespace maxwrench {
namespace {

using Eigen::Vector3d;

std::vector<char> moving(const Robot& robot, int end_effector) {
  std::vector<char> moves(static_cast<std::size_t>(robot.velocities()), 0);
  for (std::size_t i = 0; i < robot.base_axes.size(); ++i) moves[i] = 1;
  for (const int joint : chain_to(robot, end_effector)) {
    moves[robot.base_axes.size() + static_cast<std::size_t>(joint)] = 1;
  }
  return moves;
}

}  // namespace

SecondArm::SecondArm(const Problem& problem)
    : problem_(problem),
      contact_(*problem.contact),
      arm_(problem),
      first_(moving(problem.robot, problem.end_effector)),
      second_(moving(problem.robot, contact_.end_effector)),
      C_2_(contact_.C),
      seeds_(6, problem.robot.velocities()) {}

void SecondArm::touch(const Eigen::VectorXd& theta_r) {
  const Eigen::Index own = theta_r.size() - contact_.coordinates();
  for (int i = 0; i < contact_.coordinates(); ++i)
    s_[static_cast<std::size_t>(i)] = theta_r[own + i];
  pose_ = contact_pose(contact_, s_.data());
  C_2_.topRows<3>().noalias() = pose_.R.lazyProduct(contact_.C.topRows<3>());
  C_2_.bottomRows<3>().noalias() = pose_.R.lazyProduct(contact_.C.bottomRows<3>());
}

int SecondArm::reach(const Pose<double>& base) { return arm_.solve(base.inverse() * pose_); }

bool SecondArm::within_limits(int i) const {
  for (std::size_t k = 0; k < contact_.follow.size(); ++k) {
    const Joint& limits = problem_.robot.joints[static_cast<std::size_t>(contact_.follow[k])];
    const double q = arm_.solution(i)[static_cast<Eigen::Index>(k)];
    if (!(q >= limits.q_min - kLimitTolerance && q <= limits.q_max + kLimitTolerance)) return false;
  }
  return true;
}

void SecondArm::place(int i, Eigen::VectorXd& q) const {
  for (std::size_t k = 0; k < contact_.follow.size(); ++k) {
    q[contact_.follow[k]] = arm_.solution(i)[static_cast<Eigen::Index>(k)];
  }
}

const Matrix6Xd& SecondArm::shifted_seeds(const Vector3d& p_e, const Matrix6Xd& J_seed,
                                          const Matrix6Xd& J2_seed) {
  const Vector3d r = pose_.p - p_e;
  seeds_.setZero();
  for (Eigen::Index i = 0; i < seeds_.cols(); ++i) {
    if (first_[static_cast<std::size_t>(i)]) seeds_.col(i) = J_seed.col(i);
    if (!second_[static_cast<std::size_t>(i)] || J2_seed.cols() == 0) continue;
    const Vector3d a = J2_seed.col(i).head<3>();
    seeds_.col(i).head<3>() += a;
    seeds_.col(i).tail<3>() += J2_seed.col(i).tail<3>() + r.cross(a);
  }
  return seeds_;
}

void SecondArm::follow(const Vector3d& p_e, const Matrix6Xd& J, const Matrix6Xd& J_2,
                       const Matrix6Xd& J2_seed, const Matrix6Xd& C2_seed,
                       Eigen::VectorXd& q_gradient, Eigen::VectorXd& gradient) {
  const Vector3d r = pose_.p - p_e;
  const auto axes = static_cast<Eigen::Index>(problem_.robot.base_axes.size());
  const int rows = contact_.rows();
  const auto d = static_cast<Eigen::Index>(contact_.follow.size());
  Matrix6N J_f(rows, d);
  Vector6N slope(d);
  for (Eigen::Index i = 0; i < d; ++i) {
    const int joint = contact_.follow[static_cast<std::size_t>(i)];
    J_f.col(i) = J_2.col(axes + joint).head(rows);
    slope[i] = q_gradient[joint];
  }
  mu_.setZero();
  mu_.head(rows) = LeastSquares6(J_f).solve_transposed(slope);
  // With the first end effector at rest, joint k moves all that it does not carry by -s_k.
  for (Eigen::Index k = 0; k < q_gradient.size(); ++k) {
    if (!first_[static_cast<std::size_t>(axes + k)]) continue;
    const Vector3d v = J.col(axes + k).head<3>(), w = J.col(axes + k).tail<3>();
    q_gradient[k] += mu_.head<3>().dot(v + w.cross(r)) + mu_.tail<3>().dot(w);
  }
  // J_2 as a function of the contact point: column i changes by w_i × dp.
  Vector3d by_point = mu_.head<3>();
  for (Eigen::Index i = 0; i < J2_seed.cols(); ++i) {
    if (!second_[static_cast<std::size_t>(i)]) continue;
    by_point += Vector3d(J2_seed.col(i).head<3>()).cross(Vector3d(J_2.col(i).tail<3>()));
  }
  Vector3d by_turn = mu_.tail<3>();
  for (Eigen::Index j = 0; j < C2_seed.cols(); ++j) {
    for (const int part : {0, 3}) {
      const Vector3d column = C_2_.col(j).segment<3>(part), seed = C2_seed.col(j).segment<3>(part);
      by_turn += column.cross(seed);
    }
  }
  const Eigen::Index own = gradient.size() - contact_.coordinates();
  for (int i = 0; i < contact_.coordinates(); ++i) {
    const Vector6d twist = contact_twist(contact_, s_.data(), i);
    gradient[own + i] = by_point.dot(twist.head<3>()) + by_turn.dot(twist.tail<3>());
  }
}

Vector6d SecondArm::by_twist(const Vector3d& p_e) const {
  const Vector3d r = pose_.p - p_e, force = mu_.head<3>();
  Vector6d slope = -mu_;
  slope.tail<3>() -= r.cross(force);
  return slope;
}

}  // namespace maxwrench
