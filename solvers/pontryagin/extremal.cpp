#include "solvers/pontryagin/extremal.h"

#include <algorithm>
#include <cmath>

#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

constexpr double kShootingConverged = 1e-6;  // rad or m, and of the size of costates
constexpr double kSmallestDamping = 1e-4;

/// The largest magnitude of a costate.
double size_of_costates(const Extremal& extremal) {
  double size = 0;
  for (const Eigen::VectorXd& z : extremal.nodes) {
    size = std::max(size, z.tail(z.size() / 2).lpNorm<Eigen::Infinity>());
  }
  return size > 0 ? size : 1;
}

/// The extremal after a share of a step of all unknowns.
Extremal stepped(Extremal at, double share, const Eigen::VectorXd& change) {
  const Eigen::Index size = at.nodes.front().size(), half = size / 2;
  at.nodes[0].tail(half) += share * change.head(half);
  for (std::size_t k = 1; k < at.nodes.size(); ++k) {
    at.nodes[k] += share * change.segment(size * static_cast<Eigen::Index>(k) - half, size);
  }
  at.m += share * change[change.size() - 1];
  return at;
}

/// The length of a step, costates in units of their size.
double scaled_change(const Eigen::VectorXd& change, const Extremal& at) {
  const Eigen::Index size = at.nodes.front().size(), half = size / 2;
  const double costate = size_of_costates(at);
  double sum = (change.head(half) / costate).squaredNorm();
  for (Eigen::Index k = half; k + 1 < change.size(); k += size) {
    sum += change.segment(k, half).squaredNorm() +
           (change.segment(k + half, half) / costate).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(at.nodes.size()) +
                   change[change.size() - 1] * change[change.size() - 1]);
}

}  // namespace

Shooting::Shooting(const Problem& problem, std::function<bool()> spend)
    : problem_(problem), spend_(std::move(spend)), equations_(problem), flow_(equations_) {}

Extremal Shooting::guess(const SplineMotion& motion, double m) {
  const int n = equations_.joints();
  const int intervals = static_cast<int>(motion.Q.rows()) - 1;
  const int per_interval = (motion.maps.instants() - 1) / intervals;
  const double h = duration() / intervals;
  Extremal extremal;
  extremal.m = m;
  equations_.set_index(extremal.index);
  // lambda at all instants, and lambda' + p = f_v'y of each.
  Eigen::MatrixXd lambda(n, motion.maps.instants()), turned(n, motion.maps.instants());
  Eigen::VectorXd z(4 * n + 1), z_dot;
  for (int i = 0; i < motion.maps.instants(); ++i) {
    lambda.col(i) = equations_.costate_of(motion.q(i), motion.v(i), motion.a(i), m);
    z << motion.q(i), motion.v(i), Eigen::VectorXd::Zero(n), lambda.col(i), 0;
    equations_.rates(z, m, z_dot);
    turned.col(i) = z_dot.segment(3 * n, n);
  }
  for (int k = 0; k < intervals; ++k) {
    const int i = k * per_interval;
    Eigen::VectorXd node(4 * n);
    // p such that lambda reaches its next value.
    node << motion.q(i), motion.v(i),
        turned.middleCols(i, per_interval + 1).rowwise().mean() -
            (lambda.col(i + per_interval) - lambda.col(i)) / h,
        lambda.col(i);
    extremal.nodes.push_back(node);
  }
  return extremal;
}

double Shooting::duration() const { return problem_.motion->T; }

CanonicalEquations& Shooting::equations(const Extremal& extremal) {
  equations_.set_index(extremal.index);
  return equations_;
}

/// Sets the residuals and, if asked, their derivatives. The unknowns are the costates of the first
/// node, all others, and m.
bool Shooting::evaluate(const Extremal& extremal, bool free_mass, bool with_slopes) {
  ended_ = !spend_();
  if (ended_) return false;
  const int n = equations_.joints(), count = static_cast<int>(extremal.nodes.size());
  const int size = 4 * n * count - 2 * n + 1;
  equations_.set_index(extremal.index);
  const double costate = size_of_costates(extremal), h = duration() / count;
  F_.setZero(size);
  scaled_.setZero(size);
  if (with_slopes) J_.setZero(size, size);
  nu_ = 0;
  Eigen::VectorXd z(4 * n + 1);
  for (int k = 0; k < count; ++k) {
    z << extremal.nodes[static_cast<std::size_t>(k)], 0;
    if (!flow_.advance(h, z, extremal.m, costate, with_slopes ? &slopes_ : nullptr)) return false;
    const bool last = k + 1 == count;
    const int rows = last ? 2 * n : 4 * n, row = 4 * n * k;
    F_.segment(row, rows) = z.head(rows);
    if (last) {
      F_.segment(row, n) -= problem_.motion->theta_T;
    } else {
      F_.segment(row, rows) -= extremal.nodes[static_cast<std::size_t>(k + 1)];
    }
    scaled_.segment(row, rows) = F_.segment(row, rows);
    if (!last) scaled_.segment(row + 2 * n, 2 * n) /= costate;
    nu_ += z[4 * n];
    if (!with_slopes) continue;
    // The first node has 2 n unknowns.
    const int column = k == 0 ? 0 : 4 * n * k - 2 * n;
    const int first = k == 0 ? 2 * n : 0, columns = 4 * n - first;
    J_.block(row, column, rows, columns) = slopes_.block(0, first, rows, columns);
    J_.block(row, size - 1, rows, 1) = slopes_.col(4 * n + 1).head(rows);
    if (!last) J_.block(row, column + columns, rows, rows).diagonal().array() -= 1;
    if (!free_mass) continue;
    J_.row(size - 1).segment(column, columns) = slopes_.row(4 * n).segment(first, columns);
    J_(size - 1, size - 1) += slopes_(4 * n, 4 * n + 1);
  }
  if (free_mass) {
    F_[size - 1] = nu_ - 1;
  } else {
    F_[size - 1] = extremal.m - given_m_;
    if (with_slopes) J_(size - 1, size - 1) = 1;
  }
  scaled_[size - 1] = F_[size - 1];
  return F_.allFinite();
}

int Shooting::solve(Extremal& extremal, bool free_mass, int most_steps) {
  Extremal at = extremal;
  given_m_ = extremal.m;
  if (!evaluate(at, free_mass, true)) return -1;
  share_ = 1;
  for (int step = 0; step < most_steps; ++step) {
    if (residual() < kShootingConverged) {
      at.nu = nu_;
      extremal = at;
      return step;
    }
    lu_.compute(J_);
    const Eigen::VectorXd change = lu_.solve(-F_);
    if (!change.allFinite()) return -1;
    const double length = scaled_change(change, at);
    double share = std::min(1.0, 2 * share_);
    for (;; share /= 2) {
      if (share < kSmallestDamping) return -1;
      Extremal next = stepped(at, share, change);
      if (!evaluate(next, free_mass, false)) {
        if (ended_) return -1;
        continue;
      }
      const double next_length = scaled_change(lu_.solve(F_), at);
      if (next_length <= (1 - share / 4) * length) {
        at = std::move(next);
        break;
      }
    }
    share_ = share;
    if (!evaluate(at, free_mass, true)) return -1;
  }
  return -1;
}

std::vector<Eigen::VectorXd> Shooting::sample(const Extremal& extremal, int per_interval) {
  const int count = static_cast<int>(extremal.nodes.size());
  const double costate = size_of_costates(extremal);
  equations_.set_index(extremal.index);
  std::vector<Eigen::VectorXd> states;
  for (const Eigen::VectorXd& node : extremal.nodes) {
    Eigen::VectorXd z(node.size() + 1);
    z << node, 0;
    states.push_back(z);
    for (int i = 0; i < per_interval; ++i) {
      if (!flow_.advance(duration() / count / per_interval, z, extremal.m, costate, nullptr)) {
        return {};
      }
      if (i + 1 < per_interval) states.push_back(z);
    }
    if (&node == &extremal.nodes.back()) states.push_back(z);
  }
  return states;
}

}  // namespace maxwrench
