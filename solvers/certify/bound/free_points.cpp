#include "solvers/certify/bound/free_points.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/math/decompositions.h"
#include "solvers/certify/bound/bounds.h"

namespace maxwrench {
namespace {

constexpr int kCentreSteps = 60;
constexpr double kSmallShare = 1e-3;  ///< of the largest term of s(lambda)
constexpr double kLeastWidth = 1e-5;
constexpr double kRidge = 1e-13;

Matrix6Xd free_components(const Problem& problem) {
  const Eigen::VectorXd along_c = problem.W_any.transpose() * problem.c;
  return problem.W_any * split(along_c).complement;
}

Eigen::MatrixXd all_sizes(const LoopModel& model, const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd all(model.n, 2 + columns.cols());
  all << model.tau, model.a, columns;
  return all;
}

}  // namespace

FreeColumns::FreeColumns(const Problem& problem, const LoopModel& model) {
  const Matrix6Xd W = free_components(problem);
  k = W.cols();
  sizes.setZero(model.n, k);
  LoopPosture posture(problem, model.coordinates);
  posture.carry(W);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(model.coordinates.lower.size());
  for (const LoopPart& part : model.parts) {
    if (part.kind != LoopPart::Kind::kLoads) continue;
    MultiAffine f(part.f.coordinates(), rest, [&](const ExtendedVector& x) {
      posture.set(x);
      const MatrixX<Extended> own = posture.columns()(part.rows, Eigen::all);
      return ExtendedVector(own.reshaped());
    });
    const Eigen::VectorXd S = f.magnitudes(model.coordinates.lower, model.coordinates.upper);
    const auto count = static_cast<Eigen::Index>(part.rows.size());
    sizes(part.rows, Eigen::all) += S.reshaped(count, k);
    parts.push_back({std::move(f), part.rows, part.repeat});
  }
}

FreePoints::FreePoints(std::shared_ptr<const FreeColumns> columns, const LoopModel& model,
                       std::shared_ptr<const Zonotope> set)
    : columns_(std::move(columns)),
      set_(std::move(set)),
      n_(model.n),
      k_(columns_->k),
      m_(set_->actuators()),
      rho_in_patterns_(few_patterns(model, m_ + k_)),
      points_(columns_->parts.size()),
      limits_(*set_, all_sizes(model, columns_->sizes)),
      centre_(Eigen::MatrixXd::Zero(n_ - k_, m_), set_->u_min, set_->u_max, 2),
      A_(Eigen::MatrixXd::Zero(n_, 1 + k_)),
      off_(Eigen::MatrixXd::Zero(n_, 2 + k_)),
      middle_((set_->u_min + set_->u_max) / 2),
      half_((set_->u_max - set_->u_min) / 2),
      u_(m_),
      q_(static_cast<std::size_t>(k_), Eigen::VectorXd::Zero(model.size)) {
  for (const FreeColumns::Part& part : columns_->parts) corners_.emplace_back(part.f);
  centre_.set_points(2);
}

bool FreePoints::few_patterns(const LoopModel& model, Eigen::Index numbers) {
  const double patterns = std::pow(2.0, static_cast<double>(numbers));
  return 2.0 * static_cast<double>(model.size) * patterns < std::numeric_limits<int>::max();
}

bool FreePoints::set(LoopBox& loads, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                     double low, double high) {
  find_centre(loads, lower, upper);
  if (!limits_.find(tau_, A_, off_, std::max(std::abs(low), std::abs(high)))) return false;
  const double most = limits_.Z()[0];
  most_t_ = std::min(high, most);
  least_t_ = std::min(std::max(low, -most), most_t_);
  find_N();
  find_P();
  limits_.rest(P_, A_, off_, R_);
  PB_.noalias() = P_ * set_->B;
  P_tau_.noalias() = P_ * tau_;
  sums_ = set_->B.cwiseAbs() * set_->u_min.cwiseAbs().cwiseMax(set_->u_max.cwiseAbs());
  h_ = R_;
  h_.noalias() += P_.cwiseAbs() * (sums_ + tau_.cwiseAbs());
  sizes_ = sums_;
  sizes_.noalias() += columns_->sizes * h_;
  return true;
}

/// tau, a and A at the centre, and how far they are from it in the box.
void FreePoints::find_centre(LoopBox& loads, const Eigen::VectorXd& lower,
                             const Eigen::VectorXd& upper) {
  own_ = (lower + upper) / 2;
  loads.evaluate(own_, sums_, slopes_);
  off_.setZero();
  off_.col(0) = sums_;
  off_.col(1) = slopes_;
  tau_ = loads.tau();
  A_.setZero();
  A_.col(0) = loads.a();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const FreeColumns::Part& part = columns_->parts[i];
    points_[i] = &corners_[i].over(lower, upper);
    const Eigen::VectorXd at = part.f.evaluate(own_);
    const auto count = static_cast<Eigen::Index>(part.rows.size());
    for (Eigen::Index row = 0; row < at.size(); ++row) {
      const int place = part.rows[static_cast<std::size_t>(row % count)];
      A_(place, 1 + row / count) += at[row];
      off_(place, 2 + row / count) += (points_[i]->row(row).array() - at[row]).abs().maxCoeff();
    }
  }
}

void FreePoints::find_N() {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(A_.rightCols(k_));
  N_.setIdentity(n_, n_);
  N_ = (qr.householderQ() * N_.rightCols(n_ - k_)).eval();
}

/// The P that minimises the squares of P B u over the actuators with small lambda'B, where lambda
/// is the multiplier of the centre. These efforts depend on the posture; all others are at limits.
void FreePoints::find_P() {
  S_.noalias() = N_.transpose() * set_->B;
  centre_.set_columns(S_);
  for (int i = 0; i < 2; ++i) {
    const double t = i == 0 ? -limits_.Z()[0] : limits_.Z()[0];
    own_.noalias() = N_.transpose() * (tau_ + t * A_.col(0));
    for (Eigen::Index j = 0; j < own_.size(); ++j) centre_.row(j)[i] = own_[j];
    centre_.costs()[i] = t;
  }
  basis_.clear();
  centre_.solve(-kInfinity, kCentreSteps, basis_, y_);
  centre_lambda_.noalias() = N_ * y_;
  own_.noalias() = set_->B.transpose() * centre_lambda_;
  own_ = own_.cwiseAbs().cwiseProduct(half_);
  own_ = kSmallShare * own_.maxCoeff() / own_.array().max(1e-300);
  own_ = own_.cwiseMin(1).cwiseMax(kLeastWidth).cwiseProduct(half_);
  S_.noalias() = set_->B * own_.cwiseAbs2().asDiagonal() * set_->B.transpose();
  S_.diagonal() += kRidge * S_.diagonal().maxCoeff() * Eigen::VectorXd::Ones(n_);
  llt_.compute(S_);
  S_ = llt_.solve(A_);
  llt_.compute(A_.transpose() * S_);
  P_ = llt_.solve(S_.transpose()).bottomRows(k_);
  if (!P_.allFinite()) P_ = limits_.P().bottomRows(k_);
}

void FreePoints::weigh(const Eigen::VectorXd& lambda, Eigen::VectorXd& g) {
  for (Eigen::VectorXd& q : q_) q.setZero();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const FreeColumns::Part& part = columns_->parts[i];
    own_ = lambda(part.rows);
    const Eigen::Index count = own_.size();
    for (Eigen::Index j = 0; j < k_; ++j) {
      sums_.noalias() = points_[i]->middleRows(j * count, count).transpose() * own_;
      spread_out(part.repeat, sums_, q_[static_cast<std::size_t>(j)]);
    }
  }
  lambda_.noalias() = set_->B.transpose() * lambda;
  for (Eigen::Index j = 0; j < k_; ++j) {
    const Eigen::VectorXd& q = q_[static_cast<std::size_t>(j)];
    g.array() -= P_tau_[j] * q.array() + R_[j] * q.array().abs();
  }
  for (Eigen::Index i = 0; i < m_; ++i) {
    slopes_.setConstant(g.size(), lambda_[i]);
    for (Eigen::Index j = 0; j < k_; ++j) slopes_ -= PB_(j, i) * q_[static_cast<std::size_t>(j)];
    g.array() -= middle_[i] * slopes_.array() + half_[i] * slopes_.array().abs();
  }
}

int FreePoints::pattern(Eigen::Index v) const {
  int pattern = 0, bit = 0;
  for (Eigen::Index i = 0; i < m_; ++i) {
    double slope = lambda_[i];
    for (Eigen::Index j = 0; j < k_; ++j) slope -= PB_(j, i) * q_[static_cast<std::size_t>(j)][v];
    pattern |= (slope > 0 ? 1 : 0) << bit++;
  }
  if (!rho_in_patterns_) return pattern;
  for (const Eigen::VectorXd& q : q_) pattern |= (q[v] < 0 ? 1 : 0) << bit++;
  return pattern;
}

void FreePoints::add(Eigen::Index v, int pattern, Eigen::VectorXd& load) {
  for (Eigen::Index i = 0; i < m_; ++i) u_[i] = pattern >> i & 1 ? set_->u_max[i] : set_->u_min[i];
  h_ = -P_tau_;
  h_.noalias() += PB_ * u_;
  for (Eigen::Index j = 0; rho_in_patterns_ && j < k_; ++j) {
    h_[j] += pattern >> (m_ + j) & 1 ? R_[j] : -R_[j];
  }
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const FreeColumns::Part& part = columns_->parts[i];
    const auto at = points_[i]->col(v / part.repeat % part.f.size());
    const auto count = static_cast<Eigen::Index>(part.rows.size());
    for (Eigen::Index row = 0; row < at.size(); ++row) {
      load[part.rows[static_cast<std::size_t>(row % count)]] += at[row] * h_[row / count];
    }
  }
}

}  // namespace maxwrench
