#pragma once

#include <array>
#include <vector>

#include "maxwrench/types.h"

namespace maxwrench {

struct FreePose;
struct Problem;

/// Up to six dependent coordinates y.
template <class T>
using Six = std::array<T, 6>;

/// The state of the end effector at (theta_r, y), in world axes.
template <class T>
struct ToolState {
  Pose<T> pose;
  Six<Vector6<T>> J;                      ///< [m; rad], the twist per unit rate of each y
  std::vector<Vector6<T>> J_r;            ///< the twist per unit rate of each theta_r
  Vector6<T> twist;                       ///< due to the rates
  std::vector<Vector3<T>> axes, origins;  ///< of the coordinates
};

/// The chain from the world to the end effector: free base axes and joints. Each turns about or
/// slides along the z axis of its own frame. y are the base axes and the dependent joints, d <= 6
/// in the order of the chain. theta_r, r numbers, are the other joints and the free coordinates of
/// the end effector's pose; the chain ends with the inverse of these coordinates. A joint with a
/// gear is at ratio times its leader, which is one of theta_r, plus offset. `evaluate` is a
/// template on the scalar: double or Complex.
class ToolChain {
 public:
  explicit ToolChain(const Problem& problem);

  int unknowns() const { return static_cast<int>(places_.size()); }
  int parameters() const { return parameters_; }
  /// Whether y_i is an angle.
  bool turns(int i) const {
    const int place = places_[static_cast<std::size_t>(i)];
    return coordinates_[static_cast<std::size_t>(place)].turns;
  }
  /// The index of y_i in z = [x, y, z, yaw of the base; all joints].
  int place_in_z(int i) const { return in_z_[static_cast<std::size_t>(i)]; }

  /// J_d 6×d of a state.
  Eigen::Map<const Matrix6Xd> J_d(const ToolState<double>& state) const {
    return {state.J[0].data(), 6, unknowns()};
  }

  /// The same chain with two more parameters before each y but the first, after those of theta_r: a
  /// turn about a line across its axis, and a slide along it. At zero it is this chain, at others
  /// its axes are neither parallel nor do they meet.
  ToolChain deformable() const;

  /// Whether all coordinates of both chains are the same.
  bool operator==(const ToolChain& other) const;

  /// Fills `state`. A null `theta_r_rate` or `y_rate` counts as zero.
  template <class T>
  void evaluate(const T* theta_r, const T* y, const T* theta_r_rate, const T* y_rate,
                ToolState<T>& state) const;

 private:
  struct Coordinate {
    Pose<double> placement;   ///< from the frame before
    Eigen::Quaterniond turn;  ///< its rotation
    bool is_turned = false;   ///< whether that is not the identity
    bool turns = true;
    int unknown = -1, parameter = -1;  ///< its index in y or in theta_r
    double ratio = 1, offset = 0;      ///< of the gear of a joint whose leader is in theta_r
  };

  void add(const Pose<double>& placement, const Eigen::Vector3d& axis, bool turns);
  void add_free(const FreePose& free);
  void follows(int place_in_z);
  void add_parameter(const Pose<double>& placement, const Eigen::Vector3d& axis, bool turns);

  std::vector<Coordinate> coordinates_;
  std::vector<int> places_, in_z_;  ///< indices of y in coordinates_ and in z
  int parameters_ = 0;
  Pose<double> behind_;  ///< from the last frame to the next one, finally to the end effector
};

}  // namespace maxwrench
