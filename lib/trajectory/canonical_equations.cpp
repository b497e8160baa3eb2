#include "lib/trajectory/canonical_equations.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

constexpr double kSlopeStep = 1e-5;  // rad or m, rad/s or m/s

Eigen::VectorXd finite_limits(const Problem& problem) {
  const Zonotope& actuation = problem.robot.actuation;
  Eigen::VectorXd w = effort_weights(problem);
  for (Eigen::Index i = 0; i < w.size(); ++i) {
    if (w[i] > 0 && std::isfinite(w[i])) continue;
    throw std::invalid_argument("search: got 'pontryagin' for an actuator with limits of " +
                                std::to_string(actuation.u_min[i]) + " and " +
                                std::to_string(actuation.u_max[i]) +
                                ", expected finite limits, of which one is not zero");
  }
  return w;
}

}  // namespace

Eigen::VectorXd effort_weights(const Problem& problem) {
  const Zonotope& actuation = problem.robot.actuation;
  return actuation.u_min.cwiseAbs().cwiseMax(actuation.u_max.cwiseAbs());
}

CanonicalEquations::CanonicalEquations(const Problem& problem)
    : problem_(problem),
      dynamics_(problem),
      other_(problem),
      w_(finite_limits(problem)),
      v_max_(joints()),
      zero_(Eigen::VectorXd::Zero(joints())) {
  for (int j = 0; j < joints(); ++j) {
    const auto joint = static_cast<std::size_t>(problem.redundant[static_cast<std::size_t>(j)]);
    v_max_[j] = problem.robot.joints[joint].velocity_max;
  }
  set_index({});
}

void CanonicalEquations::set_index(const TransferIndex& index) {
  index_ = index;
  fastest_ = index.speeds * v_max_;
}

void CanonicalEquations::split(const Eigen::VectorXd& z) {
  const int n = joints();
  q_ = z.head(n);
  v_ = z.segment(n, n);
  p_ = z.segment(2 * n, n);
  lambda_ = z.segment(3 * n, n);
}

/// Sets u, the maximum of H.
void CanonicalEquations::set_efforts() {
  const Zonotope& actuation = problem_.robot.actuation;
  s_.noalias() = actuation.B.transpose() * y_;
  u_ = (w_.array().square() * s_.array() / index_.epsilon)
           .max(index_.reach * actuation.u_min.array())
           .min(index_.reach * actuation.u_max.array());
}

/// Adds Pi_q and Pi_v.
void CanonicalEquations::add_excess(Eigen::VectorXd& z_dot) const {
  const int n = joints();
  for (int j = 0; j < n; ++j) {
    const double far = excess_of(q_[j], problem_.theta_r_min[j], problem_.theta_r_max[j]);
    z_dot[2 * n + j] += index_.stiffness * far;
    if (std::isinf(fastest_[j])) continue;
    z_dot[3 * n + j] += index_.stiffness * excess_of(v_[j] / fastest_[j], -1, 1) / fastest_[j];
  }
}

double CanonicalEquations::excess() const {
  double sum = 0;
  for (int j = 0; j < joints(); ++j) {
    const double far = excess_of(q_[j], problem_.theta_r_min[j], problem_.theta_r_max[j]);
    const double fast = std::isinf(fastest_[j]) ? 0 : excess_of(v_[j] / fastest_[j], -1, 1);
    sum += far * far + fast * fast;
  }
  return index_.stiffness / 2 * sum;
}

bool CanonicalEquations::rates(const Eigen::VectorXd& z, double m, Eigen::VectorXd& z_dot) {
  const int n = joints();
  split(z);
  dynamics_.set(q_, v_, zero_, m);
  M_.compute(dynamics_.M());
  y_ = M_.solve(lambda_);
  set_efforts();
  a_.noalias() = problem_.robot.actuation.B * u_;
  a_ -= dynamics_.f();
  a_ = M_.solve(a_);
  dynamics_.set(q_, v_, a_, m);
  z_dot.resize(size());
  z_dot.head(n) = v_;
  z_dot.segment(n, n) = a_;
  z_dot.segment(2 * n, n).noalias() = dynamics_.by_q().transpose() * y_;
  z_dot.segment(3 * n, n).noalias() = dynamics_.by_v().transpose() * y_;
  z_dot.segment(3 * n, n) -= p_;
  z_dot[4 * n] = y_.dot(dynamics_.g());
  add_excess(z_dot);
  return z_dot.allFinite();
}

double CanonicalEquations::hamiltonian() const {
  return -index_.epsilon / 2 * (u_.array() / w_.array()).square().sum() - excess() + p_.dot(v_) +
         lambda_.dot(a_);
}

double CanonicalEquations::hamiltonian(const Eigen::VectorXd& z, double m,
                                       const Eigen::VectorXd& u) {
  split(z);
  u_ = u;
  dynamics_.set(q_, v_, zero_, m);
  a_ = dynamics_.M().ldlt().solve(problem_.robot.actuation.B * u - dynamics_.f());
  return hamiltonian();
}

/// Differences of f_q'y, f_v'y and M y along each coordinate of q and v.
void CanonicalEquations::differentiate_slopes(double m) {
  const int n = joints();
  for (Eigen::MatrixXd* part : {&H_qq_, &H_qv_, &H_vq_, &H_vv_, &N_}) part->setZero(n, n);
  const double share = 1 / (2 * kSlopeStep);
  for (int j = 0; j < n; ++j) {
    for (const double sign : {1.0, -1.0}) {
      Eigen::VectorXd moved = q_;
      moved[j] += sign * kSlopeStep;
      other_.set(moved, v_, a_, m);
      H_qq_.col(j) += sign * share * other_.by_q().transpose() * y_;
      H_vq_.col(j) += sign * share * other_.by_v().transpose() * y_;
      N_.col(j) += sign * share * other_.M() * y_;
      moved = v_;
      moved[j] += sign * kSlopeStep;
      other_.set(q_, moved, a_, m);
      H_qv_.col(j) += sign * share * other_.by_q().transpose() * y_;
      H_vv_.col(j) += sign * share * other_.by_v().transpose() * y_;
    }
  }
}

bool CanonicalEquations::linearize(const Eigen::VectorXd& z, double m, Eigen::VectorXd& z_dot,
                                   Eigen::MatrixXd& by_z, Eigen::VectorXd& by_m) {
  if (!rates(z, m, z_dot)) return false;
  const int n = joints(), d = size();
  differentiate_slopes(m);
  other_.set(q_, v_, a_, m + 1);  // affine in m
  const Eigen::MatrixXd g_q = other_.by_q() - dynamics_.by_q();
  const Eigen::MatrixXd g_v = other_.by_v() - dynamics_.by_v();
  const Eigen::MatrixXd M_1 = other_.M() - dynamics_.M();
  const Zonotope& actuation = problem_.robot.actuation;
  const Eigen::MatrixXd& B = actuation.B;

  // Columns: by q, v, p, lambda, nu and m.
  const auto q = Eigen::seqN(0, n), v = Eigen::seqN(n, n), p = Eigen::seqN(2 * n, n),
             lambda = Eigen::seqN(3 * n, n);
  Eigen::MatrixXd dy = Eigen::MatrixXd::Zero(n, d + 1);
  dy(Eigen::all, q) = -N_;
  dy(Eigen::all, lambda).setIdentity();
  dy.col(d) = -M_1 * y_;
  dy = M_.solve(dy).eval();
  Eigen::MatrixXd du = B.transpose() * dy;
  for (Eigen::Index i = 0; i < u_.size(); ++i) {
    const bool free =
        u_[i] > index_.reach * actuation.u_min[i] && u_[i] < index_.reach * actuation.u_max[i];
    du.row(i) *= free ? w_[i] * w_[i] / index_.epsilon : 0;
  }
  Eigen::MatrixXd da = B * du;
  da(Eigen::all, q) -= dynamics_.by_q();
  da(Eigen::all, v) -= dynamics_.by_v();
  da.col(d) -= dynamics_.g();
  da = M_.solve(da).eval();

  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(d, d + 1);
  all(q, v).setIdentity();
  all(v, Eigen::all) = da;
  all(p, Eigen::all) = N_.transpose() * da + dynamics_.by_q().transpose() * dy;
  all(p, q) += H_qq_;
  all(p, v) += H_qv_;
  all(p, d) += g_q.transpose() * y_;
  all(lambda, Eigen::all) = dynamics_.by_v().transpose() * dy;
  all(lambda, q) += H_vq_;
  all(lambda, v) += H_vv_;
  all(lambda, d) += g_v.transpose() * y_;
  all(lambda, p) -= Eigen::MatrixXd::Identity(n, n);
  all.row(4 * n) = dynamics_.g().transpose() * dy + (M_1 * y_).transpose() * da;
  all(4 * n, q) += y_.transpose() * g_q;
  all(4 * n, v) += y_.transpose() * g_v;
  for (int j = 0; j < n; ++j) {
    if (excess_of(q_[j], problem_.theta_r_min[j], problem_.theta_r_max[j]) != 0) {
      all(2 * n + j, j) += index_.stiffness;
    }
    if (std::isinf(fastest_[j]) || std::abs(v_[j]) <= fastest_[j]) continue;
    all(3 * n + j, n + j) += index_.stiffness / (fastest_[j] * fastest_[j]);
  }
  by_z = all.leftCols(d);
  by_m = all.col(d);
  return all.allFinite();
}

Eigen::VectorXd CanonicalEquations::costate_of(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                               const Eigen::VectorXd& a, double m) {
  const Zonotope& actuation = problem_.robot.actuation;
  dynamics_.set(q, v, a, m);
  const Eigen::VectorXd u = actuation.B_pinv * dynamics_.f();
  const Eigen::VectorXd s = index_.epsilon * u.array() / w_.array().square();
  // y of least squares: B'y = s.
  return dynamics_.M() * (actuation.B_pinv.transpose() * s);
}

}  // namespace maxwrench
