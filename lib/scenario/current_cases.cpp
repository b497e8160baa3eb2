#include "lib/scenario/current_cases.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "maxwrench/posture.h"

namespace maxwrench {
namespace {

/// Two currents are opposite if their sum is below this share of the speed: rounded sines are.
constexpr double kOpposite = 1e-13;
/// Estimates leave out quadratic drag along an axis that is below this share of the bound.
constexpr double kLeftOut = 1e-9;

/// Directions at a time in single precision.
using Directions = Eigen::Array<float, 12, 1>;
constexpr Eigen::Index kAtOnce = Directions::RowsAtCompileTime;

}  // namespace

CurrentCases::CurrentCases(const Robot& robot, const LoadGroup& cases) : robot_(robot) {
  for (std::size_t link = 0; link < robot.links.size(); ++link) {
    for (const HydrodynamicBody& body : robot.links[link].hydrodynamics) {
      const Eigen::Vector3d A = body.added_mass.head<3>();
      bodies_.push_back({.link = link,
                         .frame = body.frame,
                         .turned = !body.frame.R.isIdentity(0),
                         .linear = body.damping_linear.head<3>(),
                         .quadratic = body.damping_quadratic.head<3>(),
                         .has_linear = !body.damping_linear.head<3>().isZero(0),
                         .munk = {A[2] - A[1], A[0] - A[2], A[1] - A[0]},
                         .at = {},
                         .E = Eigen::Matrix3d::Identity()});
    }
  }
  horizontal_ = true;
  for (const LoadCase& each : cases) {
    speed_ = std::max(speed_, each.current.norm());
    if (each.current[2] != 0) horizontal_ = false;
  }
  pair_opposites(cases);
  set_most();
  links_.resize(robot.links.size());
  axes_.reserve(3 * bodies_.size());
  estimated_axes_.reserve(axes_.capacity());
}

/// Directions all around have their opposites half a turn later, so one distance in the list is
/// tried: that of the first pair.
void CurrentCases::pair_opposites(const LoadGroup& cases) {
  const std::size_t count = cases.size();
  const auto opposes = [&](std::size_t i, std::size_t j) {
    return j < count && !cases[i].current.isZero(0) &&
           (cases[i].current + cases[j].current).norm() <= kOpposite * speed_;
  };
  std::size_t first = 0, half = 1;
  while (first < count && cases[first].current.isZero(0)) ++first;
  while (first + half < count && !opposes(first, first + half)) ++half;
  std::vector<int> alone;
  std::vector<bool> taken(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (taken[i]) continue;
    if (opposes(i, i + half)) {
      taken[i + half] = true;
      forward_.push_back(static_cast<int>(i));
      backward_.push_back(static_cast<int>(i + half));
    } else {
      alone.push_back(static_cast<int>(i));
    }
  }
  forward_.insert(forward_.end(), alone.begin(), alone.end());
  backward_.resize(forward_.size(), -1);
  const auto rows = static_cast<Eigen::Index>(forward_.size());
  V_.resize(rows, 3);
  U_.setZero((rows + kAtOnce - 1) / kAtOnce * kAtOnce, 3);
  mirror_.setOnes(U_.rows());
  odd_.resize(U_.rows());
  even_.resize(U_.rows());
  total_.resize(U_.rows());
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto at = static_cast<std::size_t>(i);
    V_.row(i) = -cases[static_cast<std::size_t>(forward_[at])].current.transpose();
    U_.row(i) = (V_.row(i) / speed_).cast<float>();
    if (backward_[at] >= 0) mirror_[i] = -1;
  }
}

/// The largest distance [m] of two links' origins, the first of which carries the second.
double CurrentCases::farthest(std::size_t first, std::size_t link) const {
  double distance = 0;
  for (std::size_t at = link; at != first;) {
    const Joint& on_the_way = robot_.joints[at - 1];
    distance += on_the_way.placement.p.norm();
    if (on_the_way.type == JointType::kPrismatic) {
      distance += std::max(std::abs(on_the_way.q_min), std::abs(on_the_way.q_max));
    }
    at = static_cast<std::size_t>(on_the_way.parent);
  }
  return distance;
}

/// Forces of a body are at most s max D + s^2 max d. Its moment V x (A V) is at most s^2 times half
/// the largest difference of its added masses, as V x V is zero. They act with the longest arm.
void CurrentCases::set_most() {
  most_of_joints_.setZero(static_cast<Eigen::Index>(robot_.joints.size()));
  for (const Body& body : bodies_) {
    const double force = speed_ * (body.linear.cwiseAbs().maxCoeff() +
                                   speed_ * body.quadratic.cwiseAbs().maxCoeff());
    const double moment = 0.5 * speed_ * speed_ * body.munk.cwiseAbs().maxCoeff();
    const double at = body.frame.p.norm();
    for (std::size_t moved = body.link; moved > 0;) {  // the joints on the way to the base
      const Joint& joint = robot_.joints[moved - 1];
      most_of_joints_[static_cast<Eigen::Index>(moved - 1)] +=
          joint.type == JointType::kRevolute ? (farthest(moved, body.link) + at) * force + moment
                                             : force;
      moved = static_cast<std::size_t>(joint.parent);
    }
    most_force_ += force;
    most_moment_ += (farthest(0, body.link) + at) * force + moment;
  }
}

/// The twist of the base at rates n, in its axes.
Screw<double> CurrentCases::base_twist(const Eigen::VectorXd& n) const {
  Screw<double> twist;
  for (std::size_t i = 0; i < robot_.base_axes.size(); ++i) {
    const int axis = robot_.base_axes[i];
    (axis < 3 ? twist.linear : twist.angular)[axis % 3] = n[static_cast<Eigen::Index>(i)];
  }
  return twist;
}

double CurrentCases::most(const Eigen::VectorXd& n) const {
  const Screw<double> base = base_twist(n);
  double most = base.linear.norm() * most_force_;
  if (!base.angular.isZero(0)) most += base.angular.norm() * most_moment_;  // which may be infinite
  for (Eigen::Index i = 0; i < most_of_joints_.size(); ++i) {
    const double rate = n[n.size() - most_of_joints_.size() + i];
    if (rate != 0) most += std::abs(rate) * most_of_joints_[i];
  }
  return most;
}

void CurrentCases::set(const Posture& posture) {
  posture_ = &posture;
  for (Body& body : bodies_) {
    const Pose<double>& link = posture.links[body.link];
    body.at.R = link.R;
    if (body.turned) body.at.R *= body.frame.R;
    body.at.p = link.p;
    body.at.p.noalias() += link.R * body.frame.p;
    body.E.noalias() = posture.base.R * body.at.R;
  }
}

/// Computes the twists of the links at rates n, in base axes at the base's origin.
void CurrentCases::move_links(const Eigen::VectorXd& n) {
  links_.front() = base_twist(n);
  const std::size_t axes = robot_.base_axes.size();
  for (std::size_t i = 0; i < robot_.joints.size(); ++i) {
    const Joint& joint = robot_.joints[i];
    Screw<double>& twist = links_[i + 1];
    twist = links_[static_cast<std::size_t>(joint.parent)];
    const double rate = n[static_cast<Eigen::Index>(axes + i)];
    if (rate == 0) continue;
    const Pose<double>& frame = posture_->links[i + 1];
    const Eigen::Vector3d axis = frame.R * (rate * joint.axis);
    if (joint.type == JointType::kRevolute) {
      twist.angular += axis;
      twist.linear += frame.p.cross(axis);
    } else {
      twist.linear += axis;
    }
  }
}

/// Adds what a body has in a, M and w. At rates n it has the velocity v and the angular velocity o.
/// With the components u of V, all along its axes, its part of n'tau is
/// sum_i v_i (D_i u_i + d_i |u_i| u_i) + o'(u x A u).
void CurrentCases::add(const Body& body) {
  const Screw<double>& twist = links_[body.link];
  const Eigen::Matrix3d& R = body.at.R;
  const Eigen::Matrix3d& E = body.E;
  const Eigen::Vector3d v = R.transpose() * (twist.linear + twist.angular.cross(body.at.p));
  const Eigen::Vector3d k = (R.transpose() * twist.angular).cwiseProduct(body.munk);
  if (body.has_linear) a_ += E * body.linear.cwiseProduct(v);
  // o'(u x A u) = u_x (k_z u_y + k_y u_z) + u_y k_x u_z, where u_x = x'V, and so on.
  const Eigen::Vector3d x = E.col(0), y = E.col(1);
  const Eigen::Vector3d with_x = k[2] * y + k[1] * E.col(2), with_y = k[0] * E.col(2);
  const auto square = [&](int i) { return x[i] * with_x[i] + y[i] * with_y[i]; };
  const auto product = [&](int i, int j) {
    return x[i] * with_x[j] + x[j] * with_x[i] + y[i] * with_y[j] + y[j] * with_y[i];
  };
  m_[0] += square(0);
  m_[1] += square(1);
  m_[3] += product(0, 1);
  if (!horizontal_) {
    m_[2] += square(2);
    m_[4] += product(0, 2);
    m_[5] += product(1, 2);
  }
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double w = body.quadratic[i] * v[i];
    if (w == 0) continue;
    const double z = horizontal_ ? 0 : E(2, i);
    const double length = E(0, i) * E(0, i) + E(1, i) * E(1, i) + z * z;
    axes_.push_back({w, {E(0, i), E(1, i), z}, std::abs(w) * length});
  }
}

void CurrentCases::aim(const Eigen::VectorXd& n) {
  move_links(n);
  a_.setZero();
  m_.setZero();
  axes_.clear();
  for (const Body& body : bodies_) {
    const Screw<double>& twist = links_[body.link];
    if (!twist.linear.isZero(0) || !twist.angular.isZero(0)) add(body);
  }
  if (horizontal_) a_[2] = 0;
  // |V'M V| by the largest |eigenvalue| of the 2x2 part of M, or by its norm.
  const auto squared = [](double number) { return number * number; };
  double by_square =
      horizontal_
          ? 0.5 * (std::abs(m_[0] + m_[1]) + std::sqrt(squared(m_[0] - m_[1]) + squared(m_[3])))
          : std::sqrt(m_.head<3>().squaredNorm() + 0.5 * m_.tail<3>().squaredNorm());
  for (const DragAxis<double>& axis : axes_) by_square += axis.most;
  bound_ = speed_ * (a_.norm() + speed_ * by_square);
  estimated_ = false;
}

/// Estimates both parts of n'tau of all directions.
template <bool kHorizontal>
void CurrentCases::estimate() {
  const double scale = speed_ / bound_;
  const Eigen::Vector3f a = (scale * a_).cast<float>();
  const Eigen::Matrix<float, 6, 1> m = (scale * speed_ * m_).cast<float>();
  estimated_axes_.clear();
  for (const DragAxis<double>& axis : axes_) {
    const double w = scale * speed_ * axis.w;
    if (scale * speed_ * axis.most < kLeftOut) continue;
    estimated_axes_.push_back({static_cast<float>(w),
                               {static_cast<float>(axis.e[0]), static_cast<float>(axis.e[1]),
                                static_cast<float>(axis.e[2])}});
  }
  for (Eigen::Index at = 0; at < U_.rows(); at += kAtOnce) {
    const Directions x = U_.col(0).segment<kAtOnce>(at), y = U_.col(1).segment<kAtOnce>(at);
    Directions odd = a[0] * x + a[1] * y;
    Directions even = (m[0] * x + m[3] * y) * x + m[1] * y * y;
    if constexpr (kHorizontal) {
      for (const DragAxis<float>& axis : estimated_axes_) {
        const Directions along = axis.e[0] * x + axis.e[1] * y;
        odd += axis.w * along * along.abs();
      }
    } else {
      const Directions z = U_.col(2).segment<kAtOnce>(at);
      odd += a[2] * z;
      even += (m[4] * x + m[5] * y + m[2] * z) * z;
      for (const DragAxis<float>& axis : estimated_axes_) {
        const Directions along = axis.e[0] * x + axis.e[1] * y + axis.e[2] * z;
        odd += axis.w * along * along.abs();
      }
    }
    odd_.segment<kAtOnce>(at) = odd;
    even_.segment<kAtOnce>(at) = even;
  }
  estimated_ = true;
}

/// Returns the larger side n'tau of direction i and of its opposite, if there is one.
double CurrentCases::larger(Eigen::Index i, double side, int& which) const {
  const double x = V_(i, 0), y = V_(i, 1), z = V_(i, 2);
  const double even =
      (m_[0] * x + m_[3] * y + m_[4] * z) * x + (m_[1] * y + m_[5] * z) * y + m_[2] * z * z;
  double odd = a_[0] * x + a_[1] * y + a_[2] * z;
  for (const DragAxis<double>& axis : axes_) {
    const double along = axis.e[0] * x + axis.e[1] * y + axis.e[2] * z;
    odd += axis.w * along * std::abs(along);
  }
  const auto at = static_cast<std::size_t>(i);
  const bool backward = backward_[at] >= 0 && side * odd < 0;
  which = (backward ? backward_ : forward_)[at];
  return side * even + (backward ? -side : side) * odd;
}

/// Each term of an estimate differs from its value by at most 13 roundings, and their sum of k + 4
/// by k + 4 more, of at most 1.5 times the bound altogether. So the worst case is among the
/// directions whose estimates are within twice that of the largest. If the bound is zero or not
/// finite, estimates are not numbers, and all directions are computed.
double CurrentCases::worst(double side, int& which) {
  if (!estimated_) horizontal_ ? estimate<true>() : estimate<false>();
  const auto sign = static_cast<float>(side);
  total_ = sign * even_ + (sign * odd_).max((sign * mirror_) * odd_);
  const float margin =
      4 * std::numeric_limits<float>::epsilon() * static_cast<float>(16 + axes_.size());
  const float least = total_.head(V_.rows()).maxCoeff() - margin;
  double worst = -kInfinity;
  which = forward_.front();
  for (Eigen::Index i = 0; i < V_.rows(); ++i) {
    if (total_[i] < least) continue;
    int own = 0;
    const double value = larger(i, side, own);
    if (!(value > worst) && !std::isnan(value)) continue;  // what is not a number stays
    worst = value;
    which = own;
  }
  return worst;
}

}  // namespace maxwrench
