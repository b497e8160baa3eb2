#include "solvers/certify/bound/any_rows.h"

#include <Eigen/Dense>
#include <algorithm>
#include <stdexcept>

#include "lib/math/decompositions.h"
#include "solvers/certify/bound/bounds.h"
#include "solvers/certify/bound/exact_posture.h"

namespace maxwrench {
namespace {

MultiAffine any_rows(const Problem& problem, const Matrix6Xd& W, const Matrix6Xd& C, Eigen::Index b,
                     Eigen::Index j) {
  ExactPosture posture(problem);
  const MatrixX<Extended> C_w = W.cast<Extended>().transpose() * C.cast<Extended>();
  return {
      all_coordinates(problem), problem.theta_r_default, [&](const ExtendedVector& theta_r) {
        posture.set(theta_r);
        const MatrixX<Extended> JtW = posture.J().transpose() * posture.turned(W);
        const Eigen::FullPivLU<MatrixX<Extended>> lu(MatrixX<Extended>(JtW.topRows(b).transpose()));
        const MatrixX<Extended> y = lu.solve(C_w);
        const MatrixX<Extended> K =
            MatrixX<Extended>(lu.solve(JtW.bottomRows(j).transpose())).transpose();
        const ExtendedVector tau_b = posture.tau_d().head(b);
        ExtendedVector rows(C.cols() + j + b * C.cols() + j * b);
        rows << -y.transpose() * tau_b, posture.tau_d().tail(j) - K * tau_b, y.reshaped(),
            K.reshaped();
        return rows;
      }};
}

/// Whether the rows agree with the model at other postures, too.
bool reproduces(const Problem& problem, const Matrix6Xd& W, const MultiAffine& f, Eigen::Index b,
                Eigen::Index j) {
  if (j == 0) return true;
  Eigen::VectorXd theta_r = problem.theta_r_default;
  ExactPosture posture(problem);
  for (int sample = 0; sample < 16; ++sample) {
    for (Eigen::Index i = 0; i < theta_r.size(); ++i) {
      theta_r[i] += 0.37 + 0.19 * static_cast<double>(i);
    }
    posture.set(theta_r.cast<Extended>());
    const Eigen::MatrixXd JtW = (posture.J().transpose() * posture.turned(W)).cast<double>();
    const Eigen::VectorXd rows = f.evaluate(theta_r);
    const Eigen::MatrixXd K = rows.tail(j * b).reshaped(j, b);
    const double off = (K * JtW.topRows(b) - JtW.bottomRows(j)).cwiseAbs().maxCoeff();
    if (!(off < 1e-10 * (1 + JtW.cwiseAbs().maxCoeff()))) return false;
  }
  return true;
}

}  // namespace

AnyModel make_any_model(const Problem& problem, const Matrix6Xd& C) {
  const Robot& robot = problem.robot;
  const auto b = static_cast<Eigen::Index>(robot.base_axes.size());
  const auto j = static_cast<Eigen::Index>(robot.joints.size());
  const auto thrusters = static_cast<Eigen::Index>(robot.thrusters.size());
  const auto reject = [&] {
    throw std::invalid_argument(problem.name +
                                ": wrench: got 'any', expected pure for a proof: any needs a base "
                                "whose free axes are as many as the wrenches");
  };
  Matrix6Xd X(6, 0);
  if (problem.W_any.cols() < b && b == 6) X = split(problem.W_any).complement;
  Matrix6Xd W(6, problem.W_any.cols() + X.cols()), all(6, C.cols() + X.cols());
  W << problem.W_any, X;
  all << C, X;
  if (W.cols() != b) reject();
  require_few_control_points(problem.name, all_coordinates(problem));
  MultiAffine f = any_rows(problem, W, all, b, j);
  if (!f.coefficients().allFinite() || !reproduces(problem, W, f, b, j)) reject();
  const Eigen::VectorXd sizes = f.magnitudes(problem.theta_r_min.array() - kCeilingMargin,
                                             problem.theta_r_max.array() + kCeilingMargin);
  const Zonotope& set = robot.actuation;
  return {std::move(f),
          sizes,
          set.B.topLeftCorner(b, thrusters),
          set.u_min.head(thrusters),
          set.u_max.head(thrusters),
          set.u_min.tail(j),
          set.u_max.tail(j),
          b,
          j,
          C.cols(),
          X.cols()};
}

Eigen::MatrixXd rows_along(const Eigen::MatrixXd& Q, const AnyModel& model,
                           const Eigen::VectorXd& d, const Eigen::MatrixXd& N) {
  const Eigen::Index j = model.j, b = model.b, all = model.aims + model.held;
  const Eigen::Index more = N.cols() + model.held, joints = j + more;
  // The columns of D are d, then those along which the wrench is zero. Their multipliers turn d.
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(all, 1 + more);
  D.col(0).head(model.aims) = d;
  D.block(0, 1, model.aims, N.cols()) = -N;
  D.bottomRightCorner(model.held, model.held).setIdentity();
  Eigen::MatrixXd P(Q.rows(), 1 + joints + b + joints * b);
  P.col(0) = Q.leftCols(all) * D.col(0);
  P.middleCols(1, j) = Q.middleCols(all, j);
  P.middleCols(1 + j, more) = Q.leftCols(all) * D.rightCols(more);
  for (Eigen::Index axis = 0; axis < b; ++axis) {
    // y_i'e_axis of all i.
    Eigen::MatrixXd y(Q.rows(), all);
    for (Eigen::Index i = 0; i < all; ++i) y.col(i) = Q.col(all + j + i * b + axis);
    P.col(1 + joints + axis) = y * D.col(0);
    const Eigen::Index K = 1 + joints + b + axis * joints;
    P.middleCols(K, j) = Q.middleCols(all + j + all * b + axis * j, j);
    P.middleCols(K + j, more) = y * D.rightCols(more);
  }
  return P;
}

Eigen::VectorXd with_zeros(const Eigen::VectorXd& limits, Eigen::Index count) {
  Eigen::VectorXd longer = Eigen::VectorXd::Zero(limits.size() + count);
  longer.head(limits.size()) = limits;
  return longer;
}

AnyRows::AnyRows(const AnyModel& model, const Eigen::VectorXd& sizes, const Eigen::VectorXd& j_min,
                 const Eigen::VectorXd& j_max)
    : j_(j_min.size()),
      b_(model.b),
      B_b_(model.B_b),
      u_min_(model.u_min),
      u_max_(model.u_max),
      j_min_(j_min),
      j_max_(j_max),
      program_(Eigen::MatrixXd::Identity(j_, j_), j_min, j_max,
               model.f.size() + kMostRounds * static_cast<Eigen::Index>(kMostAdded)),
      P_(model.f.size(), sizes.size()),
      d_(model.f.size(), B_b_.cols()),
      u_(B_b_.cols()) {
  const Eigen::VectorXd force = B_b_.cwiseAbs() * u_min_.cwiseAbs().cwiseMax(u_max_.cwiseAbs());
  fixed_ = sizes[0] + sizes.segment(1 + j_, b_).dot(force);
  by_mu_ = sizes.segment(1, j_) + sizes.tail(j_ * b_).reshaped(j_, b_) * force +
           j_min.cwiseAbs().cwiseMax(j_max.cwiseAbs());
}

double AnyRows::ceiling() const { return fixed_ * (1 + kCeilingRounding); }

void AnyRows::bound(double low, BoxProof& proof) {
  mu_ = proof.multiplier;
  if (mu_.size() != j_) mu_.setZero(j_);
  points_ = 0;
  double least = -kInfinity;
  for (int round = 0;; ++round) {
    proof.improve(value(), mu_);
    if (proof.high <= low || round == kMostRounds) return;
    if (proof.high - least <= kClose * (proof.high - low)) return;
    add_points(least, round == 0);
    least = program_.solve(low - kBelow * std::abs(low), kMostSteps, proof.basis, mu_);
  }
}

/// U(mu), rounding included; leaves o - A'mu of all control points in d_.
double AnyRows::value() {
  most_ = P_.col(0);
  most_.noalias() -= P_.middleCols(1, j_) * mu_;
  g_ = P_.middleCols(1 + j_, b_);
  for (Eigen::Index axis = 0; axis < b_; ++axis) {
    g_.col(axis).noalias() -= P_.middleCols(1 + j_ + b_ + axis * j_, j_) * mu_;
  }
  d_.noalias() = g_ * B_b_;
  for (Eigen::Index k = 0; k < d_.cols(); ++k) {
    most_.array() += (d_.col(k).array() * u_min_[k]).max(d_.col(k).array() * u_max_[k]);
  }
  support_ = 0;
  for (Eigen::Index i = 0; i < j_; ++i) {
    support_ += std::max(mu_[i] * j_min_[i], mu_[i] * j_max_[i]);
  }
  const double off = fixed_ + mu_.cwiseAbs().dot(by_mu_);
  return support_ + most_.maxCoeff() + kBoundRounding * kMostSpread * off;
}

/// At the control points with the largest U(mu) above `least`, adds the best efforts for mu; with
/// `all`, in the first round, at all control points.
void AnyRows::add_points(double least, bool all) {
  const auto count = all ? static_cast<std::size_t>(P_.rows()) : kMostAdded;
  list_largest(most_, least - support_, count, order_);
  program_.set_points(points_ + static_cast<Eigen::Index>(order_.size()));
  for (const int v : order_) add_point(v);
}

void AnyRows::add_point(Eigen::Index v) {
  for (Eigen::Index k = 0; k < u_.size(); ++k) {
    u_[k] = d_(v, k) > 0 ? u_max_[k] : u_min_[k];
  }
  force_.noalias() = B_b_ * u_;
  const auto at = P_.row(v);
  program_.costs()[points_] = at[0] + at.segment(1 + j_, b_).dot(force_);
  for (Eigen::Index i = 0; i < j_; ++i) {
    double torque = at[1 + i];
    for (Eigen::Index axis = 0; axis < b_; ++axis) {
      torque += at[1 + j_ + b_ + axis * j_ + i] * force_[axis];
    }
    program_.row(i)[points_] = torque;
  }
  ++points_;
}

}  // namespace maxwrench
