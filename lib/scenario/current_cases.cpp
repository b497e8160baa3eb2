#include "lib/scenario/current_cases.h"

#include <cmath>

#include "maxwrench/posture.h"

namespace maxwrench {
namespace {

/// The components of V and their products come before the axes of bodies.
constexpr Eigen::Index kForms = 9;

}  // namespace

CurrentCases::CurrentCases(const Robot& robot, const LoadGroup& cases)
    : robot_(robot),
      coordinates_(static_cast<std::size_t>(robot.velocities())),
      carried_(robot.links.size()),
      currents_(static_cast<Eigen::Index>(cases.size()), 3) {
  Eigen::Index row = 0;
  for (const LoadCase& each : cases) currents_.row(row++) = each.current.transpose().array();
  if (cases.size() > 0) speed_ = std::sqrt(currents_.square().rowwise().sum().maxCoeff());
  used_ = (currents_ != 0).colwise().any().transpose().cast<double>();
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
  along_.resize(3, static_cast<Eigen::Index>(axes_.size()));
  middle_.setZero(terms);
  width_.setZero(terms);
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

/// The power of g |e'V| e'V at a point of a link along each coordinate that moves the link.
void CurrentCases::set_axes() {
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const DragAxis& axis = axes_[i];
    const Pose<double>& frame = posture_->links[axis.link];
    const Eigen::Vector3d e = frame.R * axis.along;
    const Eigen::Vector3d moment = (frame.R * axis.at + frame.p).cross(e);
    const auto column = static_cast<Eigen::Index>(i);
    along_.col(column) = e;
    for (const int moved : moving_[axis.link]) {
      const Screw& screw = coordinates_[static_cast<std::size_t>(moved)];
      factors_(kForms + column, moved) =
          axis.damping * (e.dot(screw.linear) + moment.dot(screw.angular));
    }
  }
}

void CurrentCases::set_terms() {
  const Eigen::Matrix3d R = -posture_->base.R;
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
  for (Eigen::Index i = 0; i < along_.cols(); ++i) {
    auto term = terms_.col(kForms + i).array();
    term = x * along_(0, i) + y * along_(1, i) + z * along_(2, i);
    term *= term.abs();
  }
  has_terms_ = true;
}

void CurrentCases::set(const Posture& posture) {
  posture_ = &posture;
  has_terms_ = false;
  set_coordinates(posture);
  set_composites(posture);
  set_forms();
  set_axes();
}

/// The largest |a'V| of all cases, or more, for a unit vector a of base axes.
double CurrentCases::reach(const Eigen::Vector3d& along) const {
  return speed_ * (posture_->base.R * along).cwiseProduct(used_).norm();
}

void CurrentCases::bound(Eigen::ArrayXd& centre, Eigen::ArrayXd& half) {
  const Eigen::Vector3d V = speed_ * (used_.asDiagonal() * posture_->base.R).colwise().norm();
  width_.head<3>() = V;
  middle_.segment<3>(3) = 0.5 * V.cwiseAbs2();  // of squares: from zero on
  width_.segment<3>(3) = middle_.segment<3>(3);
  width_.segment<3>(6) << V[0] * V[1], V[0] * V[2], V[1] * V[2];
  for (Eigen::Index i = 0; i < along_.cols(); ++i) {
    const double most = reach(along_.col(i));
    width_[kForms + i] = most * most;
  }
  centre.matrix().noalias() = factors_.middleRows<3>(3).transpose() * middle_.segment<3>(3);
  half.matrix().noalias() = factors_.cwiseAbs().transpose() * width_;
}

void CurrentCases::project(const Eigen::Ref<const Eigen::VectorXd>& normal,
                           Eigen::ArrayXd& values) {
  if (!has_terms_) set_terms();
  weights_.noalias() = factors_ * normal;
  values.matrix().noalias() = terms_ * weights_;
}

}  // namespace maxwrench
