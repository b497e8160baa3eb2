#pragma once

#include "maxwrench/robot.h"

namespace maxwrench {

/// A twist [linear; angular] or its rate, a momentum, or a wrench [force; torque]. Unless stated
/// otherwise, in base axes at the base origin.
template <class T>
struct Screw {
  Vector3<T> linear = Vector3<T>::Zero(), angular = Vector3<T>::Zero();
};

/// Maps a twist to the momentum at the same origin: [A v + B w; B'v + C w], all blocks 3×3.
template <class S>
struct Inertia {
  Matrix3<S> A, B, C;
};

/// Moves an inertia from the origin and axes of `frame` to the origin and axes that `frame` is
/// relative to. With P = [p]x the twist at p is (v - P w, w), and a momentum (A v + B w, L) at p
/// has the angular part L + p x (A v + B w).
template <class S>
Inertia<S> moved(const Pose<S>& frame, const Inertia<double>& inertia) {
  const auto turned = [&frame](const Matrix3<double>& block) -> Matrix3<S> {
    const Matrix3<S> left = frame.R * block;
    return left * frame.R.transpose();
  };
  const Matrix3<S> P = skew(frame.p);
  Inertia<S> result{turned(inertia.A), turned(inertia.B), turned(inertia.C)};
  const Matrix3<S> B_P = result.B.transpose() * P;
  result.B -= result.A * P;
  const Matrix3<S> P_B = P * result.B;
  result.C += P_B - B_P;
  return result;
}

/// The inertia of the link and of the water that its bodies move, at the link's origin in its axes.
inline Inertia<double> link_inertia(const Link& link) {
  const Matrix3<double> zero = Matrix3<double>::Zero();
  const Matrix3<double> mass = link.mass * Matrix3<double>::Identity();
  Inertia<double> sum =
      moved<double>({Matrix3<double>::Identity(), link.com}, {mass, zero, link.inertia});
  for (const HydrodynamicBody& body : link.hydrodynamics) {
    const Inertia<double> water = moved<double>(
        body.frame,
        {body.added_mass.head<3>().asDiagonal(), zero, body.added_mass.tail<3>().asDiagonal()});
    sum.A += water.A;
    sum.B += water.B;
    sum.C += water.C;
  }
  return sum;
}

template <class S, class T>
Screw<T> momentum(const Inertia<S>& inertia, const Screw<T>& twist) {
  return {inertia.A * twist.linear + inertia.B * twist.angular,
          inertia.B.transpose() * twist.linear + inertia.C * twist.angular};
}

/// V x S: the rate of a twist S that moves with the twist V.
template <class T>
Screw<T> crossed(const Screw<T>& V, const Screw<T>& S) {
  return {V.angular.cross(S.linear) + V.linear.cross(S.angular), V.angular.cross(S.angular)};
}

/// Power of a wrench along a twist.
template <class T>
T along(const Screw<T>& twist, const Screw<T>& wrench) {
  return twist.linear.dot(wrench.linear) + twist.angular.dot(wrench.angular);
}

/// Component `axis` of [linear; angular].
template <class T>
T component(const Screw<T>& screw, int axis) {
  return axis < 3 ? screw.linear[axis] : screw.angular[axis - 3];
}

/// The twist at `frame`'s origin, in its axes.
template <class T>
Screw<T> into(const Pose<T>& frame, const Screw<T>& twist) {
  const Vector3<T> linear = twist.linear + twist.angular.cross(frame.p);
  return {frame.R.transpose() * linear, frame.R.transpose() * twist.angular};
}

}  // namespace maxwrench
