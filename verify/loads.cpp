#include "verify/model.h"

// The loads of weights and wrenches on the actuators.

namespace maxwrench {

/// Sets gravity and its moments, from the end effector to the base and outward into side branches
/// of the tree.
void FormModel::weigh() {
  const Robot& robot = problem_.robot;
  const FormVector nothing = constant(Eigen::Vector3d::Zero());
  pull_.assign(robot.links.size(), nothing);
  FormVector pull = transposed(pose_R_) * constant({0, 0, -robot.gravity});
  pull = matrix(tip().placement.R) * pull;
  for (auto link = static_cast<std::size_t>(tip().link);;
       link = static_cast<std::size_t>(parent(link))) {
    pull_[link] = pull;
    if (link == 0) break;
    pull = places_[link - 1].R * pull;
  }
  load_.assign(robot.links.size(), nothing);
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    if (on_chain_[i]) {
      load_[i] = cross(moment_[i], pull_[i]);
    } else if (coordinates_.base_is_dependent) {
      pull_[i] = transposed(places_[i - 1].R) * pull_[static_cast<std::size_t>(parent(i))];
      load_[i] = cross(moment_[i], pull_[i]);
    }
  }
  for (std::size_t i = robot.joints.size(); i > 0; --i) {
    if (!on_chain_[i]) continue;
    const auto to = static_cast<std::size_t>(parent(i));
    const FormPose& place = places_[i - 1];
    load_[to] =
        load_[to] + place.R * load_[i] + cross(place.p, Form(shape_, carried_[i]) * pull_[to]);
  }
}

FormVector FormModel::from_world(const FormVector& x) const {
  FormMatrix R = matrix(problem_.robot.mount.R);
  if (coordinates_.has_yaw()) R = R * turn(2, coordinates_.yaw);
  return transposed(R) * x;
}

/// Sets gravity and its moments again for the base and the side branches, from the base's own
/// orientation.
void FormModel::weigh_from_base() {
  const Robot& robot = problem_.robot;
  std::vector<FormVector> pull = {from_world(constant({0, 0, -robot.gravity}))};
  for (std::size_t i = 1; i < robot.links.size(); ++i) {
    pull.push_back(transposed(places_[i - 1].R) * pull[static_cast<std::size_t>(parent(i))]);
    if (on_chain_[i]) continue;
    pull_[i] = pull[i];
    load_[i] = cross(moment_[i], pull_[i]);
  }
  FormVector moment = moment_[static_cast<std::size_t>(tip().link)];
  for (auto i = static_cast<std::size_t>(tip().link); i > 0;
       i = static_cast<std::size_t>(parent(i))) {
    moment = moment_[static_cast<std::size_t>(parent(i))] + places_[i - 1].R * moment +
             Form(shape_, carried_[i]) * places_[i - 1].p;
  }
  pull_[0] = pull[0];
  load_[0] = cross(moment, pull_[0]);
}

std::vector<Form> FormModel::tau_d() const {
  const Robot& robot = problem_.robot;
  std::vector<Form> rows;
  for (const int axis : robot.base_axes) {
    const auto at = static_cast<std::size_t>(axis % 3);
    rows.push_back(axis < 3 ? -(Form(shape_, carried_[0]) * pull_[0][at]) : -load_[0][at]);
  }
  for (std::size_t i = 0; i < robot.joints.size(); ++i) rows.push_back(held_by(i));
  return rows;
}

Form FormModel::held_by(std::size_t joint) const {
  const Joint& at = problem_.robot.joints[joint];
  const FormVector weight = Form(shape_, carried_[joint + 1]) * pull_[joint + 1];
  const bool turns = at.type == JointType::kRevolute;
  return -dot(constant(at.axis), turns ? load_[joint + 1] : weight);
}

/// Converts a force and its moment, or an angular velocity and a linear one, from a link's origin
/// and axes to those of the base.
std::array<FormVector, 2> FormModel::to_base(int link, FormVector along, FormVector about) const {
  for (auto i = static_cast<std::size_t>(link); i > 0; i = static_cast<std::size_t>(parent(i))) {
    along = places_[i - 1].R * along;
    about = places_[i - 1].R * about + cross(places_[i - 1].p, along);
  }
  return {along, about};
}

/// Converts h to the origin and axes of the link that carries the end effector. Wrenches that turn
/// with the end effector are constant in its axes.
std::array<FormVector, 2> FormModel::from_end_effector(const Vector6d& h) const {
  const FormMatrix into =
      transposed(problem_.free.wrench_turns ? matrix(problem_.pose.R) : pose_R_);
  const FormMatrix R = matrix(tip().placement.R);
  const FormVector along = R * (into * constant(h.head<3>()));
  const FormVector about = R * (into * constant(h.tail<3>()));
  return {along, about + cross(constant(tip().placement.p), along)};
}

std::vector<Form> FormModel::exerted(const Vector6d& h) const {
  const Robot& robot = problem_.robot;
  std::vector<Form> rows(static_cast<std::size_t>(robot.velocities()), Form(shape_));
  const std::size_t base = robot.base_axes.size();
  auto [force, moment] = from_end_effector(h);
  for (auto i = static_cast<std::size_t>(tip().link); i > 0;
       i = static_cast<std::size_t>(parent(i))) {
    const Joint& joint = robot.joints[i - 1];
    const bool turns = joint.type == JointType::kRevolute;
    rows[base + i - 1] = dot(constant(joint.axis), turns ? moment : force);
    force = places_[i - 1].R * force;
    moment = places_[i - 1].R * moment + cross(places_[i - 1].p, force);
  }
  if (!coordinates_.base_is_dependent) {
    exert_on_base(h, rows);
    return rows;
  }
  for (std::size_t i = 0; i < base; ++i) {
    const auto axis = static_cast<std::size_t>(robot.base_axes[i]);
    rows[i] = axis < 3 ? force[axis] : moment[axis - 3];
  }
  return rows;
}

std::vector<FormVector> FormModel::levers() const {
  const FormVector nothing = constant(Eigen::Vector3d::Zero());
  std::vector<FormVector> rows(static_cast<std::size_t>(problem_.robot.velocities()), nothing);
  for (std::size_t k = 0; k < 3; ++k) {
    const FormVector force = constant(Eigen::Vector3d::Unit(static_cast<Eigen::Index>(k)));
    const std::vector<Form> column = exerted_by_contact(force, nothing);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i][k] = column[i];
  }
  return rows;
}

std::vector<Form> FormModel::exerted_by_contact(const FormVector& force,
                                                const FormVector& torque) const {
  const Robot& robot = problem_.robot;
  const auto at = static_cast<std::size_t>(problem_.contact->end_effector);
  const EndEffector& touching = robot.end_effectors[at];
  std::vector<Form> rows(static_cast<std::size_t>(robot.velocities()), Form(shape_));
  const std::size_t base = robot.base_axes.size();
  const auto moment_about = [&](int link, const FormVector& along, const FormVector& about) {
    return about + cross(seen(touching.link, constant(touching.placement.p), link), along);
  };
  const FormVector moment = moment_about(0, force, torque);
  for (std::size_t i = 0; i < base; ++i) {
    const auto axis = static_cast<std::size_t>(robot.base_axes[i]);
    rows[i] = axis < 3 ? force[axis] : moment[axis - 3];
  }
  for (int link = touching.link; link > 0; link = parent(static_cast<std::size_t>(link))) {
    const auto joint = static_cast<std::size_t>(link - 1);
    const FormVector along = seen(0, force, link, false), about = seen(0, torque, link, false);
    const bool turns = robot.joints[joint].type == JointType::kRevolute;
    rows[base + joint] =
        dot(constant(robot.joints[joint].axis), turns ? moment_about(link, along, about) : along);
  }
  return rows;
}

std::vector<Form> FormModel::contact_load(const Eigen::VectorXd& low,
                                          const Eigen::VectorXd& high) const {
  const Matrix6Xd& C = problem_.contact->C;
  const FormVector nothing = constant(Eigen::Vector3d::Zero());
  std::array<FormVector, 2> wrench = {nothing, nothing};  // in the contact's frame
  for (Eigen::Index k = 0; k < C.cols(); ++k) {
    const Form w(shape_, coordinates_.shares + static_cast<int>(k), Wide(low[k]),
                 Wide(high[k]) - Wide(low[k]), 0.0L);
    for (std::size_t i = 0; i < 2; ++i) {
      wrench[i] = wrench[i] + w * constant(C.col(k).segment<3>(3 * static_cast<Eigen::Index>(i)));
    }
  }
  const FormMatrix R = contact_frame().R;
  const auto in_base = [&](const FormVector& x) {
    if (!coordinates_.base_is_dependent) return from_world(R * x);
    return seen(tip().link, matrix(tip().placement.R) * into_pose(R * x, false), 0, false);
  };
  return exerted_by_contact(in_base(wrench[0]), in_base(wrench[1]));
}

/// Sets the base's rows, from the base's yaw and the position of the end effector in base axes.
void FormModel::exert_on_base(const Vector6d& h, std::vector<Form>& rows) const {
  const auto in_base = [&](const Eigen::Vector3d& x) {
    if (!problem_.free.wrench_turns) return from_world(constant(x));
    return from_world(pose_R_ * (transposed(matrix(problem_.pose.R)) * constant(x)));
  };
  const FormVector force = in_base(h.head<3>());
  const FormVector at = seen(tip().link, constant(tip().placement.p), 0);
  const FormVector moment = in_base(h.tail<3>()) + cross(at, force);
  for (std::size_t i = 0; i < problem_.robot.base_axes.size(); ++i) {
    const auto axis = static_cast<std::size_t>(problem_.robot.base_axes[i]);
    rows[i] = axis < 3 ? force[axis] : moment[axis - 3];
  }
}

FormVector FormModel::along_at_base(const Vector6d& c, bool force) const {
  Vector6d h = Vector6d::Zero();
  h.head<3>() = force ? c.head<3>() : c.tail<3>();
  const auto [along, about] = from_end_effector(h);
  return to_base(tip().link, along, about)[0];
}

}  // namespace maxwrench
