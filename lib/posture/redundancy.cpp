#include "lib/posture/redundancy.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "lib/math/decompositions.h"
#include "lib/posture/free_pose.h"
#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

/// The dependent velocities, at most six: with more, A_r would not be unique.
struct Dependent {
  std::array<int, 6> index{};
  int count = 0;

  void add(int velocity) {
    assert(count < 6);
    index[static_cast<std::size_t>(count++)] = velocity;
  }
};

Dependent dependent_velocities(const Problem& problem) {
  const Robot& robot = problem.robot;
  const int axes = static_cast<int>(robot.base_axes.size());
  Dependent dependent;
  for (int axis = 0; axis < axes; ++axis) dependent.add(axis);
  int link = robot.end_effectors[static_cast<std::size_t>(problem.end_effector)].link;
  while (link > 0) {
    const int joint = link - 1;
    const std::vector<int>& redundant = problem.redundant;
    const bool geared = robot.joints[static_cast<std::size_t>(joint)].gear.has_value();
    if (!geared && std::find(redundant.begin(), redundant.end(), joint) == redundant.end()) {
      dependent.add(axes + joint);
    }
    link = robot.joints[static_cast<std::size_t>(joint)].parent;
  }
  return dependent;
}

/// The twist of the end effector by a joint and by those that gears move with it.
Vector6d driven_twist(const Robot& robot, const Posture& posture, int joint) {
  const auto axes = static_cast<Eigen::Index>(robot.base_axes.size());
  Vector6d twist = posture.J.col(axes + joint);
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const auto& gear = robot.joints[i].gear;
    if (!gear || gear->leader != joint) continue;
    twist += gear->ratio * posture.J.col(axes + static_cast<Eigen::Index>(i));
  }
  return twist;
}

/// Factors J_d; `solve` then applies J_d^+.
LeastSquares6 factor(const Posture& posture, const Dependent& dependent) {
  Matrix6N J_d(6, dependent.count);
  for (int i = 0; i < dependent.count; ++i) {
    J_d.col(i) = posture.J.col(dependent.index[static_cast<std::size_t>(i)]);
  }
  return LeastSquares6(J_d);
}

/// Writes J_d^+ y into the dependent rows of a column.
template <class Column>
void scatter(const LeastSquares6& J_d, const Dependent& dependent, const Vector6d& y,
             Column&& column) {
  if (dependent.count == 0) return;  // a base that does not move
  const Vector6N velocities = J_d.solve(y);
  for (int i = 0; i < dependent.count; ++i) {
    column[dependent.index[static_cast<std::size_t>(i)]] = velocities[i];
  }
}

/// The second arm's dependent joints in a column of A_r: J_f dq_2 = t - J_2 (the column), where t
/// is the twist of the contact frame.
void follow_contact(const Problem& problem, const Posture& posture, const Vector6d& t,
                    Eigen::Ref<Eigen::VectorXd> column) {
  const Contact& contact = *problem.contact;
  const auto axes = static_cast<Eigen::Index>(problem.robot.base_axes.size());
  const int rows = contact.rows();
  const auto d = static_cast<Eigen::Index>(contact.follow.size());
  Matrix6N J_f = Matrix6N::Zero(6, d);
  for (Eigen::Index i = 0; i < d; ++i) {
    J_f.col(i).head(rows) =
        posture.J_2.col(axes + contact.follow[static_cast<std::size_t>(i)]).head(rows);
  }
  Vector6d twist = t - posture.J_2.lazyProduct(column);
  twist.tail(6 - rows).setZero();
  const Vector6N dq = LeastSquares6(J_f).solve(twist);
  for (Eigen::Index i = 0; i < d; ++i) {
    column[axes + contact.follow[static_cast<std::size_t>(i)]] = dq[i];
  }
}

}  // namespace

void null_motion(const Problem& problem, const Posture& posture, Eigen::MatrixXd& A_r) {
  const Dependent dependent = dependent_velocities(problem);
  const auto J_d = factor(posture, dependent);
  const auto axes = static_cast<Eigen::Index>(problem.robot.base_axes.size());
  A_r.setZero(posture.J.cols(), problem.redundancy());
  const auto joints = static_cast<Eigen::Index>(problem.redundant.size());
  for (Eigen::Index k = 0; k < joints; ++k) {
    const int joint = problem.redundant[static_cast<std::size_t>(k)];
    scatter(J_d, dependent, -driven_twist(problem.robot, posture, joint), A_r.col(k));
    A_r(axes + joint, k) = 1;
    if (problem.contact) follow_contact(problem, posture, Vector6d::Zero(), A_r.col(k));
  }
  const Eigen::Index regrasp = joints + problem.free.count();
  for (Eigen::Index k = joints; k < regrasp; ++k) {
    const Vector6d t = free_twist(problem, posture.theta_r, static_cast<int>(k - joints));
    scatter(J_d, dependent, t, A_r.col(k));
    if (problem.contact) follow_contact(problem, posture, Vector6d::Zero(), A_r.col(k));
  }
  for (Eigen::Index k = regrasp; k < A_r.cols(); ++k) {
    const Vector6d t = contact_twist(*problem.contact, posture.theta_r.data() + regrasp,
                                     static_cast<int>(k - regrasp));
    follow_contact(problem, posture, t, A_r.col(k));
  }
  for (std::size_t i = 0; i < problem.robot.joints.size(); ++i) {
    const auto& gear = problem.robot.joints[i].gear;
    if (!gear) continue;
    A_r.row(axes + static_cast<Eigen::Index>(i)) = gear->ratio * A_r.row(axes + gear->leader);
  }
}

}  // namespace maxwrench
