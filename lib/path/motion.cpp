#include "lib/path/motion.h"

namespace maxwrench {
namespace {

using D4 = Dual<4>;

}  // namespace

MotionEvaluator::MotionEvaluator(const Problem& problem, SchemeMaps maps)
    : problem_(problem),
      maps_(std::move(maps)),
      follower_(problem),
      dynamics_(problem.robot),
      dual_follower_(problem),
      dual_dynamics_(problem.robot),
      place_(problem.redundancy(), maps_.instants()),
      rate_(place_),
      bend_(place_),
      theta_r_(problem.redundancy()),
      rate_r_(theta_r_),
      bend_r_(theta_r_),
      dual_theta_r_(problem.redundancy()),
      dual_rate_(problem.redundancy()),
      dual_bend_(problem.redundancy()),
      dual_v_(problem.robot.velocities()),
      dual_v_dot_(problem.robot.velocities()),
      dual_tau_(problem.robot.velocities()),
      dual_J_(6, problem.robot.velocities()) {}

/// theta_r and its derivatives at all instants.
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
  for (Eigen::Index i = 0; i < maps_.instants(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    Instant& instant = instants[at];
    theta_r_ = place_.col(i);
    rate_r_ = rate_.col(i);
    bend_r_ = bend_.col(i);
    follower_.set(maps_.x[at], theta_r_, rate_r_, bend_r_);
    instant.t = maps_.t[at];
    instant.end_effector = maps_.x[at].pose;
    instant.base = follower_.base();
    instant.q = follower_.q();
    instant.v = maps_.moves[i] * follower_.v();
    instant.v_dot = maps_.moves[i] * follower_.v_dot();
  }
  if (!maps_.smooth()) accelerate_by_differences(instants);
  const auto& end_effector =
      problem_.robot.end_effectors[static_cast<std::size_t>(problem_.end_effector)];
  for (Instant& instant : instants) {
    dynamics_.set_configuration(instant.base.R, instant.q);
    dynamics_.inverse(instant.v, instant.v_dot, instant.tau_d);
    dynamics_.kinematics().jacobian(end_effector, instant.base.R, instant.J);
  }
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

void MotionEvaluator::linearize(const std::vector<Instant>& instants, std::vector<Slopes>& slopes) {
  slopes.resize(instants.size());
  const int n = problem_.robot.velocities(), r = problem_.redundancy();
  for (std::size_t i = 0; i < instants.size(); ++i) {
    Slopes& s = slopes[i];
    for (Eigen::MatrixXd* part : {&s.place, &s.rate, &s.v_place, &s.v_rate}) part->resize(n, r);
    for (int chunk = 0; 4 * chunk < 2 * r; ++chunk) {
      linearize(instants[i], static_cast<int>(i), chunk, s);
    }
    dynamics_.set_configuration(instants[i].base.R, instants[i].q);
    dynamics_.mass_matrix(s.M);
    if (maps_.smooth()) s.bend.noalias() = s.M.lazyProduct(s.v_rate);
  }
}

/// Four of the 2r directions (theta_r, theta_r_dot) at a time.
void MotionEvaluator::linearize(const Instant& instant, int i, int chunk, Slopes& slopes) {
  const int r = problem_.redundancy(), first = 4 * chunk;
  const int count = std::min(4, 2 * r - first);
  follow(instant, i, first, count);
  dual_dynamics_.set_configuration(dual_follower_.base().R, dual_follower_.q());
  dual_dynamics_.inverse(dual_v_, dual_v_dot_, dual_tau_);
  dual_dynamics_.kinematics().jacobian(
      problem_.robot.end_effectors[static_cast<std::size_t>(problem_.end_effector)],
      dual_follower_.base().R, dual_J_);
  for (int d = 0; d < count; ++d) {
    const int direction = first + d;
    const auto at = static_cast<std::size_t>(d);
    const Eigen::Index column = direction < r ? direction : direction - r;
    Eigen::MatrixXd& f = direction < r ? slopes.place : slopes.rate;
    Eigen::MatrixXd& v = direction < r ? slopes.v_place : slopes.v_rate;
    for (Eigen::Index row = 0; row < dual_tau_.size(); ++row) {
      double turned = 0;
      for (Eigen::Index axis = 0; axis < 6; ++axis) {
        turned += dual_J_(axis, row).d[at] * instant.h[axis];
      }
      f(row, column) = dual_tau_[row].d[at] + turned;
      v(row, column) = dual_v_[row].d[at];
    }
  }
}

/// The motion at instant i with its slopes along `count` directions from `first` on.
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
  dual_follower_.set(maps_.x[static_cast<std::size_t>(i)], dual_theta_r_, dual_rate_, dual_bend_);
  dual_v_ = dual_follower_.v();
  dual_v_dot_ = dual_follower_.v_dot();
  const bool moves = maps_.moves[i] != 0;
  for (Eigen::Index row = 0; row < dual_v_.size(); ++row) {
    if (!moves) dual_v_[row] = 0;
    if (moves && maps_.smooth()) continue;
    dual_v_dot_[row] = instant.v_dot[row];  // by differences: of its own v, the others' come later
    if (!maps_.smooth() && maps_.D(i, i) != 0) {
      for (std::size_t d = 0; d < 4; ++d) {
        dual_v_dot_[row].d[d] = maps_.D(i, i) * dual_v_[row].d[d];
      }
    }
  }
}

void MotionEvaluator::pull_back(const std::vector<Slopes>& slopes, const Eigen::MatrixXd& lambda,
                                Eigen::MatrixXd& gradient) const {
  gradient.setZero(maps_.knots(), problem_.redundancy());
  const Eigen::Index count = maps_.instants();
  const auto add = [&](const Eigen::MatrixXd& rows, Eigen::Index i, const Eigen::MatrixXd& part,
                       const auto& seed) {
    gradient += rows.row(i).transpose() * (part.transpose() * seed).transpose();
  };
  for (Eigen::Index i = maps_.starts ? 1 : 0; i < count; ++i) {  // the start rests where it is
    const Slopes& s = slopes[static_cast<std::size_t>(i)];
    add(maps_.P, i, s.place, lambda.col(i));
    add(maps_.V, i, s.rate, lambda.col(i));
    if (maps_.smooth()) {
      add(maps_.A, i, s.bend, lambda.col(i));
      continue;
    }
    const Eigen::VectorXd momentum = s.M * lambda.col(i);
    for (Eigen::Index j = 0; j < count; ++j) {
      if (j == i || maps_.D(i, j) == 0) continue;
      const Slopes& other = slopes[static_cast<std::size_t>(j)];
      const Eigen::VectorXd seed = maps_.D(i, j) * momentum;
      add(maps_.P, j, other.v_place, seed);
      add(maps_.V, j, other.v_rate, seed);
    }
  }
}

void MotionEvaluator::push_forward(const std::vector<Slopes>& slopes, int instant,
                                   Eigen::MatrixXd& G) const {
  const Eigen::Index r = problem_.redundancy(), i = instant;
  const Slopes& s = slopes[static_cast<std::size_t>(instant)];
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
    const Slopes& other = slopes[static_cast<std::size_t>(j)];
    add(maps_.P, j, Eigen::MatrixXd(maps_.D(i, j) * s.M * other.v_place));
    add(maps_.V, j, Eigen::MatrixXd(maps_.D(i, j) * s.M * other.v_rate));
  }
}

}  // namespace maxwrench
