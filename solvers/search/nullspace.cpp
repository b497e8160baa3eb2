#include <algorithm>
#include <array>
#include <cmath>

#include "lib/math/random.h"
#include "solvers/integrator/makers.h"
#include "solvers/search/makers.h"
#include "solvers/search/probe.h"

namespace maxwrench {
namespace {

/// The flow M(theta_r) theta_r_dot = d f/d theta_r on the coordinates F that move; the others are
/// fixed at a bound. It is eq:NullSpace, theta_dot = (I - J^+ J) d f/d theta, in the coordinates of
/// eq:redundantJacobian: theta_dot = A_r theta_r_dot keeps the end effector where it is, M =
/// A_r'A_r.
class Flow final : public Ode {
 public:
  Flow(Probe& probe, const Objective& objective, Eigen::VectorXd theta_r)
      : probe_(probe),
        lower_(objective.lower()),
        upper_(objective.upper()),
        theta_r_(std::move(theta_r)),
        moves_(theta_r_.size(), true) {}

  const Eigen::VectorXd& initial() const override { return theta_r_; }

  bool derivative(double /*t*/, const Eigen::VectorXd& y, Eigen::VectorXd& y_dot) override {
    if (probe_.left() == 0) return false;
    // A trial step may leave the bounds slightly; the flow does not.
    const Eigen::VectorXd theta_r = y.cwiseMax(lower_).cwiseMin(upper_);
    if (probe_.evaluate(theta_r, &gradient_) == -kInfinity) return false;
    probe_.metric(M_);
    return velocity(y_dot);
  }

  /// The distances to the bounds; constants for a fixed coordinate.
  int roots() const override { return 2 * dimension(); }
  void root(double /*t*/, const Eigen::VectorXd& y, Eigen::VectorXd& g) override {
    for (int i = 0; i < dimension(); ++i) {
      g[2 * i] = moves_[i] ? y[i] - lower_[i] : 1;
      g[2 * i + 1] = moves_[i] ? upper_[i] - y[i] : 1;
    }
  }

  /// Continues from y, where root number `root` was found (-1: none).
  void move_to(const Eigen::VectorXd& y, int root) {
    theta_r_ = y.cwiseMax(lower_).cwiseMin(upper_);
    if (root >= 0) theta_r_[root / 2] = root % 2 == 0 ? lower_[root / 2] : upper_[root / 2];
  }

  /// Fixes the coordinates that would leave their bounds, one after the other, and frees all
  /// others. Returns the remaining speed |theta_r_dot|, zero if there is no flow.
  double choose() {
    std::fill(moves_.begin(), moves_.end(), true);
    Eigen::VectorXd v;
    if (!derivative(0, theta_r_, v)) return 0;
    for (int left = dimension(); left > 0; --left) {
      int worst = -1;
      for (int i = 0; i < dimension(); ++i) {
        const bool leaves =
            (theta_r_[i] <= lower_[i] && v[i] < 0) || (theta_r_[i] >= upper_[i] && v[i] > 0);
        if (leaves && (worst < 0 || std::abs(v[i]) > std::abs(v[worst]))) worst = i;
      }
      if (worst < 0) break;
      moves_[worst] = false;
      if (!velocity(v)) return 0;
    }
    return v.norm();
  }

 private:
  /// v_F = M_FF^-1 g_F, so f grows by g_F' M_FF^-1 g_F >= 0, whichever coordinates are fixed.
  bool velocity(Eigen::VectorXd& v) {
    for (int i = 0; i < dimension(); ++i) {
      if (moves_[i]) continue;
      M_.row(i).setZero();
      M_.col(i).setZero();
      M_(i, i) = 1;
      gradient_[i] = 0;
    }
    v = M_.ldlt().solve(gradient_);
    return v.allFinite();
  }

  Probe& probe_;
  const Eigen::VectorXd lower_, upper_;
  Eigen::VectorXd theta_r_;
  std::vector<bool> moves_;
  Eigen::VectorXd gradient_;
  Eigen::MatrixXd M_;
};

/// Projection of the gradient onto the null space of J, eq:NullSpace: the established local method,
/// and the baseline that every global search should improve on.
///
/// It runs one flow. The flow starts at the best point of an earlier search. Without an earlier
/// search, it starts at `start` if the seed is 1; for any other seed, at the first of uniformly
/// random postures that has a value. CVODE integrates the flow over intervals of growing length.
/// Between intervals, the coordinates that must stay at a bound are chosen again. The flow ends
/// when it stands still (an interval gains less than 1e-10 of the value), where it meets postures
/// without a value, where it chatters along a kink, or when the budget is used. It finds only the
/// maximum uphill from its start, and may stop on a ridge.
class Nullspace final : public Search {
 public:
  SearchResult maximize(Objective& objective, const SearchOptions& options) override {
    check(options, objective);
    const Box box(objective);
    SearchRun run(options);
    Probe probe(objective, options.budget, run, options.starts_wanted > 0 ? &box : nullptr);
    Eigen::VectorXd start = box.start(options.start);
    if (!options.starts.empty()) {
      start = options.starts.front().theta_r;
    } else if (options.seed != 1) {
      Random random(options.seed, RandomUse::kSample, 0);
      do {
        for (int i = 0; i < start.size(); ++i)
          start[i] = random.uniform(objective.lower()[i], objective.upper()[i]);
      } while (probe.left() > 0 && probe.evaluate(start) == -kInfinity);
    }
    follow(probe, objective, start);
    return make_result(probe.take(), box, options, run);
  }

 private:
  static constexpr double kFirstReach = 1e-3;  // of the flow, at its first speed [rad or m]
  static constexpr double kStill = 1e-10;      // gain of an interval, relative
  static constexpr long kStepsPerInterval = 500;

  static void follow(Probe& probe, const Objective& objective, const Eigen::VectorXd& start) {
    Flow flow(probe, objective, start);
    double speed = flow.choose();
    if (speed == 0) return;
    double length = kFirstReach / speed;
    OdeSolution trajectory;
    IntegratorOptions options;
    options.relative_tolerance = 1e-6;
    options.absolute_tolerance = 1e-8;
    options.max_steps = kStepsPerInterval;
    const std::unique_ptr<Integrator> integrator = make_cvode();
    while (speed > 0 && std::isnormal(length)) {
      const double before = probe.found().best.value;
      const Status status =
          integrator->integrate(flow, options, std::array{0.0, length}, trajectory);
      if (trajectory.t.size() < 2) return;
      flow.move_to(trajectory.y.back(), trajectory.root);
      speed = flow.choose();
      const double gain = probe.found().best.value - before;
      const bool still = trajectory.root < 0 && gain <= kStill * std::abs(before);
      if (status != Status::kReached || still) return;
      length *= 2;
    }
  }
};

}  // namespace

std::unique_ptr<Search> make_nullspace() { return std::make_unique<Nullspace>(); }

}  // namespace maxwrench
