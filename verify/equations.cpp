#include "verify/equations.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "verify/coordinates.h"
#include "verify/model.h"

namespace maxwrench {
namespace {

/// Rotations with rounded entries are not exact rotations, so in general no x satisfies the
/// equations of a posture exactly. Each side of a row may have an error of this share of the sum of
/// its terms' magnitudes: about ten factors, each with a few rounding errors.
constexpr long double kRoundedData = 64 * std::numeric_limits<double>::epsilon();

std::vector<Form> base_rows(const FormPose& pose, const Robot& robot) {
  std::vector<Form> rows;
  for (const FormVector& column : transposed(pose.R)) {
    rows.insert(rows.end(), column.begin(), column.end());
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (!is_free(robot, axis)) rows.push_back(pose.p[static_cast<std::size_t>(axis)]);
  }
  return rows;
}

std::vector<Form> contact_rows(const FormPose& pose, const Contact& contact) {
  std::vector<Form> rows(pose.p.begin(), pose.p.end());
  if (!contact.holds_axes) return rows;
  for (const FormVector& column : transposed(pose.R)) {
    rows.insert(rows.end(), column.begin(), column.end());
  }
  return rows;
}

FormPose constant_pose(const FormModel& model, const Pose<double>& pose) {
  return {model.matrix(pose.R), model.constant(pose.p)};
}

/// Converts a pose from the axes of link a to those of link b.
FormPose seen(const FormModel& model, int a, const FormPose& pose, int b) {
  FormMatrix columns = transposed(pose.R);
  for (FormVector& column : columns) column = model.seen(a, column, b, false);
  return {transposed(columns), model.seen(a, pose.p, b)};
}

std::vector<Form> opposite(std::vector<Form> rows) {
  for (Form& row : rows) row = -row;
  return rows;
}

}  // namespace

Equations::Equations(const Problem& problem, const FormModel& model) {
  if (!model.coordinates().base_is_dependent) add_base(problem, model);
  if (problem.contact) add_contact(problem, model);
}

void Equations::add_base(const Problem& problem, const FormModel& model) {
  const Robot& robot = problem.robot;
  const PostureCoordinates& at = model.coordinates();
  const int k = std::clamp((at.yaw + at.regrasp) / 2 - at.first, 0, at.free - at.first);
  const int before = at.resting < 0 ? 0 : 1;  // joints of the chain before its variables
  const int link = k == 0 ? 0 : at.chain[static_cast<std::size_t>(before + k - 1)] + 1;
  const EndEffector& tip = robot.end_effectors[static_cast<std::size_t>(problem.end_effector)];
  const FormPose own = constant_pose(model, {});
  FormPose left = seen(model, link, own, 0);
  if (at.has_yaw()) {
    const FormMatrix turn = model.turn(2, at.yaw);
    left = {turn * left.R, turn * left.p};
  }
  FormPose right = seen(model, link, own, tip.link);
  const FormMatrix into_tip = transposed(model.matrix(tip.placement.R));
  right = {into_tip * right.R, model.into(tip.placement, right.p)};
  const FormMatrix into_mount = transposed(model.matrix(robot.mount.R));
  const FormMatrix R = into_mount * model.pose_turn();
  const FormVector p = into_mount * (model.pose_place() - model.constant(robot.mount.p));
  right = {R * right.R, R * right.p + p};
  add_side(model, at.yaw, at.first + k, base_rows(left, robot));
  add_side(model, at.first + k, at.regrasp, opposite(base_rows(right, robot)));
  count_ += static_cast<int>(sides_.back().rows.size());
}

void Equations::add_contact(const Problem& problem, const FormModel& model) {
  const PostureCoordinates& at = model.coordinates();
  const Contact& contact = *problem.contact;
  const auto end_effector = [&](int i) -> const EndEffector& {
    return problem.robot.end_effectors[static_cast<std::size_t>(i)];
  };
  const EndEffector& second = end_effector(contact.end_effector);
  const FormPose touching = seen(model, second.link, constant_pose(model, second.placement), 0);
  const EndEffector& tip = end_effector(problem.end_effector);
  FormPose touched = model.contact_frame();
  FormMatrix columns = transposed(touched.R);
  for (FormVector& column : columns) column = model.into_pose(column, false);
  const FormMatrix R = model.matrix(tip.placement.R);
  touched = {R * transposed(columns),
             R * model.into_pose(touched.p, true) + model.constant(tip.placement.p)};
  touched = seen(model, tip.link, touched, 0);
  add_side(model, 0, at.yaw, contact_rows(touching, contact));
  add_side(model, at.first, at.shares, opposite(contact_rows(touched, contact)));
  count_ += static_cast<int>(sides_.back().rows.size());
}

/// The rows depend only on the variables `from` to `to` - 1, so their terms are those of this
/// stretch.
void Equations::add_side(const FormModel& model, int from, int to, const std::vector<Form>& rows) {
  const FormShape& all = model.shape();
  Side side{std::make_unique<FormShape>(all.stretch(from, to)), repeat_after(all, to), count_, {}};
  for (const Form& row : rows) {
    const long double off = kRoundedData * row.magnitude(model.far());
    const FormRow rounded(row + Form(all, Wide(-off, off)), model.far());
    side.rows.push_back(on_stretch(rounded, all, from, to));
  }
  sides_.push_back(std::move(side));
}

double Equations::residual(const Eigen::VectorXd& x) const {
  std::vector<Narrow> f(static_cast<std::size_t>(count_));
  for (const Side& side : sides_) {
    for (std::size_t i = 0; i < side.rows.size(); ++i) {
      f[static_cast<std::size_t>(side.row) + i] += BoxForms::at_point(*side.shape, side.rows[i], x);
    }
  }
  double most = 0;
  for (const Narrow& row : f) {
    if (!(row.magnitude() < kInfinity)) return kInfinity;
    most = std::max(most, row.magnitude());
  }
  return most;
}

EquationsOverBox::EquationsOverBox(const Equations& equations) : equations_(equations) {
  for (const Equations::Side& side : equations.sides()) boxes_.emplace_back(*side.shape);
}

bool EquationsOverBox::set(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  bool narrow_enough = true;
  for (BoxForms& box : boxes_) narrow_enough = box.set(lower, upper) && narrow_enough;
  return narrow_enough;
}

const std::vector<Narrow>& EquationsOverBox::points(std::size_t side, const double* nu) {
  const Equations::Side& of = equations_.sides()[side];
  points_.assign(static_cast<std::size_t>(of.shape->size), 0.0);
  for (std::size_t i = 0; i < of.rows.size(); ++i) {
    const double factor = nu[static_cast<std::size_t>(of.row) + i];
    if (factor != 0) maxwrench::add_to(points_, of.rows[i], factor);
  }
  boxes_[side].over_box(points_);
  return points_;
}

bool EquationsOverBox::excluded(const double* nu) {
  Narrow least;
  for (std::size_t side = 0; side < boxes_.size(); ++side) {
    double of_side = kInfinity;
    for (const Narrow& x : points(side, nu)) {
      if (!(x.low > -kInfinity)) return false;  // or NaN
      of_side = std::min(of_side, x.low);
    }
    least += Narrow(of_side);
  }
  return least.low > 0;
}

void EquationsOverBox::add_to(std::vector<Narrow>& points, const double* nu) {
  for (std::size_t side = 0; side < boxes_.size(); ++side) {
    const std::vector<Narrow>& own = this->points(side, nu);
    const auto repeat = static_cast<std::size_t>(equations_.sides()[side].repeat);
    for (std::size_t v = 0; v < points.size();) {
      for (const Narrow& x : own) {
        for (std::size_t end = v + repeat; v < end; ++v) points[v] += x;
      }
    }
  }
}

}  // namespace maxwrench
