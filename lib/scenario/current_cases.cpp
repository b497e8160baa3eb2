#include "lib/scenario/current_cases.h"

#include <algorithm>
#include <cmath>

#include "maxwrench/posture.h"

namespace maxwrench {
namespace {

/// Two currents are opposite if their sum is below this share of the speed: rounded sines are.
constexpr double kOpposite = 1e-13;

}  // namespace

CurrentCases::CurrentCases(const Robot& robot, const LoadGroup& cases)
    : robot_(robot), frames_(robot.links.size()), joints_(robot.joints.size()) {
  for (std::size_t link = 0; link < robot.links.size(); ++link) add_link(link);
  used_.setZero();
  for (const LoadCase& each : cases) {
    speed_ = std::max(speed_, each.current.norm());
    for (Eigen::Index i = 0; i < 3; ++i) used_[i] = each.current[i] != 0 ? 1 : used_[i];
  }
  pair_opposites(cases);
  set_most();
  links_.resize(robot.links.size());
  w_.setZero(static_cast<Eigen::Index>(axes_.size()));
}

void CurrentCases::add_link(std::size_t link) {
  Water own;
  own.link = link;
  for (const HydrodynamicBody& body : robot_.links[link].hydrodynamics) {
    const Eigen::Matrix3d& R = body.frame.R;
    const Eigen::Matrix3d D = R * body.damping_linear.head<3>().asDiagonal() * R.transpose();
    own.added_mass += R * body.added_mass.head<3>().asDiagonal() * R.transpose();
    own.damping.topRows<3>() += D;
    own.damping.bottomRows<3>() += skew(body.frame.p) * D;
    for (int axis = 0; axis < 3; ++axis) {
      if (body.damping_quadratic[axis] == 0) continue;
      axes_.push_back({link, body.frame.p, R.col(axis), body.damping_quadratic[axis]});
    }
  }
  own.has_damping = !own.damping.isZero(0);
  if (own.has_damping || !own.added_mass.isZero(0)) water_.push_back(own);
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
  pairs_ = static_cast<Eigen::Index>(forward_.size());
  forward_.insert(forward_.end(), alone.begin(), alone.end());
  backward_.resize(forward_.size(), -1);
  V_.resize(static_cast<Eigen::Index>(forward_.size()), 3);
  products_.resize(V_.rows(), 6);
  for (Eigen::Index i = 0; i < V_.rows(); ++i) {
    const auto which = static_cast<std::size_t>(forward_[static_cast<std::size_t>(i)]);
    const Eigen::Vector3d V = -cases[which].current;
    V_.row(i) = V.transpose();
    products_.row(i) << V[0] * V[0], V[1] * V[1], V[2] * V[2], V[0] * V[1], V[0] * V[2],
        V[1] * V[2];
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

/// Forces of a body are at most s max D + s^2 max d, its moment V x (A V) at most s^2 max |A|. They
/// act with the longest arm.
void CurrentCases::set_most() {
  const auto axes = static_cast<Eigen::Index>(robot_.base_axes.size());
  most_.setZero(robot_.velocities());
  for (std::size_t link = 0; link < robot_.links.size(); ++link) {
    for (const HydrodynamicBody& body : robot_.links[link].hydrodynamics) {
      const double force = speed_ * body.damping_linear.head<3>().cwiseAbs().maxCoeff() +
                           speed_ * speed_ * body.damping_quadratic.head<3>().cwiseAbs().maxCoeff();
      const double moment = speed_ * speed_ * body.added_mass.head<3>().cwiseAbs().maxCoeff();
      const double at = body.frame.p.norm();
      for (std::size_t moved = link; moved > 0;) {  // the joints on the way to the base
        const Joint& joint = robot_.joints[moved - 1];
        most_[axes + static_cast<Eigen::Index>(moved - 1)] +=
            joint.type == JointType::kRevolute ? (farthest(moved, link) + at) * force + moment
                                               : force;
        moved = static_cast<std::size_t>(joint.parent);
      }
      for (Eigen::Index i = 0; i < axes; ++i) {
        const bool turns = robot_.base_axes[static_cast<std::size_t>(i)] >= 3;
        most_[i] += turns ? (farthest(0, link) + at) * force + moment : force;
      }
    }
  }
}

void CurrentCases::set(const Posture& posture) {
  R_ = posture.base.R;
  for (std::size_t link = 0; link < frames_.size(); ++link) {
    frames_[link].R = R_ * posture.links[link].R;
    frames_[link].p = R_ * posture.links[link].p;
  }
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const Pose<double>& frame = frames_[i + 1];
    const Eigen::Vector3d axis = frame.R * robot_.joints[i].axis;
    if (robot_.joints[i].type == JointType::kRevolute) {
      joints_[i] = {frame.p.cross(axis), axis};
    } else {
      joints_[i] = {axis, Eigen::Vector3d::Zero()};
    }
  }
  for (Water& water : water_) {
    const Eigen::Matrix3d& turn = frames_[water.link].R;
    water.A = turn * water.added_mass * turn.transpose();
  }
  for (DragAxis& axis : axes_) {
    const Pose<double>& frame = frames_[axis.link];
    axis.e = frame.R * axis.along;
    axis.moment = (frame.R * axis.at + frame.p).cross(axis.e);
  }
}

void CurrentCases::aim(const Eigen::VectorXd& n) {
  const std::size_t axes = robot_.base_axes.size();
  Screw<double>& base = links_.front();
  base = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  for (std::size_t i = 0; i < axes; ++i) {
    const int axis = robot_.base_axes[i];
    (axis < 3 ? base.linear : base.angular) += n[static_cast<Eigen::Index>(i)] * R_.col(axis % 3);
  }
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const double rate = n[static_cast<Eigen::Index>(axes + i)];
    const Screw<double>& parent = links_[static_cast<std::size_t>(robot_.joints[i].parent)];
    links_[i + 1] = {parent.linear + rate * joints_[i].linear,
                     parent.angular + rate * joints_[i].angular};
  }
  a_.setZero();
  m_.setZero();
  for (const Water& water : water_) {
    const Screw<double>& twist = links_[water.link];
    const Eigen::Matrix3d M = -(skew(twist.angular) * water.A);
    m_.head<3>() += M.diagonal();
    m_[3] += M(0, 1) + M(1, 0);
    m_[4] += M(0, 2) + M(2, 0);
    m_[5] += M(1, 2) + M(2, 1);
    if (!water.has_damping) continue;
    const Pose<double>& frame = frames_[water.link];
    const Eigen::Vector3d v = twist.linear + twist.angular.cross(frame.p);
    a_ += frame.R *
          (water.damping.topRows<3>().transpose() * (frame.R.transpose() * v) +
           water.damping.bottomRows<3>().transpose() * (frame.R.transpose() * twist.angular));
  }
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const DragAxis& axis = axes_[i];
    const Screw<double>& twist = links_[axis.link];
    w_[static_cast<Eigen::Index>(i)] =
        axis.damping * (axis.e.dot(twist.linear) + axis.moment.dot(twist.angular));
  }
}

double CurrentCases::bound() const {
  // Of V'M V by the norm of M: a product of two different components occurs twice in it, halved.
  const Eigen::Vector3d squares = m_.head<3>().cwiseProduct(used_);
  const Eigen::Vector3d mixed(m_[3] * used_[0] * used_[1], m_[4] * used_[0] * used_[2],
                              m_[5] * used_[1] * used_[2]);
  double by_square = std::sqrt(squares.squaredNorm() + 0.5 * mixed.squaredNorm());
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    by_square +=
        std::abs(w_[static_cast<Eigen::Index>(i)]) * axes_[i].e.cwiseProduct(used_).squaredNorm();
  }
  return speed_ * (a_.cwiseProduct(used_).norm() + speed_ * by_square);
}

double CurrentCases::worst(double side, int& which) {
  even_.matrix().noalias() = products_ * m_;
  odd_ = V_.col(0) * a_[0] + V_.col(1) * a_[1] + V_.col(2) * a_[2];
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const Eigen::Vector3d& e = axes_[i].e;
    if (used_[2] == 0) {
      along_ = V_.col(0) * e[0] + V_.col(1) * e[1];
    } else {
      along_ = V_.col(0) * e[0] + V_.col(1) * e[1] + V_.col(2) * e[2];
    }
    odd_ += w_[static_cast<Eigen::Index>(i)] * along_ * along_.abs();
  }
  const Eigen::Index alone = odd_.size() - pairs_;
  total_ = side * even_;
  total_.head(pairs_) += odd_.head(pairs_).abs();
  total_.tail(alone) += side * odd_.tail(alone);
  Eigen::Index at = 0;
  const double largest = total_.maxCoeff(&at);
  const bool backward = at < pairs_ && side * odd_[at] < 0;
  which = (backward ? backward_ : forward_)[static_cast<std::size_t>(at)];
  return largest;
}

}  // namespace maxwrench
