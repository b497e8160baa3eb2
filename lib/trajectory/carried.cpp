#include "lib/trajectory/carried.h"

#include <algorithm>
#include <cassert>

#include "lib/math/dual.h"
#include "lib/math/rotated.h"

namespace maxwrench {

template <class T>
Vector6<T> carried_wrench(const Robot& robot, const CarriedBody& body, const ToolMotion<T>& tool) {
  const Matrix3<T>& R = tool.R;
  const Matrix3<T> back = R.transpose();
  const Vector3<T> v = tool.twist.template head<3>(), w = tool.twist.template tail<3>();
  const Vector3<T> a = tool.acceleration.template head<3>();
  const Vector3<T> alpha = tool.acceleration.template tail<3>();
  const Vector3<T> arm = R * body.com;
  const Vector3<T> swept = w.cross(arm);
  const Vector3<T> a_c = a + Vector3<T>(alpha.cross(arm)) + Vector3<T>(w.cross(swept));
  const Eigen::Vector3d up(0, 0, robot.gravity);
  const Eigen::Vector3d buoyancy = robot.water_density * body.volume * up;

  // In axes of the body.
  Vector3<T> passed = v + swept;  // the water
  if (!robot.current.isZero(0)) passed -= robot.current.cast<T>();
  const Vector3<T> V = back * passed, W = back * w;
  const Vector3<T> V_dot = Vector3<T>(back * a_c) - Vector3<T>(W.cross(V)), W_dot = back * alpha;
  const auto moved = [&](const Vector3<T>& rate, Eigen::Index first) {
    Vector3<T> momentum = rate;
    for (Eigen::Index i = 0; i < 3; ++i) momentum[i] = rate[i] * body.added_mass[first + i];
    return momentum;
  };
  const Vector3<T> AV = moved(V, 0);
  const Vector3<T> f_A = R * Vector3<T>(moved(V_dot, 0) + Vector3<T>(W.cross(AV)));
  const Vector3<T> spin = body.inertia * W;
  const Vector3<T> n_own = Vector3<T>(body.inertia * W_dot) + Vector3<T>(W.cross(spin)) +
                           moved(W_dot, 3) + Vector3<T>(W.cross(moved(W, 3))) +
                           Vector3<T>(V.cross(AV));

  const Vector3<T> held = a_c + up + f_A;
  const Vector3<T> n = Vector3<T>(arm.cross(held)) + Vector3<T>(R * n_own) -
                       Vector3<T>(Vector3<T>(R * body.cob).cross(Vector3<T>(buoyancy.cast<T>())));
  Vector6<T> wrench;
  wrench << Vector3<T>(held - buoyancy), n;
  return wrench;
}

template Vector6<double> carried_wrench(const Robot&, const CarriedBody&,
                                        const ToolMotion<double>&);
template Vector6<Dual<4>> carried_wrench(const Robot&, const CarriedBody&,
                                         const ToolMotion<Dual<4>>&);

Vector6d WrenchTable::at(double time) const {
  assert(!t.empty() && wrenches.cols() == static_cast<Eigen::Index>(t.size()));
  const auto after = std::upper_bound(t.begin(), t.end(), time);
  if (after == t.begin()) return wrenches.col(0);
  if (after == t.end()) return wrenches.rightCols<1>();
  const auto i = static_cast<Eigen::Index>(after - t.begin()) - 1;
  const double share = (time - *(after - 1)) / (*after - *(after - 1));
  return (1 - share) * wrenches.col(i) + share * wrenches.col(i + 1);
}

Vector6d factored_wrench(const Robot& robot, const MotionTask& task, double t, const PathPoint& x) {
  if (task.payload) {
    return carried_wrench<double>(robot, *task.payload, {x.pose.R, x.twist, x.acceleration});
  }
  const Vector6d wrench = task.table->at(t);
  return task.c_turns ? rotated(x.pose.R, wrench) : wrench;
}

}  // namespace maxwrench
