#include "verify/trajectory/trajectory_model.h"

#include <Eigen/Geometry>
#include <stdexcept>

#include "verify/coordinates.h"

namespace maxwrench {
namespace {

Eigen::MatrixXd all_rows(const MotionTask& task, const Eigen::MatrixXd& table) {
  if (!task.impulse) return table;
  Eigen::MatrixXd all(table.rows() + 1, table.cols());
  all << task.theta_0.transpose(), table;
  return all;
}

template <int N>
JetMatrix<N> rotation(const Eigen::Vector3d& axis, const Jet<N>& angle) {
  const auto [c, s] = cos_sin(angle);
  const JetMatrix<N> S = constant_jets<N>(Eigen::Matrix3d(skew(axis)));
  const JetMatrix<N> SS = S * S;
  const Jet<N> v = Jet<N>(1.0) - c;
  JetMatrix<N> R = constant_jets<N>(Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) R[i][j] = R[i][j] + s * S[i][j] + v * SS[i][j];
  }
  return R;
}

/// phi of a `Timing` at s.
template <int N>
Jet<N> progress_of(Timing timing, const Jet<N>& s) {
  switch (timing) {
    case Timing::kCubic:
      return s * s * (Jet<N>(3.0) - Narrow(2.0) * s);
    case Timing::kQuintic:
      return s * s * s * (Jet<N>(10.0) + s * (Narrow(6.0) * s - Jet<N>(15.0)));
    case Timing::kLinear:
      break;
  }
  return s;
}

}  // namespace

TrajectoryModel::TrajectoryModel(const Problem& problem, const Eigen::MatrixXd& table,
                                 const Eigen::MatrixXd& dependent)
    : problem_(problem),
      path_(problem.motion->path.as_screw().value()),
      curve_(all_rows(*problem.motion, table), problem.motion->T),
      coordinate_of_(problem.robot.joints.size(), -1),
      dependent_of_(problem.robot.joints.size(), -1) {
  for (std::size_t k = 0; k < problem.redundant.size(); ++k) {
    coordinate_of_[static_cast<std::size_t>(problem.redundant[k])] = static_cast<int>(k);
  }
  for (std::size_t i = 0; i < problem.robot.joints.size(); ++i) {
    rest_.push_back(rest_of(problem, i));
  }
  int link = problem.robot.end_effectors[static_cast<std::size_t>(problem.end_effector)].link;
  for (; link != 0; link = problem.robot.joints[static_cast<std::size_t>(link - 1)].parent) {
    inward_.push_back(link);
  }
  for (std::size_t k = 0; k < problem.dependent.size(); ++k) {
    dependent_of_[static_cast<std::size_t>(problem.dependent[k])] = static_cast<int>(k);
  }
  if (!problem.dependent.empty()) make_tube(dependent);
}

template <int N>
std::vector<Jet<N>> TrajectoryModel::joints_of_theta_r(int interval, const Narrow& x) const {
  std::vector<Jet<N>> q;
  for (std::size_t i = 0; i < rest_.size(); ++i) {
    const int coordinate = coordinate_of_[i];
    q.push_back(coordinate < 0 ? Jet<N>(rest_[i]) : curve_.at<N>(coordinate, interval, x));
  }
  return q;
}

template <int N>
std::optional<std::vector<Jet<N>>> TrajectoryModel::joints(int interval, const Narrow& x) const {
  std::vector<Jet<N>> q = joints_of_theta_r<N>(interval, x);
  if (problem_.dependent.empty()) return q;
  const std::optional<std::vector<Jet<N>>> dependent = dependent_jets<N>(interval, x);
  if (!dependent) return std::nullopt;
  for (std::size_t k = 0; k < dependent->size(); ++k) {
    q[static_cast<std::size_t>(problem_.dependent[k])] = (*dependent)[k];
  }
  return q;
}

NarrowBox TrajectoryModel::positions(int interval, const Narrow& x) const {
  NarrowBox q;
  for (const Jet<3>& jet : joints_of_theta_r<3>(interval, x)) q.push_back(jet.c[0]);
  if (problem_.dependent.empty()) return q;
  const NarrowBox dependent = dependent_box(interval, x, place_at(interval, x));
  for (std::size_t k = 0; k < dependent.size(); ++k) {
    q[static_cast<std::size_t>(problem_.dependent[k])] = dependent[k];
  }
  return q;
}

std::vector<double> TrajectoryModel::moved_from_middle(int interval, double x_0, double x_1) const {
  std::vector<double> moved(rest_.size(), 0);
  const NarrowBox here = positions(interval, Narrow((x_0 + x_1) / 2));
  const auto dependent =
      problem_.dependent.empty() ? std::vector<Jet<3>>() : dependent_jets<3>(interval, {x_0, x_1});
  const Narrow half = (((x_1 - x_0) / 2) * Narrow(1.0)) / curve_.rate();
  for (std::size_t i = 0; i < moved.size(); ++i) {
    if (!moves(i)) continue;
    double speed = kInfinity;
    if (coordinate_of_[i] >= 0) {
      speed = curve_.fastest(coordinate_of_[i], interval, x_0, x_1);
    } else if (dependent) {
      speed = (*dependent)[static_cast<std::size_t>(dependent_of_[i])].c[1].magnitude();
    }
    const Narrow width = Narrow(here[i].high) - Narrow(here[i].low);
    moved[i] = speed < kInfinity ? (Narrow(speed) * half + width).high : kInfinity;
  }
  return moved;
}

/// The pose of a link in its parent's axes.
template <int N>
auto TrajectoryModel::joint_frame(std::size_t joint, const Jet<N>& q) const -> Frame<N> {
  const Joint& at = problem_.robot.joints[joint];
  Frame<N> frame{constant_jets<N>(at.placement.R), constant_jets<N>(at.placement.p)};
  if (at.type == JointType::kRevolute) {
    frame.R = frame.R * rotation(at.axis, q);
  } else {
    frame.p = frame.p + frame.R * (q * constant_jets<N>(at.axis));
  }
  return frame;
}

/// The end effector, from its origin at the start: with the rotation E about the axis through the
/// centre z, p - p_0 = (E - 1)(p_0 - z) + phi displacement.
template <int N>
void TrajectoryModel::move_tool(int interval, const Narrow& x, Motion<N>& motion) const {
  const bool rests = problem_.motion->impulse;
  const Vector6d& c = problem_.c;
  motion.c_force = constant_jets<N>(Eigen::Vector3d(c.head<3>()));
  motion.c_torque = constant_jets<N>(Eigen::Vector3d(c.tail<3>()));
  motion.tool = {constant_jets<N>(path_.start.R), constant_jets<N>(Eigen::Vector3d(0, 0, 0))};
  if (rests) return;
  Jet<N> s;
  s.c[0] =
      (Narrow(static_cast<double>(interval)) + x) / Narrow(static_cast<double>(curve_.intervals()));
  s.c[1] = Narrow(1.0) / Narrow(problem_.motion->T);
  const Jet<N> phi = progress_of(path_.timing, s);
  if (path_.angle != 0) {
    const JetMatrix<N> E = rotation(path_.axis, Narrow(path_.angle) * phi);
    const JetVector<N> arm = constant_jets<N>(path_.start.p) - constant_jets<N>(path_.centre);
    motion.tool.p = E * arm - arm;
    motion.tool.R = E * motion.tool.R;
    if (problem_.motion->c_turns) {
      motion.c_force = E * motion.c_force;
      motion.c_torque = E * motion.c_torque;
    }
  }
  motion.tool.p = motion.tool.p + phi * constant_jets<N>(path_.displacement);
}

/// The link of the end effector.
template <int N>
auto TrajectoryModel::tool_link(const Frame<N>& tool) const -> Frame<N> {
  const EndEffector& tip =
      problem_.robot.end_effectors[static_cast<std::size_t>(problem_.end_effector)];
  return outer(tool, {constant_jets<N>(tip.placement.R), constant_jets<N>(tip.placement.p)});
}

template <int N>
auto TrajectoryModel::base_of(const Frame<N>& tool, const std::vector<Jet<N>>& q) const
    -> Frame<N> {
  Frame<N> link = tool_link(tool);
  for (const int moved : inward_) {
    const auto joint = static_cast<std::size_t>(moved - 1);
    link = outer(link, joint_frame(joint, q[joint]));
  }
  return link;
}

template <int N>
auto TrajectoryModel::move(int interval, const Narrow& x) const -> std::optional<Motion<N>> {
  const Robot& robot = problem_.robot;
  Motion<N> motion;
  move_tool(interval, x, motion);
  const std::optional<std::vector<Jet<N>>> q = this->joints<N>(interval, x);
  if (!q) return std::nullopt;
  std::vector<Frame<N>> joints;
  for (std::size_t i = 0; i < q->size(); ++i) joints.push_back(joint_frame(i, (*q)[i]));
  motion.links.resize(robot.links.size());
  std::vector<char> placed(robot.links.size(), 0);
  motion.links[static_cast<std::size_t>(inward_.empty() ? 0 : inward_.front())] =
      tool_link(motion.tool);
  placed[0] = 1;
  for (const int moved : inward_) {
    const auto from = static_cast<std::size_t>(moved);
    const auto link = static_cast<std::size_t>(robot.joints[from - 1].parent);
    motion.links[link] = outer(motion.links[from], joints[from - 1]);
    placed[from] = 1;
  }
  for (std::size_t i = 1; i < robot.links.size(); ++i) {
    if (placed[i]) continue;
    const Frame<N>& parent = motion.links[static_cast<std::size_t>(robot.joints[i - 1].parent)];
    motion.links[i] = {parent.R * joints[i - 1].R, parent.p + parent.R * joints[i - 1].p};
  }
  return motion;
}

template <int N>
auto TrajectoryModel::from_mount(const Frame<N>& base) const -> Frame<N> {
  const Pose<double>& mount = problem_.robot.mount;
  const JetMatrix<N> into = transposed(constant_jets<N>(mount.R));
  return {into * base.R,
          into * (base.p + (constant_jets<N>(path_.start.p) - constant_jets<N>(mount.p)))};
}

/// The components of the base's pose, seen from its mount, that no free axis changes. Where joints
/// depend on them they vanish.
template <int N>
std::vector<Jet<N>> TrajectoryModel::off_axes(const Frame<N>& base) const {
  const Robot& robot = problem_.robot;
  if (robot.base_axes.size() == 6 || !problem_.dependent.empty()) return {};
  const auto [R, p] = from_mount(base);
  std::vector<Jet<N>> off;
  for (int axis = 0; axis < 3; ++axis) {
    if (!is_free(robot, axis)) off.push_back(p[static_cast<std::size_t>(axis)]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (i != j && !(is_free(robot, 5) && i < 2 && j < 2)) off.push_back(R[i][j]);
    }
    // A half turn has the same entries off the diagonal.
    if (i == 2 || !is_free(robot, 5)) off.push_back(R[i][i] - Jet<N>(1.0));
  }
  return off;
}

template <int N>
std::optional<MotionLoads<N - 2>> TrajectoryModel::loads(int interval, const Narrow& x) const {
  const std::optional<Motion<N>> moving = move<N>(interval, x);
  if (!moving) return std::nullopt;
  const Motion<N>& motion = *moving;
  std::vector<Frame<N - 2>> links;
  std::vector<Wrenches<N - 2>> forces;
  for (std::size_t i = 0; i < motion.links.size(); ++i) {
    const Frame<N>& at = motion.links[i];
    links.push_back({shortened<N - 2>(at.R), shortened<N - 2>(at.p)});
    forces.push_back(force_on(i, at));
  }
  MotionLoads<N - 2> loads;
  loads.tau_d = project(forces, links);
  std::vector<Wrenches<N - 2>> exerted(forces.size());
  const EndEffector& tip =
      problem_.robot.end_effectors[static_cast<std::size_t>(problem_.end_effector)];
  Wrenches<N - 2>& h = exerted[static_cast<std::size_t>(tip.link)];
  h.force = shortened<N - 2>(motion.c_force);
  h.torque = shortened<N - 2>(motion.c_torque) + cross(shortened<N - 2>(motion.tool.p), h.force);
  loads.along_c = project(exerted, links);
  loads.off_axes = off_axes(links[0]);
  return loads;
}

template std::optional<MotionLoads<1>> TrajectoryModel::loads<3>(int, const Narrow&) const;
template std::optional<MotionLoads<2>> TrajectoryModel::loads<4>(int, const Narrow&) const;

// For the dependent joints.
template auto TrajectoryModel::base_of(const Frame<1>&, const std::vector<Jet<1>>&) const
    -> Frame<1>;
template auto TrajectoryModel::base_of(const Frame<3>&, const std::vector<Jet<3>>&) const
    -> Frame<3>;
template auto TrajectoryModel::base_of(const Frame<4>&, const std::vector<Jet<4>>&) const
    -> Frame<4>;
template auto TrajectoryModel::from_mount(const Frame<1>&) const -> Frame<1>;
template auto TrajectoryModel::from_mount(const Frame<3>&) const -> Frame<3>;
template auto TrajectoryModel::from_mount(const Frame<4>&) const -> Frame<4>;
template void TrajectoryModel::move_tool(int, const Narrow&, Motion<3>&) const;
template void TrajectoryModel::move_tool(int, const Narrow&, Motion<4>&) const;
template std::vector<Jet<3>> TrajectoryModel::joints_of_theta_r(int, const Narrow&) const;
template std::vector<Jet<4>> TrajectoryModel::joints_of_theta_r(int, const Narrow&) const;

std::vector<Pose<double>> TrajectoryModel::links(int interval, double x) const {
  const Robot& robot = problem_.robot;
  const NarrowBox all = positions(interval, Narrow(x));
  std::vector<Pose<double>> links(1);
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const Joint& joint = robot.joints[i];
    const double q = moves(i) ? middle_of(all[i]) : rest_[i];
    Pose<double> motion;
    if (joint.type == JointType::kRevolute) {
      motion.R = Eigen::AngleAxisd(q, joint.axis).toRotationMatrix();
    } else {
      motion.p = joint.axis * q;
    }
    links.push_back(links[static_cast<std::size_t>(joint.parent)] * joint.placement * motion);
  }
  return links;
}

}  // namespace maxwrench
