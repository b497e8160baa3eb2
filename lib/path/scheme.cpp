#include "lib/path/scheme.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace maxwrench {
namespace {

/// Values and derivatives of a cubic spline through knots at times 0, dt, 2 dt, ... as rows over
/// the K knots.
class SplineRows {
 public:
  /// theta_r_dot = 0 at both ends. K >= 2.
  SplineRows(int knots, double dt) : dt_(dt) {
    // The slopes m of a clamped spline: m_i-1 + 4 m_i + m_i+1 = 3 (q_i+1 - q_i-1)/dt.
    Eigen::MatrixXd system = Eigen::MatrixXd::Identity(knots, knots);
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(knots, knots);
    for (int i = 1; i + 1 < knots; ++i) {
      system.row(i).segment(i - 1, 3) << 1, 4, 1;
      right(i, i + 1) = 3 / dt;
      right(i, i - 1) = -3 / dt;
    }
    slopes_ = system.partialPivLu().solve(right);
  }

  /// At z = (t - t_i)/dt in [0, 1] of interval i, by Hermite's basis.
  void at(int i, double z, Eigen::RowVectorXd& value, Eigen::RowVectorXd& rate,
          Eigen::RowVectorXd& bend) const {
    const double z2 = z * z, z3 = z2 * z;
    value = (z3 - 2 * z2 + z) * dt_ * slopes_.row(i) + (z3 - z2) * dt_ * slopes_.row(i + 1);
    rate = (3 * z2 - 4 * z + 1) * slopes_.row(i) + (3 * z2 - 2 * z) * slopes_.row(i + 1);
    bend = ((6 * z - 4) * slopes_.row(i) + (6 * z - 2) * slopes_.row(i + 1)) / dt_;
    value[i] += 2 * z3 - 3 * z2 + 1;
    value[i + 1] += 3 * z2 - 2 * z3;
    const double rise = (6 * z - 6 * z2) / dt_, turn = (6 - 12 * z) / (dt_ * dt_);
    rate[i] -= rise;
    rate[i + 1] += rise;
    bend[i] -= turn;
    bend[i + 1] += turn;
  }

 private:
  double dt_;
  Eigen::MatrixXd slopes_;  ///< K×K
};

void resize(SchemeMaps& maps, int instants, int knots) {
  maps.t.assign(static_cast<std::size_t>(instants), 0);
  maps.x.assign(static_cast<std::size_t>(instants), {});
  maps.knot_at.assign(static_cast<std::size_t>(knots), -1);
  maps.P = Eigen::MatrixXd::Zero(instants, knots);
  maps.V = Eigen::MatrixXd::Zero(instants, knots);
  maps.moves = Eigen::VectorXd::Ones(instants);
  maps.zero.resize(0, knots);
  maps.place.resize(0, knots);
}

/// Every pair of neighbouring knots: their difference by dt.
void limit_differences(SchemeMaps& maps) {
  const int pairs = maps.knots() - 1;
  maps.speed = Eigen::MatrixXd::Zero(std::max(pairs, 0), maps.knots());
  for (int i = 0; i < pairs; ++i) {
    maps.speed(i, i) = -1 / maps.dt;
    maps.speed(i, i + 1) = 1 / maps.dt;
  }
}

void append(Eigen::MatrixXd& rows, const Eigen::MatrixXd& more) {
  const Eigen::Index before = rows.rows();
  rows.conservativeResize(before + more.rows(), more.cols());
  rows.bottomRows(more.rows()) = more;
}

SchemeMaps make_spline(const MotionTask& task, int per_interval, bool limited) {
  const int knots = task.k + (task.impulse ? 1 : 0);
  if (knots < 2) throw std::invalid_argument("scheme: got spline with k = 1, expected k >= 2");
  SchemeMaps maps;
  const int intervals = knots - 1, instants = per_interval * intervals + 1;
  resize(maps, instants, knots);
  maps.A = Eigen::MatrixXd::Zero(instants, knots);
  maps.dt = task.T / intervals;
  maps.starts = task.impulse;
  const SplineRows spline(knots, maps.dt);
  Eigen::RowVectorXd value(knots), rate(knots), bend(knots);
  for (int n = 0; n < instants; ++n) {
    const int i = std::min(n / per_interval, intervals - 1);
    const double z = static_cast<double>(n - i * per_interval) / per_interval;
    spline.at(i, z, value, rate, bend);
    maps.P.row(n) = value;
    maps.V.row(n) = rate;
    maps.A.row(n) = bend;
    const auto at = static_cast<std::size_t>(n);
    maps.t[at] = n == instants - 1 ? task.T : n * maps.dt / per_interval;
    maps.x[at] = task.path.at(task.impulse ? 0 : maps.t[at]);
    if (n % per_interval == 0) maps.knot_at[static_cast<std::size_t>(n / per_interval)] = n;
  }
  if (task.impulse && limited) maps.zero = maps.dt * maps.dt * maps.A.row(0);
  if (maps.starts) maps.moves[0] = 0;
  limit_differences(maps);
  if (limited) {
    append(maps.speed, maps.V);
    append(maps.place, maps.P);
  }
  return maps;
}

/// [linear; angular] of the logarithm of A^-1 B in SE(3), both turned into world axes by A.
Vector6d log_between(const Pose<double>& A, const Pose<double>& B) {
  const Pose<double> step = A.inverse() * B;
  const Eigen::Vector3d turn = logarithm(step.R);
  const double angle = turn.norm();
  const Eigen::Matrix3d S = skew(turn);
  // V^-1 = I - S/2 + (1 - (a/2) cot(a/2)) S^2/a^2.
  const double half = angle / 2;
  const double factor =
      angle < 1e-4 ? 1.0 / 12 + angle * angle / 720 : (1 - half / std::tan(half)) / (angle * angle);
  const Eigen::Vector3d linear = step.p - S * step.p / 2 + factor * S * (S * step.p);
  Vector6d log;
  log << A.R * linear, A.R * turn;
  return log;
}

/// `forward` and `ends` along a path.
SchemeMaps make_differences(const MotionTask& task) {
  SchemeMaps maps;
  const int k = task.k;
  resize(maps, k, k);
  const bool ends = task.scheme == Scheme::kEnds;
  const double step = k == 1 ? task.T : ends ? task.T / (k - 1) : task.T / k;
  maps.dt = k == 1 ? 0 : step;
  maps.D = Eigen::MatrixXd::Zero(k, k);
  for (int i = 0; i < k; ++i) {
    const auto at = static_cast<std::size_t>(i);
    maps.knot_at[at] = i;
    maps.t[at] = i * step;
    const double along = k == 1 ? 0 : task.T * i / (k - 1);
    maps.x[at].pose = task.path.pose(along);
    maps.P(i, i) = 1;
    if (i + 1 == k) {
      maps.moves[i] = 0;
      continue;
    }
    maps.x[at].twist =
        log_between(maps.x[at].pose, task.path.pose(task.T * (i + 1) / (k - 1))) / step;
    maps.V(i, i) = -1 / step;
    maps.V(i, i + 1) = 1 / step;
    maps.D(i, i) = -1 / step;
    maps.D(i, i + 1) = 1 / step;
  }
  if (ends) maps.moves[0] = 0;
  limit_differences(maps);
  return maps;
}

/// `forward`, `backward` and `backward_stop` of a heave: instants are the knots.
SchemeMaps make_heave_differences(const MotionTask& task) {
  SchemeMaps maps;
  const int knots = task.k + 1, last = task.k;
  resize(maps, knots, knots);
  maps.starts = true;
  maps.dt = task.T / task.k;
  maps.D = Eigen::MatrixXd::Zero(knots, knots);
  maps.moves[0] = 0;
  const bool forward = task.scheme == Scheme::kForward;
  for (int i = 0; i < knots; ++i) {
    const auto at = static_cast<std::size_t>(i);
    maps.knot_at[at] = i;
    maps.t[at] = i * maps.dt;
    maps.x[at].pose = task.path.pose(0);
    maps.P(i, i) = 1;
    const int from = forward ? i : i - 1, to = from + 1;
    if (i == 0 || to > last) {
      maps.moves[i] = 0;
      continue;
    }
    for (Eigen::MatrixXd* difference : {&maps.V, &maps.D}) {
      (*difference)(i, from) = -1 / maps.dt;
      (*difference)(i, to) = 1 / maps.dt;
    }
  }
  if (task.scheme == Scheme::kBackwardStop) {
    maps.zero = Eigen::MatrixXd::Zero(1, knots);
    maps.zero(0, last) = 1;
    maps.zero(0, last - 1) = -1;
  }
  limit_differences(maps);
  return maps;
}

}  // namespace

SchemeMaps make_scheme(const MotionTask& task) {
  if (task.scheme == Scheme::kSpline) return make_spline(task, task.instants_per_interval, true);
  const bool backward = task.scheme == Scheme::kBackward || task.scheme == Scheme::kBackwardStop;
  if (task.impulse ? task.scheme == Scheme::kEnds : backward) {
    throw std::invalid_argument(std::string("scheme: got ") + to_string(task.scheme) +
                                ", expected one of " +
                                (task.impulse ? "spline forward backward backward_stop of a heave"
                                              : "spline forward ends of a path"));
  }
  return task.impulse ? make_heave_differences(task) : make_differences(task);
}

SchemeMaps make_continuous(const MotionTask& task, int instants_per_interval) {
  return make_spline(task, instants_per_interval, false);
}

}  // namespace maxwrench
