#include <algorithm>
#include <stdexcept>

#include "verify/model.h"

// Any wrench at the end effector, computed from what the base exerts.

namespace maxwrench {
namespace {

/// [-, m] Smaller motions off the base's free axes are rounding.
constexpr long double kOffAxes = 1e-13L;

/// Throws std::invalid_argument if the twist moves the base off its free axes.
void require_free(const Problem& problem, const std::array<FormVector, 2>& twist,
                  const std::vector<double>& far) {
  const std::vector<int>& axes = problem.robot.base_axes;
  for (int axis = 0; axis < 6; ++axis) {
    if (std::find(axes.begin(), axes.end(), axis) != axes.end()) continue;
    const auto part = static_cast<std::size_t>(axis / 3), at = static_cast<std::size_t>(axis % 3);
    if (twist[part][at].magnitude(far) > kOffAxes) {
      throw std::invalid_argument(problem.name +
                                  ": wrench: got 'any', expected pure: the base's free axes do not "
                                  "cover all motions of its arm");
    }
  }
}

}  // namespace

/// First moment of all that a link of the chain does not carry, about the link's origin and in its
/// axes. `before`: the same for its parent.
FormVector FormModel::inboard(std::size_t link, const FormVector& before) const {
  const FormPose& place = places_[link - 1];
  const Wide rest = carried_[0] - carried_[link];
  const FormVector& of_parent = moment_[static_cast<std::size_t>(parent(link))];
  return transposed(place.R) * (before + of_parent - Form(shape_, rest) * place.p);
}

void FormModel::sum_total() {
  FormVector before = constant(Eigen::Vector3d::Zero());
  total_ = load_;
  for (std::size_t i = 1; i < mass_.size(); ++i) {
    if (!on_chain_[i]) continue;
    before = inboard(i, before);
    total_[i] = load_[i] + cross(before, pull_[i]);
  }
}

std::array<FormVector, 2> FormModel::carrying() const {
  Vector6d angular_first;
  angular_first << problem_.c.tail<3>(), problem_.c.head<3>();
  const auto [angular, linear] = from_end_effector(angular_first);
  const auto at_base = to_base(tip().link, angular, linear);
  const std::array<FormVector, 2> twist = {at_base[1], at_base[0]};
  require_free(problem_, twist, far_);
  return twist;
}

std::array<FormVector, 2> FormModel::screw(std::size_t joint) const {
  const Joint& at = problem_.robot.joints[joint];
  const FormVector axis = constant(at.axis);
  const FormVector none = constant(Eigen::Vector3d::Zero());
  if (!on_chain_[joint + 1]) return {none, none};  // it does not move the end effector
  const bool turns = at.type == JointType::kRevolute;
  const auto at_base =
      to_base(static_cast<int>(joint) + 1, turns ? axis : none, turns ? none : axis);
  const std::array<FormVector, 2> twist = {at_base[1], at_base[0]};
  require_free(problem_, twist, far_);
  return twist;
}

Form FormModel::weight_along_c() const {
  const auto link = static_cast<std::size_t>(tip().link);
  const FormVector weight = Form(shape_, carried_[0]) * pull_[link];
  Vector6d angular_first;
  angular_first << problem_.c.tail<3>(), problem_.c.head<3>();
  const auto [angular, linear] = from_end_effector(angular_first);
  return dot(linear, weight) + dot(angular, total_[link]);
}

Form FormModel::weight_at(std::size_t joint) const {
  if (!on_chain_[joint + 1]) return held_by(joint);
  const Joint& at = problem_.robot.joints[joint];
  const FormVector axis = constant(at.axis);
  if (at.type == JointType::kRevolute) return dot(axis, total_[joint + 1] - load_[joint + 1]);
  const Wide rest = carried_[0] - carried_[joint + 1];
  return Form(shape_, rest) * dot(axis, pull_[joint + 1]);
}

}  // namespace maxwrench
