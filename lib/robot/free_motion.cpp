#include "lib/robot/free_motion.h"

namespace maxwrench {
namespace {

constexpr int kPoseSize = 7;
constexpr double kPull = 1;  // 1/s, towards |e| = 1

Vector6d base_twist(const Robot& robot, const Motion& motion) {
  Vector6d twist = Vector6d::Zero();
  for (std::size_t i = 0; i < robot.base_axes.size(); ++i) {
    twist[robot.base_axes[i]] = motion.v[static_cast<Eigen::Index>(i)];
  }
  return twist;
}

}  // namespace

int motion_size(const Robot& robot) {
  return kPoseSize + static_cast<int>(robot.joints.size()) + robot.velocities();
}

void write_motion(const Motion& motion, Eigen::VectorXd& y) {
  const Eigen::Quaterniond e(motion.base.R);
  y.head<3>() = motion.base.p;
  y.segment<4>(3) << e.w(), e.vec();
  y.segment(kPoseSize, motion.q.size()) = motion.q;
  y.segment(kPoseSize + motion.q.size(), motion.v.size()) = motion.v;
}

void read_motion(const Eigen::VectorXd& y, Motion& motion) {
  motion.base.p = y.head<3>();
  motion.base.R = Eigen::Quaterniond(y[3], y[4], y[5], y[6]).normalized().toRotationMatrix();
  motion.q = y.segment(kPoseSize, motion.q.size());
  motion.v = y.segment(kPoseSize + motion.q.size(), motion.v.size());
}

Motion advanced(const Robot& robot, Motion motion, double seconds) {
  const Vector6d moved = seconds * base_twist(robot, motion);
  const Eigen::Vector3d turn = moved.tail<3>();
  motion.base.p += motion.base.R * moved.head<3>();
  if (const double angle = turn.norm(); angle > 0) {
    motion.base.R *= Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  }
  motion.q += seconds * motion.v.tail(motion.q.size());
  return motion;
}

void configuration_rates(const Robot& robot, const Motion& motion, const Eigen::VectorXd& y,
                         Eigen::VectorXd& y_dot) {
  const Vector6d twist = base_twist(robot, motion);
  const double w = y[3];
  const Eigen::Vector3d e = y.segment<3>(4), turn = twist.tail<3>();
  y_dot.head<3>() = motion.base.R * twist.head<3>();
  y_dot[3] = -0.5 * e.dot(turn);
  y_dot.segment<3>(4) = 0.5 * (w * turn + e.cross(turn));
  y_dot.segment<4>(3) += kPull * (1 - y.segment<4>(3).squaredNorm()) * y.segment<4>(3);
  y_dot.segment(kPoseSize, motion.q.size()) = motion.v.tail(motion.q.size());
}

void configuration_slopes(const Robot& robot, const Motion& motion, const Eigen::VectorXd& y,
                          Eigen::MatrixXd& slopes) {
  const auto axes = static_cast<Eigen::Index>(robot.base_axes.size());
  const Eigen::Vector3d e = y.segment<3>(4);
  slopes.setZero(kPoseSize + motion.q.size(), axes + motion.q.size());
  for (Eigen::Index i = 0; i < axes; ++i) {
    const int axis = robot.base_axes[static_cast<std::size_t>(i)];
    if (axis < 3) {
      slopes.col(i).head<3>() = motion.base.R.col(axis);
      continue;
    }
    const Eigen::Vector3d turn = Eigen::Vector3d::Unit(axis - 3);
    slopes(3, i) = -0.5 * e.dot(turn);
    slopes.block<3, 1>(4, i) = 0.5 * (y[3] * turn + e.cross(turn));
  }
  slopes.bottomRightCorner(motion.q.size(), motion.q.size()).setIdentity();
}

/// The vector part of 2 e^-1 de/|e|^2 is the turn of de, in base axes.
void configuration_shifts(const Robot& robot, const Motion& motion, const Eigen::VectorXd& y,
                          Eigen::MatrixXd& shifts) {
  const auto axes = static_cast<Eigen::Index>(robot.base_axes.size());
  const Eigen::Vector3d e = y.segment<3>(4);
  const double scale = 2 / y.segment<4>(3).squaredNorm();
  shifts.setZero(axes + motion.q.size(), kPoseSize + motion.q.size());
  for (Eigen::Index i = 0; i < axes; ++i) {
    const int axis = robot.base_axes[static_cast<std::size_t>(i)];
    if (axis < 3) {
      shifts.row(i).head<3>() = motion.base.R.col(axis).transpose();
      continue;
    }
    const Eigen::Vector3d turn = Eigen::Vector3d::Unit(axis - 3);
    shifts(i, 3) = -scale * e.dot(turn);
    shifts.block<1, 3>(i, 4) = scale * (y[3] * turn - turn.cross(e)).transpose();
  }
  shifts.bottomRightCorner(motion.q.size(), motion.q.size()).setIdentity();
}

FreeMotion::FreeMotion(const Robot& robot, const Motion& start,
                       std::function<void(double, Eigen::VectorXd&)> tau)
    : robot_(robot),
      dynamics_(robot),
      effort_(std::move(tau)),
      start_(motion_size(robot)),
      tau_(robot.velocities()),
      v_d_(robot.velocities()),
      tau_d_(robot.velocities()),
      motion_(start) {
  write_motion(start, start_);
}

bool FreeMotion::derivative(double t, const Eigen::VectorXd& y, Eigen::VectorXd& y_dot) {
  read_motion(y, motion_);
  effort_(t, tau_);
  dynamics_.set_configuration(motion_.base.R, motion_.q);
  dynamics_.forward(motion_.v, tau_, v_d_);
  y_dot.resize(y.size());
  configuration_rates(robot_, motion_, y, y_dot);
  y_dot.tail(v_d_.size()) = v_d_;
  return y_dot.allFinite();
}

bool FreeMotion::residual(double t, const Eigen::VectorXd& y, const Eigen::VectorXd& y_dot,
                          Eigen::VectorXd& F) {
  read_motion(y, motion_);
  effort_(t, tau_);
  dynamics_.set_configuration(motion_.base.R, motion_.q);
  v_d_ = y_dot.tail(v_d_.size());
  dynamics_.inverse(motion_.v, v_d_, tau_d_);
  F.resize(y.size());
  configuration_rates(robot_, motion_, y, F);
  F = y_dot - F;
  F.tail(tau_d_.size()) = tau_d_ - tau_;
  return F.allFinite();
}

}  // namespace maxwrench
