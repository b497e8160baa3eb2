#include "lib/trajectory/motion_evaluator.h"

#include "lib/robot/chain.h"

namespace maxwrench {
namespace {

/// [m/s, rad/s; m/s^2, rad/s^2 for accelerations] The tolerance relative to 1 + the largest
/// component.
constexpr double kPathMissed = 1e-6;
constexpr const char* kLeavesPath =
    "unreachable motion: the robot cannot move the end effector along the path";

using D4 = Dual<4>;

}  // namespace

bool leaves_path(const RobotMotion<double>& motion, const PathPoint& x, bool smooth) {
  const auto missed = [](double by, const Vector6d& asked) {
    return !(by <= kPathMissed * (1 + asked.lpNorm<Eigen::Infinity>()));
  };
  return missed(motion.twist_missed(), x.twist) ||
         (smooth && missed(motion.acceleration_missed(), x.acceleration));
}

MotionEvaluator::MotionEvaluator(const Problem& problem, SchemeMaps maps)
    : problem_(problem),
      maps_(std::move(maps)),
      tracker_(problem),
      dynamics_(problem.robot),
      dual_motion_(problem),
      dynamics_slopes_(problem.robot),
      place_(problem.redundancy(), maps_.instants()),
      rate_(place_),
      bend_(place_),
      theta_r_(problem.redundancy()),
      rate_r_(theta_r_),
      bend_r_(theta_r_),
      q_(resting_joints(problem.robot)),
      dual_theta_r_(problem.redundancy()),
      dual_rate_(problem.redundancy()),
      dual_bend_(problem.redundancy()),
      dual_v_(problem.robot.velocities()),
      dual_v_dot_(problem.robot.velocities()),
      turn_slopes_(3, 2 * problem.redundancy()),
      q_slopes_(problem.robot.joints.size(), turn_slopes_.cols()),
      v_slopes_(problem.robot.velocities(), turn_slopes_.cols()),
      v_dot_slopes_(v_slopes_),
      f_slopes_(v_slopes_),
      c_slopes_(6, 2 * problem.redundancy()) {
  if (problem.motion && problem.motion->transfer) transferred_ = &*problem.motion->payload;
}

/// Sets theta_r and its derivatives at all instants.
void MotionEvaluator::set_rows(const Eigen::MatrixXd& Q) {
  place_.noalias() = Q.transpose().lazyProduct(maps_.P.transpose());
  rate_.noalias() = Q.transpose().lazyProduct(maps_.V.transpose());
  if (maps_.smooth()) {
    bend_.noalias() = Q.transpose().lazyProduct(maps_.A.transpose());
  } else {
    bend_.setZero();
  }
  if (!maps_.starts) return;
  rate_.col(0).setZero();
  bend_.col(0).setZero();
}

void MotionEvaluator::evaluate(const Eigen::MatrixXd& Q, std::vector<Instant>& instants) {
  set_rows(Q);
  instants.resize(static_cast<std::size_t>(maps_.instants()));
  tracker_.restart();
  lost_ = -1;
  for (Eigen::Index i = 0; i < maps_.instants() && lost_ < 0; ++i) {
    const auto at = static_cast<std::size_t>(i);
    Instant& instant = instants[at];
    theta_r_ = place_.col(i);
    rate_r_ = rate_.col(i);
    bend_r_ = bend_.col(i);
    const char* const reason = tracker_.set(maps_.x[at], theta_r_, rate_r_, bend_r_);
    const RobotMotion<double>& motion = tracker_.motion();
    if (transferred_) read_tool(at);
    instant.t = maps_.t[at];
    instant.end_effector = maps_.x[at].pose;
    instant.base = motion.base();
    instant.q = motion.q();
    instant.v = maps_.moves[i] * motion.v();
    instant.v_dot = maps_.moves[i] * motion.v_dot();
    const bool leaves = maps_.moves[i] != 0 && leaves_path(motion, maps_.x[at], maps_.smooth());
    if (reason || leaves) {
      lose(static_cast<int>(i), reason ? reason : kLeavesPath, instants);
    }
  }
  if (!maps_.smooth() && lost_ < 0) accelerate_by_differences(instants);
  const auto& end_effector =
      problem_.robot.end_effectors[static_cast<std::size_t>(problem_.end_effector)];
  for (Instant& instant : instants) {
    dynamics_.set_configuration(instant.base.R, instant.q);
    dynamics_.inverse(instant.v, instant.v_dot, instant.tau_d);
    dynamics_.kinematics().jacobian(end_effector, instant.base.R, instant.J);
  }
}

/// Sets the end effector's motion at an instant of a transfer.
void MotionEvaluator::read_tool(std::size_t i) {
  const ToolMotion<double> tool = tracker_.motion().tool_motion();
  maps_.x[i] = {tracker_.motion().tool_pose(), tool.twist, tool.acceleration};
}

/// Marks all values from this instant on as unknown, except theta_r.
void MotionEvaluator::lose(int instant, const char* reason, std::vector<Instant>& instants) {
  lost_ = instant;
  lost_reason_ = reason;
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  const int n = problem_.robot.velocities();
  for (int i = instant; i < maps_.instants(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    Instant& unknown = instants[at];
    unknown.t = maps_.t[at];
    unknown.end_effector = maps_.x[at].pose;
    unknown.base.R.setConstant(kUnknown);
    unknown.base.p.setConstant(kUnknown);
    unknown.q.setConstant(q_.size(), kUnknown);
    for (std::size_t k = 0; k < problem_.redundant.size(); ++k) {
      unknown.q[problem_.redundant[k]] = place_(static_cast<Eigen::Index>(k), i);
    }
    unknown.v.setConstant(n, kUnknown);
    unknown.v_dot.setConstant(n, kUnknown);
  }
}

bool MotionEvaluator::visit(
    const Eigen::MatrixXd& Q,
    const std::function<void(int, const Eigen::VectorXd&, const Eigen::MatrixXd&)>& see) {
  visited_.noalias() = Q.transpose().lazyProduct(maps_.P.transpose());
  tracker_.restart();
  const bool follow = !problem_.dependent.empty();
  for (Eigen::Index i = 0; i < maps_.instants(); ++i) {
    theta_r_ = visited_.col(i);
    if (tracker_.place(maps_.x[static_cast<std::size_t>(i)].pose, theta_r_)) return false;
    for (std::size_t k = 0; k < problem_.redundant.size(); ++k) {
      q_[problem_.redundant[k]] = theta_r_[static_cast<Eigen::Index>(k)];
    }
    if (follow) q_ = tracker_.ik_solution().z().tail(q_.size());
    see(static_cast<int>(i), q_, follow ? tracker_.ik_solution().slopes() : no_slopes_);
  }
  return true;
}

/// v_dot = D v.
void MotionEvaluator::accelerate_by_differences(std::vector<Instant>& instants) const {
  for (std::size_t i = 0; i < instants.size(); ++i) {
    instants[i].v_dot.setZero();
    for (std::size_t j = 0; j < instants.size(); ++j) {
      const double share = maps_.D(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      if (share != 0) instants[i].v_dot += share * instants[j].v;
    }
  }
}

void MotionEvaluator::linearize(const std::vector<Instant>& instants,
                                std::vector<MotionSlopes>& slopes) {
  slopes.resize(instants.size());
  const int r = problem_.redundancy();
  const EndEffector& end_effector =
      problem_.robot.end_effectors[static_cast<std::size_t>(problem_.end_effector)];
  for (std::size_t i = 0; i < instants.size(); ++i) {
    const Instant& instant = instants[i];
    for (int first = 0; first < 2 * r; first += 4) {
      follow(instant, static_cast<int>(i), first, std::min(4, 2 * r - first));
    }
    DynamicsSlopes& f = dynamics_slopes_;
    f.set(instant.base.R, instant.q, instant.v, instant.v_dot, end_effector, instant.h);
    f_slopes_.noalias() = f.by_turn().lazyProduct(turn_slopes_);
    f_slopes_.noalias() += f.by_q().lazyProduct(q_slopes_);
    f_slopes_.noalias() += f.by_v().lazyProduct(v_slopes_);
    f_slopes_.noalias() += f.by_v_dot().lazyProduct(v_dot_slopes_);
    MotionSlopes& s = slopes[i];
    s.place = f_slopes_.leftCols(r);
    s.rate = f_slopes_.rightCols(r);
    s.v_place = v_slopes_.leftCols(r);
    s.v_rate = v_slopes_.rightCols(r);
    if (!problem_.dependent.empty()) s.q_place = q_slopes_.leftCols(r);
    s.M = f.by_v_dot();
    if (maps_.smooth()) s.bend.noalias() = s.M.lazyProduct(s.v_rate);
    if (transferred_) add_payload(instant, maps_.x[i], s);
  }
}

/// Adds the derivatives of m J'c by the motion through c. c is affine in the acceleration of the
/// end effector.
void MotionEvaluator::add_payload(const Instant& instant, const PathPoint& x,
                                  MotionSlopes& slopes) {
  const Eigen::Index r = problem_.redundancy();
  mJt_ = instant.factor * instant.J.transpose();
  slopes.place.noalias() += mJt_.lazyProduct(c_slopes_.leftCols(r));
  slopes.rate.noalias() += mJt_.lazyProduct(c_slopes_.rightCols(r));
  ToolMotion<double> tool{x.pose.R, x.twist, x.acceleration};
  const Vector6d c = carried_wrench<double>(problem_.robot, *transferred_, tool);
  for (Eigen::Index k = 0; k < r; ++k) {
    tool.acceleration = x.acceleration;
    tool.acceleration.noalias() += instant.J.lazyProduct(slopes.v_rate.col(k));
    const Vector6d change = carried_wrench<double>(problem_.robot, *transferred_, tool) - c;
    slopes.bend.col(k).noalias() += mJt_.lazyProduct(change);
  }
}

/// The slopes of the motion at instant i along `count` of the 2r directions (theta_r, theta_r_dot),
/// starting with `first`.
void MotionEvaluator::follow(const Instant& instant, int i, int first, int count) {
  const int r = problem_.redundancy();
  for (Eigen::Index j = 0; j < r; ++j) {
    dual_theta_r_[j] = place_(j, i);
    dual_rate_[j] = rate_(j, i);
    dual_bend_[j] = bend_(j, i);
  }
  for (int d = 0; d < count; ++d) {
    const int direction = first + d;
    D4& seeded = direction < r ? dual_theta_r_[direction] : dual_rate_[direction - r];
    seeded.d[static_cast<std::size_t>(d)] = 1;
  }
  const PathPoint& x = maps_.x[static_cast<std::size_t>(i)];
  if (transferred_) {
    dual_motion_.set(dual_theta_r_, dual_rate_, dual_bend_);
    dual_c_ = carried_wrench<D4>(problem_.robot, *transferred_, dual_motion_.tool_motion());
  } else if (problem_.dependent.empty()) {
    dual_motion_.set(x, dual_theta_r_, dual_rate_, dual_bend_);
  } else {
    dual_motion_.set(x, instant.base, instant.q, dual_theta_r_, dual_rate_, dual_bend_);
  }
  dual_v_ = dual_motion_.v();
  dual_v_dot_ = dual_motion_.v_dot();
  const bool moves = maps_.moves[i] != 0;
  for (Eigen::Index row = 0; row < dual_v_.size(); ++row) {
    if (!moves) dual_v_[row] = 0;
    if (moves && maps_.smooth()) continue;
    dual_v_dot_[row] = instant.v_dot[row];  // by differences: own v here, the others later
    if (!maps_.smooth() && maps_.D(i, i) != 0) {
      for (std::size_t d = 0; d < 4; ++d) {
        dual_v_dot_[row].d[d] = maps_.D(i, i) * dual_v_[row].d[d];
      }
    }
  }
  for (int d = 0; d < count; ++d) read_slopes(static_cast<std::size_t>(d), first + d);
}

/// Reads infinitesimal d of the dual numbers into the slopes along `direction`.
void MotionEvaluator::read_slopes(std::size_t d, Eigen::Index direction) {
  const auto slope = [d](const D4& x) { return x.d[d]; };
  q_slopes_.col(direction) = dual_motion_.q().unaryExpr(slope);
  v_slopes_.col(direction) = dual_v_.unaryExpr(slope);
  v_dot_slopes_.col(direction) = dual_v_dot_.unaryExpr(slope);
  if (transferred_) c_slopes_.col(direction) = dual_c_.unaryExpr(slope);
  // The base turns by R'dR = [turn]x.
  const Matrix3<D4>& R = dual_motion_.base().R;
  const auto along = [&](int a, int b) {
    return R(0, a).v * R(0, b).d[d] + R(1, a).v * R(1, b).d[d] + R(2, a).v * R(2, b).d[d];
  };
  turn_slopes_.col(direction) << along(2, 1), along(0, 2), along(1, 0);
}

void MotionEvaluator::pull_back(const std::vector<MotionSlopes>& slopes,
                                const Eigen::MatrixXd& lambda, Eigen::MatrixXd& gradient) const {
  gradient.setZero(maps_.knots(), problem_.redundancy());
  const Eigen::Index count = maps_.instants();
  const auto add = [&](const Eigen::MatrixXd& rows, Eigen::Index i, const Eigen::MatrixXd& part,
                       const auto& seed) {
    gradient += rows.row(i).transpose() * (part.transpose() * seed).transpose();
  };
  for (Eigen::Index i = maps_.starts ? 1 : 0; i < count; ++i) {  // the start is constant
    const MotionSlopes& s = slopes[static_cast<std::size_t>(i)];
    add(maps_.P, i, s.place, lambda.col(i));
    add(maps_.V, i, s.rate, lambda.col(i));
    if (maps_.smooth()) {
      add(maps_.A, i, s.bend, lambda.col(i));
      continue;
    }
    const Eigen::VectorXd momentum = s.M * lambda.col(i);
    for (Eigen::Index j = 0; j < count; ++j) {
      if (j == i || maps_.D(i, j) == 0) continue;
      const MotionSlopes& other = slopes[static_cast<std::size_t>(j)];
      const Eigen::VectorXd seed = maps_.D(i, j) * momentum;
      add(maps_.P, j, other.v_place, seed);
      add(maps_.V, j, other.v_rate, seed);
    }
  }
}

void MotionEvaluator::push_forward(const std::vector<MotionSlopes>& slopes, int instant,
                                   Eigen::MatrixXd& G) const {
  const Eigen::Index r = problem_.redundancy(), i = instant;
  const MotionSlopes& s = slopes[static_cast<std::size_t>(instant)];
  G.setZero(s.place.rows(), maps_.knots() * r);
  if (maps_.starts && instant == 0) return;
  const auto add = [&](const Eigen::MatrixXd& rows, Eigen::Index at, const auto& part) {
    for (Eigen::Index knot = 0; knot < maps_.knots(); ++knot) {
      if (rows(at, knot) != 0) G.middleCols(knot * r, r) += rows(at, knot) * part;
    }
  };
  add(maps_.P, i, s.place);
  add(maps_.V, i, s.rate);
  if (maps_.smooth()) return add(maps_.A, i, s.bend);
  for (Eigen::Index j = 0; j < maps_.instants(); ++j) {
    if (j == i || maps_.D(i, j) == 0) continue;
    const MotionSlopes& other = slopes[static_cast<std::size_t>(j)];
    add(maps_.P, j, Eigen::MatrixXd(maps_.D(i, j) * s.M * other.v_place));
    add(maps_.V, j, Eigen::MatrixXd(maps_.D(i, j) * s.M * other.v_rate));
  }
}

}  // namespace maxwrench
