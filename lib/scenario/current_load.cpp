#include "lib/scenario/current_load.h"

#include <algorithm>

namespace maxwrench {
namespace {

Robot floating_without_weight(Robot robot) {
  robot.base_axes = {0, 1, 2, 3, 4, 5};
  robot.gravity = 0;
  robot.current.setZero();  // that of each case counts
  return robot;
}

}  // namespace

bool has_current(const LoadGroup& cases) {
  return std::any_of(cases.begin(), cases.end(),
                     [](const LoadCase& load) { return !load.current.isZero(0); });
}

bool has_current(const ScenarioList& list) {
  return std::any_of(list.loads.begin(), list.loads.end(),
                     [](const LoadGroup& cases) { return has_current(cases); });
}

CurrentLoad::CurrentLoad(const Robot& robot)
    : base_axes_(robot.base_axes),
      free_(floating_without_weight(robot)),
      dynamics_(free_),
      slopes_(free_),
      velocity_(Eigen::VectorXd::Zero(free_.velocities())),
      zero_(velocity_),
      tau_(velocity_),
      lambda_(velocity_) {}

void CurrentLoad::set(const Eigen::Matrix3d& R_base, const Eigen::VectorXd& q) {
  R_base_ = R_base;
  q_ = q;
  dynamics_.set_configuration(R_base, q);
}

void CurrentLoad::set_velocity(const Eigen::Vector3d& current) {
  velocity_.head<3>().noalias() = -(R_base_.transpose() * current);
}

void CurrentLoad::evaluate(const Eigen::Vector3d& current, Eigen::Ref<Eigen::VectorXd> tau) {
  set_velocity(current);
  dynamics_.inverse(velocity_, zero_, tau_);
  const auto axes = static_cast<Eigen::Index>(base_axes_.size());
  for (Eigen::Index i = 0; i < axes; ++i) tau[i] = tau_[base_axes_[static_cast<std::size_t>(i)]];
  tau.tail(tau.size() - axes) = tau_.tail(tau_.size() - 6);
}

Eigen::Vector3d CurrentLoad::add_slopes(const Eigen::Vector3d& current,
                                        const Eigen::VectorXd& lambda, Eigen::VectorXd& by_q) {
  set_velocity(current);
  slopes_.set(R_base_, q_, velocity_, zero_, free_.end_effectors.front(), Vector6d::Zero());
  lambda_.setZero();
  const auto axes = static_cast<Eigen::Index>(base_axes_.size());
  for (Eigen::Index i = 0; i < axes; ++i) {
    lambda_[base_axes_[static_cast<std::size_t>(i)]] = lambda[i];
  }
  lambda_.tail(lambda_.size() - 6) = lambda.tail(lambda.size() - axes);
  by_q.noalias() += slopes_.by_q().transpose() * lambda_;
  // A turn x of the base in its axes changes V = -R'v_c by V x x.
  const Eigen::Vector3d by_V = slopes_.by_v().leftCols<3>().transpose() * lambda_;
  return R_base_ * by_V.cross(Eigen::Vector3d(velocity_.head<3>()));
}

}  // namespace maxwrench
