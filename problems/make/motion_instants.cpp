#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "lib/math/dual.h"
#include "lib/math/rotated.h"
#include "lib/robot/chain.h"
#include "lib/robot/dynamics.h"
#include "lib/trajectory/carried.h"
#include "lib/trajectory/robot_motion.h"
#include "maxwrench/motion_table.h"
#include "maxwrench/problem.h"
#include "problems/make/bad_value.h"
#include "problems/make/base_motion.h"
#include "problems/make/coordinate_series.h"
#include "problems/make/motion_task.h"

namespace maxwrench {
namespace {

/// [rad or m] How far a joint that follows from others may be from where they put it: tables are
/// printed with a few digits.
constexpr double kLoopTolerance = 1e-4;
/// [m/s, rad/s; m/s^2, rad/s^2] The part of the path's motion that the robot may miss, relative to
/// 1 + the largest component.
constexpr double kMotionMissed = 1e-6;
const char* const kBasePrefix = "base_";

/// The motion of a table, instant by instant.
class TableMotion {
 public:
  TableMotion(const Problem& problem, const MotionTable& table)
      : problem_(problem),
        robot_(problem.robot),
        table_(table),
        series_(make_series(table)),
        tracker_(problem),
        dynamics_(problem.robot),
        dual_(problem.robot),
        axes_(static_cast<Eigen::Index>(problem.robot.base_axes.size())) {
    column_of_joint_.assign(robot_.joints.size(), -1);
    column_of_base_.assign(kTwistAxes.size(), -1);
    for (std::size_t k = 0; k < table.names.size(); ++k) place_column(static_cast<int>(k));
    choose_mode();
  }

  std::vector<Instant> instants() {
    std::vector<Instant> all(series_.t.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
      at_ = k;
      all[k].t = series_.t[k];
      if (follows_) {
        follow(all[k]);
      } else {
        move(all[k]);
      }
      load(all[k]);
    }
    return all;
  }

 private:
  void place_column(int column) {
    const std::string& name = table_.names[static_cast<std::size_t>(column)];
    int* place = nullptr;
    const int joint = find_joint(robot_, name);
    if (joint >= 0) {
      place = &column_of_joint_[static_cast<std::size_t>(joint)];
    } else if (axes_ > 0 && name.starts_with(kBasePrefix)) {
      for (std::size_t axis = 0; axis < kTwistAxes.size(); ++axis) {
        if (name == std::string(kBasePrefix) + kTwistAxes[axis]) place = &column_of_base_[axis];
      }
    }
    if (place == nullptr) throw BadValue("columns", name, fmt::format("one of {}", known_names()));
    if (*place >= 0) throw BadValue("columns", name + " twice", "each coordinate once");
    *place = column;
  }

  std::string known_names() const {
    std::vector<std::string> names;
    for (const Joint& joint : robot_.joints) names.push_back(joint.name);
    if (axes_ > 0) {
      for (const char* axis : kTwistAxes) names.push_back(kBasePrefix + std::string(axis));
    }
    return fmt::format("{}", fmt::join(names, ", "));
  }

  bool has(int joint) const { return column_of_joint_[static_cast<std::size_t>(joint)] >= 0; }

  /// The joint of the chain that the table lacks although nothing moves it; -1: none.
  int missing(const std::vector<int>& joints) const {
    for (const int joint : joints) {
      const bool geared = robot_.joints[static_cast<std::size_t>(joint)].gear.has_value();
      if (!has(joint) && !geared) return joint;
    }
    return -1;
  }

  [[noreturn]] void throw_missing(const std::string& name, const char* why) const {
    throw BadValue("columns", "no " + name, fmt::format("a column {}, {}", name, why));
  }

  /// Whether the table moves the base, or the base follows from the end effector.
  void choose_mode() {
    const bool base = std::any_of(column_of_base_.begin(), column_of_base_.end(),
                                  [](int column) { return column >= 0; });
    const int lacks = missing(chain_to(robot_, problem_.end_effector));
    const bool all_theta_r = missing(problem_.redundant) < 0;
    if (base && robot_.base_axes.size() == kTwistAxes.size()) {
      for (std::size_t axis = 0; axis < kTwistAxes.size(); ++axis) {
        if (column_of_base_[axis] >= 0) continue;
        throw_missing(kBasePrefix + std::string(kTwistAxes[axis]), "as the base moves freely");
      }
    }
    follows_ = !base && (axes_ > 0 || (lacks >= 0 && all_theta_r && !problem_.dependent.empty()));
    if (!follows_) {
      if (lacks < 0) return;
      throw_missing(robot_.joints[static_cast<std::size_t>(lacks)].name,
                    "a joint between base and end effector");
    }
    require_followable();
  }

  /// Rejects what has no motion that follows from theta_r and the end effector.
  void require_followable() const {
    if (problem_.free.count() > 0) {
      throw BadValue("pose.free", fmt::format("{} coordinates", problem_.free.count()),
                     "a task with a fixed pose, or the columns base_x .. base_yaw");
    }
    for (const int joint : problem_.redundant) {
      if (has(joint)) continue;
      throw_missing(robot_.joints[static_cast<std::size_t>(joint)].name,
                    "a joint of theta_r, from which the base follows");
    }
    const std::vector<int> chain = chain_to(robot_, problem_.end_effector);
    for (std::size_t joint = 0; joint < robot_.joints.size(); ++joint) {
      if (!has(static_cast<int>(joint))) continue;
      if (std::find(chain.begin(), chain.end(), static_cast<int>(joint)) != chain.end()) continue;
      throw BadValue("columns", robot_.joints[joint].name,
                     "joints between base and end effector, or the columns base_x .. base_yaw");
    }
    for (const int joint : chain) {
      if (!robot_.joints[static_cast<std::size_t>(joint)].gear) continue;
      throw BadValue("robot", robot_.joints[static_cast<std::size_t>(joint)].name + ", a gear",
                     "the columns base_x .. base_yaw for a robot with gears");
    }
    if (!problem_.motion) return;
    const double T = problem_.motion->T, slack = 1e-9 * (1 + T);
    for (const std::size_t row : {std::size_t(0), table_.t.size() - 1}) {
      if (table_.t[row] >= -slack && table_.t[row] <= T + slack) continue;
      throw BadValue(row_name(table_, row), fmt::format("t = {:g}", table_.t[row]),
                     fmt::format("a time of the path, from 0 to {:g}", T));
    }
  }

  /// The row of the table at or before the instant, for messages.
  std::string here() const {
    return row_name(table_, at_ / static_cast<std::size_t>(series_.per_row));
  }

  /// A column at the instant.
  double number(const Eigen::MatrixXd& columns, int column) const {
    return columns(static_cast<Eigen::Index>(at_), column);
  }

  /// Rejects a joint of the table that is not at q.
  void require_at(int joint, double q) const {
    if (!has(joint)) return;
    const double given = number(series_.values, column_of_joint_[static_cast<std::size_t>(joint)]);
    if (std::abs(given - q) <= kLoopTolerance) return;
    throw BadValue(
        here(),
        fmt::format("{} = {:.6g}", robot_.joints[static_cast<std::size_t>(joint)].name, given),
        fmt::format("{:.6g} to within {:g}, where the other coordinates put it", q,
                    kLoopTolerance));
  }

  /// The table moves the robot.
  void move(Instant& instant) {
    const auto joints = static_cast<Eigen::Index>(robot_.joints.size());
    instant.q = resting_joints(robot_);
    Eigen::VectorXd rate = Eigen::VectorXd::Zero(joints), bend = rate;
    for (Eigen::Index joint = 0; joint < joints; ++joint) {
      const int column = column_of_joint_[static_cast<std::size_t>(joint)];
      if (column < 0) continue;
      instant.q[joint] = number(series_.values, column);
      rate[joint] = number(series_.rates, column);
      bend[joint] = number(series_.accelerations, column);
    }
    // A joint with a gear may come before the one that leads it.
    for (Eigen::Index joint = 0; joint < joints; ++joint) {
      const std::optional<Gear>& gear = robot_.joints[static_cast<std::size_t>(joint)].gear;
      if (!gear) continue;
      instant.q[joint] = gear->ratio * instant.q[gear->leader] + gear->offset;
      rate[joint] = gear->ratio * rate[gear->leader];
      bend[joint] = gear->ratio * bend[gear->leader];
      require_at(static_cast<int>(joint), instant.q[joint]);
    }
    Vector6d x, x_dot = Vector6d::Zero(), x_ddot = x_dot;
    x << robot_.mount.p, roll_pitch_yaw(robot_.mount.R);
    bool given = false;
    for (Eigen::Index axis = 0; axis < 6; ++axis) {
      const int column = column_of_base_[static_cast<std::size_t>(axis)];
      if (column < 0) continue;
      given = true;
      x[axis] = number(series_.values, column);
      x_dot[axis] = number(series_.rates, column);
      x_ddot[axis] = number(series_.accelerations, column);
    }
    if (std::abs(x[4]) > kSteepest && given) {
      throw BadValue(here(), fmt::format("base_pitch = {:.6g}", x[4]),
                     fmt::format("a pitch from {:g} to {:g}", -kSteepest, kSteepest));
    }
    BaseMotion base = base_motion(x, x_dot, x_ddot);
    if (!given) base.pose = robot_.mount;
    require_reach(base.pose);
    instant.base = base.pose;
    instant.v.resize(robot_.velocities());
    instant.v_dot.resize(robot_.velocities());
    for (Eigen::Index i = 0; i < axes_; ++i) {
      const int axis = robot_.base_axes[static_cast<std::size_t>(i)];
      instant.v[i] = base.twist[axis];
      instant.v_dot[i] = base.acceleration[axis];
    }
    instant.v.tail(joints) = rate;
    instant.v_dot.tail(joints) = bend;
  }

  void require_reach(const Pose<double>& base) const {
    if (base_reaches(robot_, base)) return;
    std::vector<std::string> axes;
    for (const int axis : robot_.base_axes) {
      axes.emplace_back(kTwistAxes[static_cast<std::size_t>(axis)]);
    }
    throw BadValue(
        here(),
        fmt::format("the base at {:.6g}, {:.6g}, {:.6g}", base.p.x(), base.p.y(), base.p.z()),
        fmt::format("a place that it reaches from its mount along {}", fmt::join(axes, ", ")));
  }

  /// The base and the dependent joints follow from theta_r and the end effector.
  void follow(Instant& instant) {
    PathPoint x{problem_.pose};
    if (problem_.motion) x = problem_.motion->path.at(instant.t);
    const auto r = static_cast<Eigen::Index>(problem_.redundant.size());
    Eigen::VectorXd theta_r(r), rate(r), bend(r);
    for (Eigen::Index i = 0; i < r; ++i) {
      const int column = column_of_joint_[static_cast<std::size_t>(
          problem_.redundant[static_cast<std::size_t>(i)])];
      theta_r[i] = number(series_.values, column);
      rate[i] = number(series_.rates, column);
      bend[i] = number(series_.accelerations, column);
    }
    const char* const reason = tracker_.set(x, theta_r, rate, bend);
    const RobotMotion<double>& motion = tracker_.motion();
    const auto missed = [](double by, const Vector6d& asked) {
      return !(by <= kMotionMissed * (1 + asked.lpNorm<Eigen::Infinity>()));
    };
    if (reason || missed(motion.twist_missed(), x.twist) ||
        missed(motion.acceleration_missed(), x.acceleration)) {
      throw BadValue(here(), reason ? reason : "a motion that leaves the path",
                     "joints with which the end effector keeps its pose");
    }
    require_reach(motion.base());
    for (const int joint : problem_.dependent) require_at(joint, motion.q()[joint]);
    instant.base = motion.base();
    instant.q = motion.q();
    instant.v = motion.v();
    instant.v_dot = motion.v_dot();
  }

  /// tau_d, J, the pose of the end effector and c.
  void load(Instant& instant) {
    const auto tool = static_cast<std::size_t>(problem_.end_effector);
    dynamics_.set_configuration(instant.base.R, instant.q);
    dynamics_.inverse(instant.v, instant.v_dot, instant.tau_d);
    const Kinematics<double>& kinematics = dynamics_.kinematics();
    kinematics.jacobian(robot_.end_effectors[tool], instant.base.R, instant.J);
    instant.end_effector = instant.base * kinematics.end_effector(robot_.end_effectors[tool]);
    const bool turns = problem_.motion ? problem_.motion->c_turns : problem_.wrench_in_end_effector;
    if (problem_.motion && problem_.motion->has_factor()) {
      instant.c = factored_wrench(robot_, *problem_.motion, instant.t, tool_point(instant));
    } else {
      const Eigen::Matrix3d turn = instant.end_effector.R * problem_.pose.R.transpose();
      instant.c = turns ? rotated(turn, problem_.c) : problem_.c;
    }
    require_finite(instant);
  }

  /// Rejects forces that are not finite, which too large numbers have.
  void require_finite(const Instant& instant) const {
    if (instant.tau_d.allFinite() && instant.J.allFinite() && instant.c.allFinite() &&
        instant.end_effector.R.allFinite() && instant.end_effector.p.allFinite()) {
      return;
    }
    throw BadValue(here(), "forces that are not finite",
                   "coordinates and rates that are not too large");
  }

  /// The end effector's motion: x_dot = J v and x_ddot = J v_dot + J_dot v, with J_dot by dual
  /// numbers along the motion.
  PathPoint tool_point(const Instant& instant) {
    using Scalar = Dual<4>;
    VectorX<Scalar> q = instant.q.cast<Scalar>();
    for (Eigen::Index i = 0; i < q.size(); ++i) q[i].d[0] = instant.v[axes_ + i];
    Vector6d base = Vector6d::Zero();
    for (Eigen::Index i = 0; i < axes_; ++i) {
      base[robot_.base_axes[static_cast<std::size_t>(i)]] = instant.v[i];
    }
    const Eigen::Matrix3d R_dot = instant.base.R * skew(Eigen::Vector3d(base.tail<3>()));
    Matrix3<Scalar> R = instant.base.R.cast<Scalar>();
    for (Eigen::Index i = 0; i < R.size(); ++i) R(i).d[0] = R_dot(i);
    dual_.set_joints(q);
    Matrix6X<Scalar> J;
    dual_.jacobian(robot_.end_effectors[static_cast<std::size_t>(problem_.end_effector)], R, J);
    PathPoint x{instant.end_effector};
    x.twist = instant.J * instant.v;
    x.acceleration = instant.J * instant.v_dot;
    for (Eigen::Index i = 0; i < J.cols(); ++i) {
      for (Eigen::Index k = 0; k < 6; ++k) x.acceleration[k] += J(k, i).d[0] * instant.v[i];
    }
    return x;
  }

  const Problem& problem_;
  const Robot& robot_;
  const MotionTable& table_;
  CoordinateSeries series_;
  RobotMotionTracker tracker_;
  Dynamics dynamics_;
  Kinematics<Dual<4>> dual_;
  Eigen::Index axes_;
  std::vector<int> column_of_joint_, column_of_base_;
  bool follows_ = false;
  std::size_t at_ = 0;  ///< the instant
};

}  // namespace

std::vector<Instant> motion_instants(const Problem& problem, const MotionTable& table) {
  require_dynamics(problem.robot);
  if (problem.contact) {
    throw BadValue("contact", "a second contact", "a task with one contact");
  }
  return TableMotion(problem, table).instants();
}

}  // namespace maxwrench
