#include "problems/make/base_motion.h"

#include <Eigen/Geometry>
#include <cmath>

namespace maxwrench {

BaseMotion base_motion(const Vector6d& x, const Vector6d& x_dot, const Vector6d& x_ddot) {
  using Turn = Eigen::AngleAxisd;
  BaseMotion base;
  base.pose.p = x.head<3>();
  base.pose.R = (Turn(x[5], Eigen::Vector3d::UnitZ()) * Turn(x[4], Eigen::Vector3d::UnitY()) *
                 Turn(x[3], Eigen::Vector3d::UnitX()))
                    .toRotationMatrix();
  const double sr = std::sin(x[3]), cr = std::cos(x[3]), sp = std::sin(x[4]), cp = std::cos(x[4]);
  const double roll = x_dot[3], pitch = x_dot[4];
  Eigen::Matrix3d E, E_dot;
  E << 1, 0, -sp, 0, cr, sr * cp, 0, -sr, cr * cp;
  E_dot << 0, 0, -cp * pitch, 0, -sr * roll, cr * cp * roll - sr * sp * pitch, 0, -cr * roll,
      -sr * cp * roll - cr * sp * pitch;
  const Eigen::Vector3d v = base.pose.R.transpose() * x_dot.head<3>();
  const Eigen::Vector3d w = E * x_dot.tail<3>();
  base.twist << v, w;
  base.acceleration << base.pose.R.transpose() * x_ddot.head<3>() - w.cross(v),
      E * x_ddot.tail<3>() + E_dot * x_dot.tail<3>();
  return base;
}

Eigen::Vector3d roll_pitch_yaw(const Eigen::Matrix3d& R) {
  return {std::atan2(R(2, 1), R(2, 2)), std::atan2(-R(2, 0), std::hypot(R(2, 1), R(2, 2))),
          std::atan2(R(1, 0), R(0, 0))};
}

}  // namespace maxwrench
