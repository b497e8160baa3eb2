#pragma once

#include <vector>

#include "lib/math/dual.h"
#include "lib/robot/kinematics.h"
#include "maxwrench/path.h"
#include "maxwrench/problem.h"

namespace maxwrench {

/// The whole robot's motion from that of theta_r and of the end effector (eq:redundantJacobian,
/// v = J_e x_dot + A_r theta_r_dot) and its derivative, in closed form: along the chain from base
/// to end effector the motion relative to the base follows from the joints, and what is left of the
/// end effector's is the base's. Of a problem whose theta_r holds all joints of that chain, without
/// a second contact. Other joints rest. A template on the scalar as Kinematics.
template <class T>
class Follower {
 public:
  /// The problem outlives this.
  explicit Follower(const Problem& problem);
  explicit Follower(const Problem&&) = delete;

  /// theta_r and its derivatives in time, r each.
  void set(const PathPoint& x, const VectorX<T>& theta_r, const VectorX<T>& rate,
           const VectorX<T>& acceleration);

  const VectorX<T>& q() const { return q_; }
  const Pose<T>& base() const { return base_; }
  /// n each: base twist in base axes on the free axes, joint rates; and their derivatives.
  const VectorX<T>& v() const { return v_; }
  const VectorX<T>& v_dot() const { return v_dot_; }

 private:
  /// Of a body relative to the base, in base axes: twist at its origin, and derivatives there.
  struct Relative {
    Vector3<T> v = Vector3<T>::Zero(), w = Vector3<T>::Zero();
    Vector3<T> v_dot = Vector3<T>::Zero(), w_dot = Vector3<T>::Zero();
  };
  Relative along_chain(const Vector3<T>& p_e) const;

  const Problem* problem_;
  Kinematics<T> kinematics_;
  std::vector<int> chain_;  ///< joints, from the base outward
  VectorX<T> q_, v_, v_dot_;
  Pose<T> base_;
};

}  // namespace maxwrench
