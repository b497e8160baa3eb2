#include "verify/model.h"

#include <algorithm>

#include "verify/wide_matrix.h"

namespace maxwrench {
namespace {

FormShape shape_of(const PostureCoordinates& coordinates) {
  std::vector<int> terms, at;
  for (const PostureCoordinates::Variable& each : coordinates.variables) {
    terms.push_back(each.turns ? 3 : 2);
    at.push_back(each.coordinate);
  }
  return {terms, at};
}

Wide exact_product(double a, double b) { return Wide(a) * Wide(b); }

}  // namespace

FormModel::FormModel(const Problem& problem) : FormModel(problem, nullptr) {}

FormModel::FormModel(const Problem& problem, const std::vector<LinkLoad>* loads,
                     const CoordinateChoice& choice)
    : problem_(problem),
      coordinates_(problem, choice),
      shape_(shape_of(coordinates_)),
      on_chain_(problem.robot.links.size(), 0),
      pose_R_(matrix(problem.pose.R)),
      shift_(constant(Eigen::Vector3d::Zero())) {
  on_chain_[0] = 1;
  for (const int joint : coordinates_.chain) on_chain_[static_cast<std::size_t>(joint) + 1] = 1;
  for (int i = 0; i < coordinates_.count(); ++i) {
    const auto& each = coordinates_.variables[static_cast<std::size_t>(i)];
    const double margin = i < coordinates_.shares ? 1 : 0;  // joints may be beyond their limits
    far_.push_back(std::max(std::abs(each.lower), std::abs(each.upper)) + margin);
  }
  set_pose();
  for (std::size_t i = 0; i < problem.robot.joints.size(); ++i) places_.push_back(place_of(i));
  weigh_links(loads);
  weigh();
  if (coordinates_.base_is_dependent) {
    sum_total();
  } else {
    weigh_from_base();
  }
}

FormVector FormModel::constant(const Eigen::Vector3d& x) const {
  const auto form = [&](int i) { return Form(shape_, static_cast<long double>(x[i])); };
  return {form(0), form(1), form(2)};
}

FormMatrix FormModel::matrix(const Eigen::Matrix3d& R) const {
  return transposed({constant(R.col(0)), constant(R.col(1)), constant(R.col(2))});
}

FormMatrix FormModel::turn(int axis, int variable) const {
  const auto i = static_cast<std::size_t>((axis + 1) % 3),
             j = static_cast<std::size_t>((axis + 2) % 3);
  FormMatrix R = matrix(Eigen::Matrix3d::Identity());
  R[i][i] = R[j][j] = Form(shape_, variable, 0.0L, 1.0L, 0.0L);
  R[j][i] = Form(shape_, variable, 0.0L, 0.0L, 1.0L);
  R[i][j] = -R[j][i];
  return R;
}

/// X(s) of `FreePose`: roll first, yaw last.
void FormModel::set_pose() {
  int variable = coordinates_.free;
  FormMatrix turned = matrix(Eigen::Matrix3d::Identity());
  for (const int axis : problem_.free.axes) {
    if (axis < 3) {
      shift_[static_cast<std::size_t>(axis)] = sliding(variable);
    } else {
      turned = turn(axis - 3, variable) * turned;
    }
    ++variable;
  }
  pose_R_ = pose_R_ * turned;
}

FormVector FormModel::pose_place() const {
  const FormMatrix along = problem_.free.along_end_effector ? pose_R_ : matrix(problem_.pose.R);
  return constant(problem_.pose.p) + along * shift_;
}

/// F(s_2) of `contact_pose`.
FormPose FormModel::contact_frame() const {
  const Contact& contact = *problem_.contact;
  FormPose pose{matrix(contact.frame.R), constant(contact.frame.p)};
  const int variable = coordinates_.regrasp;
  if (contact.surface == Surface::kCircle) {
    pose.R = pose.R * turn(1, variable);
    const Form radius(shape_, static_cast<long double>(contact.radius));
    pose.p = pose.p - radius * transposed(pose.R)[2];
    return pose;
  }
  const FormMatrix columns = transposed(pose.R);
  for (int i = 0; i < contact.coordinates(); ++i) {
    pose.p = pose.p + sliding(variable + i) * columns[static_cast<std::size_t>(i)];
  }
  return pose;
}

/// If the shift is in the end effector's own axes, R'p = R'p_0 + shift.
FormVector FormModel::into_pose(const FormVector& x, bool point) const {
  const FormMatrix back = transposed(pose_R_);
  if (!point) return back * x;
  if (problem_.free.along_end_effector) return back * (x - constant(problem_.pose.p)) - shift_;
  return back * (x - pose_place());
}

/// Rodrigues' formula: a joint rotates its link by 1 + sin q S + (1 - cos q) S S, S = [axis]x.
FormPose FormModel::place_of(std::size_t joint) const {
  const Joint& at = problem_.robot.joints[joint];
  const int variable = coordinates_.of_joint[joint];
  const double rest = rest_of(problem_, joint);
  FormPose place{matrix(at.placement.R), constant(at.placement.p)};
  if (at.type == JointType::kPrismatic) {
    const FormVector along = place.R * constant(at.axis);
    const Form q = variable < 0 ? Form(shape_, static_cast<long double>(rest)) : sliding(variable);
    place.p = place.p + q * along;
    return place;
  }
  const WideRows R = to_wide(at.placement.R), S = to_wide(skew(at.axis));
  const WideRows RS = R * S, RSS = RS * S;
  const CosSin<long double> turned = enclose_wide(rest);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const Wide still = RSS[i][j].magnitude() == 0 ? R[i][j] : R[i][j] + RSS[i][j];
      place.R[i][j] = variable < 0
                          ? Form(shape_, still - RSS[i][j] * turned.c + RS[i][j] * turned.s)
                          : Form(shape_, variable, still, -RSS[i][j], RS[i][j]);
    }
  }
  return place;
}

/// The links of a side branch count towards the link of the chain that carries them.
void FormModel::weigh_links(const std::vector<LinkLoad>* loads) {
  const Robot& robot = problem_.robot;
  for (const Link& link : robot.links) {
    if (loads) {
      mass_.emplace_back();
      moment_.push_back(constant(Eigen::Vector3d::Zero()));
      continue;
    }
    const Wide displaced_mass = exact_product(robot.water_density, link.volume);
    mass_.push_back(Wide(link.mass) - displaced_mass);
    moment_.push_back(Form(shape_, Wide(link.mass)) * constant(link.com) -
                      Form(shape_, displaced_mass) * constant(link.cob));
  }
  if (loads) {
    for (const LinkLoad& load : *loads) {
      const auto at = static_cast<std::size_t>(load.link);
      mass_[at] += Wide(load.mass);
      moment_[at] = moment_[at] + constant(load.moment);
    }
  } else {
    const Wide lift(robot.trim.buoyancy_mass);
    mass_[0] -= lift;
    moment_[0] = moment_[0] - Form(shape_, lift) * constant(robot.trim.position);
  }
  carried_ = mass_;
  for (std::size_t i = robot.joints.size(); i > 0; --i) {
    const auto to = static_cast<std::size_t>(parent(i));
    carried_[to] += carried_[i];
    if (on_chain_[i]) continue;
    const FormPose& place = places_[i - 1];
    moment_[to] = moment_[to] + place.R * moment_[i] + Form(shape_, carried_[i]) * place.p;
  }
}

/// Converts towards the base up to the common ancestor of both links, then outward.
FormVector FormModel::seen(int a, FormVector x, int b, bool point) const {
  std::vector<std::size_t> outward;
  auto from = static_cast<std::size_t>(a), to = static_cast<std::size_t>(b);
  while (from != to) {  // parents come before children
    if (from > to) {
      x = places_[from - 1].R * x;
      if (point) x = x + places_[from - 1].p;
      from = static_cast<std::size_t>(parent(from));
    } else {
      outward.push_back(to);
      to = static_cast<std::size_t>(parent(to));
    }
  }
  for (auto link = outward.rbegin(); link != outward.rend(); ++link) {
    const FormPose& place = places_[*link - 1];
    x = transposed(place.R) * (point ? x - place.p : x);
  }
  return x;
}

FormVector FormModel::into(const Pose<double>& pose, const FormVector& x) const {
  return transposed(matrix(pose.R)) * (x - constant(pose.p));
}

}  // namespace maxwrench
