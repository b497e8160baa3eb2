#include "lib/scenario/current_cases.h"

#include <algorithm>

#include "maxwrench/posture.h"

namespace maxwrench {
namespace {

/// The components of V and their products come before the axes of bodies.
constexpr Eigen::Index kForms = 9;
/// Cases of one product: larger ones would need memory from the heap.
constexpr Eigen::Index kMostRows = 64;

}  // namespace

CurrentCases::CurrentCases(const Robot& robot, const LoadGroup& cases)
    : robot_(robot),
      coordinates_(static_cast<std::size_t>(robot.velocities())),
      carried_(robot.links.size()),
      currents_(static_cast<Eigen::Index>(cases.size()), 3) {
  Eigen::Index row = 0;
  for (const LoadCase& each : cases) currents_.row(row++) = each.current.transpose().array();
  const auto axes = static_cast<int>(robot.base_axes.size());
  for (int i = 0; i < axes; ++i) {
    const int axis = robot.base_axes[static_cast<std::size_t>(i)];
    Screw& unit = coordinates_[static_cast<std::size_t>(i)];
    (axis < 3 ? unit.linear : unit.angular)[axis % 3] = 1;
  }
  for (std::size_t link = 0; link < robot.links.size(); ++link) {
    std::vector<int>& moving = moving_.emplace_back();
    for (int i = 0; i < axes; ++i) moving.push_back(i);
    for (int at = static_cast<int>(link); at > 0;
         at = robot.joints[static_cast<std::size_t>(at - 1)].parent) {
      moving.push_back(axes + at - 1);
    }
    Composite& own = own_.emplace_back();
    own.added_mass.setZero();
    own.damping.setZero();
    for (const HydrodynamicBody& body : robot.links[link].hydrodynamics) {
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
  }
  const Eigen::Index terms = kForms + static_cast<Eigen::Index>(axes_.size());
  terms_.resize(currents_.rows(), terms);
  factors_.setZero(terms, robot.velocities());
}

void CurrentCases::set_coordinates(const Posture& posture) {
  const std::size_t base = robot_.base_axes.size();
  for (std::size_t i = 0; i < robot_.joints.size(); ++i) {
    const Pose<double>& link = posture.links[i + 1];
    const Eigen::Vector3d axis = link.R * robot_.joints[i].axis;
    Screw& screw = coordinates_[base + i];
    if (robot_.joints[i].type == JointType::kRevolute) {
      screw = {link.p.cross(axis), axis};
    } else {
      screw.linear = axis;
    }
  }
}

void CurrentCases::set_composites(const Posture& posture) {
  for (std::size_t link = 0; link < own_.size(); ++link) {
    const Pose<double>& frame = posture.links[link];
    const Eigen::Matrix3d D = frame.R * own_[link].damping.topRows<3>() * frame.R.transpose();
    carried_[link].added_mass = frame.R * own_[link].added_mass * frame.R.transpose();
    carried_[link].damping.topRows<3>() = D;
    carried_[link].damping.bottomRows<3>() =
        frame.R * own_[link].damping.bottomRows<3>() * frame.R.transpose() + skew(frame.p) * D;
  }
  for (std::size_t link = own_.size() - 1; link > 0; --link) {
    Composite& parent = carried_[static_cast<std::size_t>(robot_.joints[link - 1].parent)];
    parent.added_mass += carried_[link].added_mass;
    parent.damping += carried_[link].damping;
  }
}

/// The power of V x (A V) along a turn a is V'M V with M = -[a]x A.
void CurrentCases::set_forms() {
  const std::size_t base = robot_.base_axes.size();
  for (std::size_t i = 0; i < coordinates_.size(); ++i) {
    const Screw& screw = coordinates_[i];
    const Composite& carried = carried_[i < base ? 0 : i - base + 1];
    const Eigen::Matrix3d M = -(skew(screw.angular) * carried.added_mass);
    auto factors = factors_.col(static_cast<Eigen::Index>(i));
    factors.head<3>() = carried.damping.topRows<3>().transpose() * screw.linear +
                        carried.damping.bottomRows<3>().transpose() * screw.angular;
    factors.segment<3>(3) = M.diagonal();
    factors[6] = M(0, 1) + M(1, 0);
    factors[7] = M(0, 2) + M(2, 0);
    factors[8] = M(1, 2) + M(2, 1);
  }
}

void CurrentCases::set_terms(const Posture& posture) {
  const Eigen::Matrix3d R = -posture.base.R;
  for (Eigen::Index i = 0; i < 3; ++i) {
    terms_.col(i).array() =
        currents_.col(0) * R(0, i) + currents_.col(1) * R(1, i) + currents_.col(2) * R(2, i);
  }
  const auto x = terms_.col(0).array(), y = terms_.col(1).array(), z = terms_.col(2).array();
  terms_.col(3).array() = x.square();
  terms_.col(4).array() = y.square();
  terms_.col(5).array() = z.square();
  terms_.col(6).array() = x * y;
  terms_.col(7).array() = x * z;
  terms_.col(8).array() = y * z;
  Eigen::Index term = kForms;
  for (const DragAxis& axis : axes_) {
    const Pose<double>& frame = posture.links[axis.link];
    const Eigen::Vector3d e = frame.R * axis.along;
    const Eigen::Vector3d moment = (frame.R * axis.at + frame.p).cross(e);
    for (const int i : moving_[axis.link]) {
      const Screw& screw = coordinates_[static_cast<std::size_t>(i)];
      factors_(term, i) = axis.damping * (e.dot(screw.linear) + moment.dot(screw.angular));
    }
    auto along = terms_.col(term++).array();
    along = x * e[0] + y * e[1] + z * e[2];
    along *= along.abs();
  }
}

void CurrentCases::evaluate(const Posture& posture, Eigen::ArrayXXd& tau) {
  set_coordinates(posture);
  set_composites(posture);
  set_forms();
  set_terms(posture);
  tau.resize(terms_.rows(), factors_.cols());
  for (Eigen::Index row = 0; row < terms_.rows(); row += kMostRows) {
    const Eigen::Index rows = std::min(kMostRows, terms_.rows() - row);
    tau.matrix().middleRows(row, rows).noalias() = terms_.middleRows(row, rows) * factors_;
  }
}

}  // namespace maxwrench
