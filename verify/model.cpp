#include "verify/model.h"

#include <algorithm>
#include <stdexcept>

#include "verify/wide_matrix.h"

namespace maxwrench {
namespace {

/// Off the base's free axes these [-, m] are rounding.
constexpr long double kOffAxes = 1e-13L;

std::vector<int> terms_of(const Problem& problem) {
  std::vector<int> terms;
  for (const int joint : problem.redundant) {
    const Joint& at = problem.robot.joints[static_cast<std::size_t>(joint)];
    terms.push_back(at.type == JointType::kRevolute ? 3 : 2);
  }
  return terms;
}

void refuse_unless(bool serves, const Problem& problem) {
  if (serves) return;
  throw std::invalid_argument(problem.name +
                              ": expected a static task with one contact and a given pose, whose "
                              "base follows from theta_r in closed form");
}

Wide exact_product(double a, double b) { return Wide(a) * Wide(b); }

}  // namespace

FormModel::FormModel(const Problem& problem)
    : problem_(problem),
      shape_(terms_of(problem)),
      variable_(problem.robot.joints.size(), -1),
      on_chain_(problem.robot.links.size(), 0) {
  refuse_unless(
      !problem.motion && !problem.contact && problem.free.count() == 0 && problem.dependent.empty(),
      problem);
  const Robot& robot = problem.robot;
  int link = robot.end_effectors[static_cast<std::size_t>(problem.end_effector)].link;
  for (; link > 0; link = parent(static_cast<std::size_t>(link))) {
    on_chain_[static_cast<std::size_t>(link)] = 1;
  }
  on_chain_[0] = 1;
  for (std::size_t i = 0; i < problem.redundant.size(); ++i) {
    const auto joint = static_cast<std::size_t>(problem.redundant[i]);
    refuse_unless(on_chain_[joint + 1] != 0, problem);
    variable_[joint] = static_cast<int>(i);
    const auto at = static_cast<Eigen::Index>(i);
    far_.push_back(std::max(std::abs(problem.theta_r_min[at]), std::abs(problem.theta_r_max[at])) +
                   1);
  }
  for (std::size_t i = 0; i < robot.joints.size(); ++i) places_.push_back(place_of(i));
  weigh_links();
  weigh();
  sum_total();
}

FormVector FormModel::constant(const Eigen::Vector3d& x) const {
  const auto form = [&](int i) { return Form(shape_, static_cast<long double>(x[i])); };
  return {form(0), form(1), form(2)};
}

FormMatrix FormModel::matrix(const Eigen::Matrix3d& R) const {
  return transposed({constant(R.col(0)), constant(R.col(1)), constant(R.col(2))});
}

/// Rodrigues: a joint turns its link by 1 + sin q S + (1 - cos q) S S, S = [axis]x.
FormModel::Place FormModel::place_of(std::size_t joint) const {
  const Joint& at = problem_.robot.joints[joint];
  const int variable = variable_[joint];
  const double rest = std::clamp(0.0, at.q_min, at.q_max);
  Place place{matrix(at.placement.R), constant(at.placement.p)};
  if (at.type == JointType::kPrismatic) {
    const FormVector along = place.R * constant(at.axis);
    const Form q = variable < 0 ? Form(shape_, static_cast<long double>(rest))
                                : Form(shape_, variable, 0.0L, 1.0L, 0.0L);
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

void FormModel::weigh_links() {
  const Robot& robot = problem_.robot;
  for (const Link& link : robot.links) {
    const Wide displaced = exact_product(robot.water_density, link.volume);
    mass_.push_back(Wide(link.mass) - displaced);
    moment_.push_back(Form(shape_, Wide(link.mass)) * constant(link.com) -
                      Form(shape_, displaced) * constant(link.cob));
  }
  const Wide lift(robot.trim.buoyancy_mass);
  mass_[0] -= lift;
  moment_[0] = moment_[0] - Form(shape_, lift) * constant(robot.trim.position);
  carried_ = mass_;
  for (std::size_t i = robot.joints.size(); i > 0; --i) {
    carried_[static_cast<std::size_t>(parent(i))] += carried_[i];
  }
}

/// Gravity and what it does, from the end effector to the base and into other branches.
void FormModel::weigh() {
  const Robot& robot = problem_.robot;
  const EndEffector& tip = robot.end_effectors[static_cast<std::size_t>(problem_.end_effector)];
  const FormVector nothing = constant(Eigen::Vector3d::Zero());
  pull_.assign(robot.links.size(), nothing);
  FormVector pull = transposed(matrix(problem_.pose.R)) * constant({0, 0, -robot.gravity});
  pull = matrix(tip.placement.R) * pull;
  for (auto link = static_cast<std::size_t>(tip.link);;
       link = static_cast<std::size_t>(parent(link))) {
    pull_[link] = pull;
    if (link == 0) break;
    pull = places_[link - 1].R * pull;
  }
  for (std::size_t i = 1; i < robot.links.size(); ++i) {
    if (on_chain_[i]) continue;
    pull_[i] = transposed(places_[i - 1].R) * pull_[static_cast<std::size_t>(parent(i))];
  }
  for (std::size_t i = 0; i < robot.links.size(); ++i) load_.push_back(cross(moment_[i], pull_[i]));
  for (std::size_t i = robot.joints.size(); i > 0; --i) {
    const auto to = static_cast<std::size_t>(parent(i));
    const Place& place = places_[i - 1];
    load_[to] =
        load_[to] + place.R * load_[i] + cross(place.p, Form(shape_, carried_[i]) * pull_[to]);
  }
}

/// First moment, about the origin of a link of the chain and in its axes, of all that it does not
/// carry; `before`: the same of its parent.
FormVector FormModel::inboard(std::size_t link, const FormVector& before) const {
  const auto base = static_cast<std::size_t>(parent(link));
  const std::size_t links = mass_.size();
  std::vector<FormVector> moment = moment_;  // of all that hangs on a branch
  for (std::size_t i = links - 1; i > base; --i) {
    if (on_chain_[i]) continue;
    const auto to = static_cast<std::size_t>(parent(i));
    moment[to] =
        moment[to] + places_[i - 1].R * moment[i] + Form(shape_, carried_[i]) * places_[i - 1].p;
  }
  const Place& place = places_[link - 1];
  const Wide rest = carried_[0] - carried_[link];
  return transposed(place.R) * (before + moment[base] - Form(shape_, rest) * place.p);
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

/// A force and its moment, or an angular velocity and a linear one, at a link's origin in its axes
/// -> at the base's.
std::array<FormVector, 2> FormModel::to_base(int link, FormVector along, FormVector about) const {
  for (auto i = static_cast<std::size_t>(link); i > 0; i = static_cast<std::size_t>(parent(i))) {
    along = places_[i - 1].R * along;
    about = places_[i - 1].R * about + cross(places_[i - 1].p, along);
  }
  return {along, about};
}

/// At the origin of the link that carries the end effector.
std::array<FormVector, 2> FormModel::from_end_effector(const Vector6d& h) const {
  const EndEffector& tip =
      problem_.robot.end_effectors[static_cast<std::size_t>(problem_.end_effector)];
  const FormMatrix into = transposed(matrix(problem_.pose.R)), R = matrix(tip.placement.R);
  const FormVector along = R * (into * constant(h.head<3>()));
  const FormVector about = R * (into * constant(h.tail<3>()));
  return {along, about + cross(constant(tip.placement.p), along)};
}

std::vector<Form> FormModel::exerted(const Vector6d& h) const {
  const Robot& robot = problem_.robot;
  std::vector<Form> rows(static_cast<std::size_t>(robot.velocities()), Form(shape_));
  const std::size_t base = robot.base_axes.size();
  auto [force, moment] = from_end_effector(h);
  const EndEffector& tip = robot.end_effectors[static_cast<std::size_t>(problem_.end_effector)];
  for (auto i = static_cast<std::size_t>(tip.link); i > 0;
       i = static_cast<std::size_t>(parent(i))) {
    const Joint& joint = robot.joints[i - 1];
    const bool turns = joint.type == JointType::kRevolute;
    rows[base + i - 1] = dot(constant(joint.axis), turns ? moment : force);
    force = places_[i - 1].R * force;
    moment = places_[i - 1].R * moment + cross(places_[i - 1].p, force);
  }
  for (std::size_t i = 0; i < base; ++i) {
    const auto axis = static_cast<std::size_t>(robot.base_axes[i]);
    rows[i] = axis < 3 ? force[axis] : moment[axis - 3];
  }
  return rows;
}

FormVector FormModel::along_at_base(bool force) const {
  Vector6d h = Vector6d::Zero();
  h.head<3>() = force ? problem_.c.head<3>() : problem_.c.tail<3>();
  const int link =
      problem_.robot.end_effectors[static_cast<std::size_t>(problem_.end_effector)].link;
  const auto [along, about] = from_end_effector(h);
  return to_base(link, along, about)[0];
}

namespace {

/// Throws std::invalid_argument unless nothing moves the base off its free axes.
void require_free(const Problem& problem, const std::array<FormVector, 2>& twist,
                  const std::vector<double>& far) {
  const std::vector<int>& axes = problem.robot.base_axes;
  for (int axis = 0; axis < 6; ++axis) {
    if (std::find(axes.begin(), axes.end(), axis) != axes.end()) continue;
    const auto part = static_cast<std::size_t>(axis / 3), at = static_cast<std::size_t>(axis % 3);
    if (twist[part][at].magnitude(far) > kOffAxes) {
      throw std::invalid_argument(problem.name +
                                  ": wrench: got 'any', expected pure: the base's free axes do not "
                                  "take part in all that its arm does");
    }
  }
}

}  // namespace

std::array<FormVector, 2> FormModel::carrying() const {
  const EndEffector& tip =
      problem_.robot.end_effectors[static_cast<std::size_t>(problem_.end_effector)];
  Vector6d angular_first;
  angular_first << problem_.c.tail<3>(), problem_.c.head<3>();
  const auto [angular, linear] = from_end_effector(angular_first);
  const auto at_base = to_base(tip.link, angular, linear);
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
  const EndEffector& tip =
      problem_.robot.end_effectors[static_cast<std::size_t>(problem_.end_effector)];
  const auto link = static_cast<std::size_t>(tip.link);
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

/// Up to where the ways to the base meet, then outward.
FormVector FormModel::seen(int a, const Eigen::Vector3d& point, int b) const {
  std::vector<std::size_t> outward;
  FormVector x = constant(point);
  auto from = static_cast<std::size_t>(a), to = static_cast<std::size_t>(b);
  while (from != to) {  // parents come before children
    if (from > to) {
      x = places_[from - 1].R * x + places_[from - 1].p;
      from = static_cast<std::size_t>(parent(from));
    } else {
      outward.push_back(to);
      to = static_cast<std::size_t>(parent(to));
    }
  }
  for (auto link = outward.rbegin(); link != outward.rend(); ++link) {
    x = transposed(places_[*link - 1].R) * (x - places_[*link - 1].p);
  }
  return x;
}

FormVector FormModel::into(const Pose<double>& pose, const FormVector& x) const {
  return transposed(matrix(pose.R)) * (x - constant(pose.p));
}

}  // namespace maxwrench
