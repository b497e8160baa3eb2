#include "lib/trajectory/scheme.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "lib/math/cubic_spline.h"

namespace maxwrench {
namespace {

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

/// Limits the difference of every pair of neighbouring knots divided by dt.
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
  maps.before = task.impulse || task.transfer ? 1 : 0;
  maps.after = task.transfer ? 1 : 0;
  std::vector<double> times;
  for (int knot = 0; knot < knots; ++knot) times.push_back(knot * maps.dt);
  const Eigen::MatrixXd values = Eigen::MatrixXd::Identity(knots, knots);
  const Eigen::MatrixXd bends = clamped_spline_bends(times, values);
  for (int n = 0; n < instants; ++n) {
    // At a knot the time is that of the knot, exactly.
    const bool knot = n % per_interval == 0;
    const SplineInstant at_n =
        spline_at(times, knot ? times[static_cast<std::size_t>(n / per_interval)]
                              : n * maps.dt / per_interval);
    Eigen::MatrixXd four(knots, 4);
    four << values.middleCols<2>(at_n.interval), bends.middleCols<2>(at_n.interval);
    const Eigen::MatrixXd rows = (four * at_n.weights).transpose();
    maps.P.row(n) = rows.row(0);
    maps.V.row(n) = rows.row(1);
    maps.A.row(n) = rows.row(2);
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

/// `forward`, `backward` and `backward_stop` of an impulse: the instants are the knots.
SchemeMaps make_impulse_differences(const MotionTask& task) {
  SchemeMaps maps;
  const int knots = task.k + 1, last = task.k;
  resize(maps, knots, knots);
  maps.starts = true;
  maps.before = 1;
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
  if (task.has_factor()) {
    throw std::invalid_argument(std::string("scheme: got ") + to_string(task.scheme) +
                                ", expected spline for a payload or a table of wrenches");
  }
  const bool backward = task.scheme == Scheme::kBackward || task.scheme == Scheme::kBackwardStop;
  if (task.impulse ? task.scheme == Scheme::kEnds : backward) {
    throw std::invalid_argument(
        std::string("scheme: got ") + to_string(task.scheme) + ", expected one of " +
        (task.impulse ? "spline forward backward backward_stop of an impulse"
                      : "spline forward ends of a path"));
  }
  return task.impulse ? make_impulse_differences(task) : make_differences(task);
}

Eigen::MatrixXd all_knots(const MotionTask& task, const Eigen::MatrixXd& table) {
  if (!task.impulse && !task.transfer) return table;
  Eigen::MatrixXd all(table.rows() + (task.transfer ? 2 : 1), table.cols());
  all.row(0) = task.theta_0.transpose();
  all.middleRows(1, table.rows()) = table;
  if (task.transfer) all.bottomRows<1>() = task.theta_T.transpose();
  return all;
}

SchemeMaps make_dense_spline(const MotionTask& task, int instants_per_interval) {
  return make_spline(task, instants_per_interval, false);
}

}  // namespace maxwrench
