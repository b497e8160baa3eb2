#include "solvers/lp/facets.h"

#include <cmath>
#include <stdexcept>

#include "solvers/lp/efforts.h"
#include "solvers/lp/simplex.h"

namespace maxwrench {
namespace {

/// A slope n'a below this share of |a| does not move along the ray.
constexpr double kSlopeTolerance = 1e-12;
/// How far [N, N m] the set may be missed by rounding, relative to the widths involved.
constexpr double kFeasibilityTolerance = 1e-9;

/// The part of the ray inside the set.
struct Interval {
  double low = -kInfinity, high = kInfinity;
  int low_pair = -1, high_pair = -1;
  int missed_pair = -1;    ///< a violated pair that the ray runs parallel to
  double missed_side = 0;  ///< 1 if its upper bound is, -1 if the lower one
};

Interval shoot(const Zonotope& set, const Eigen::VectorXd& tau, const double* a) {
  const Eigen::Index n = set.N.rows();
  double norm = 0;
  for (Eigen::Index i = 0; i < n; ++i) norm += a[i] * a[i];
  const double flat = kSlopeTolerance * std::sqrt(norm);
  Interval ray;
  for (int j = 0; j < set.facet_pairs(); ++j) {
    const double* normal = set.N.data() + j * n;
    double slope = 0;
    double value = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      slope += normal[i] * a[i];
      value += normal[i] * tau[i];
    }
    const double below = set.b_min[j] - value;
    const double above = set.b_max[j] - value;
    if (std::abs(slope) <= flat) {
      const double slack = kFeasibilityTolerance * (1 + std::abs(value));
      if (below > slack || above < -slack) {
        ray.missed_pair = j;
        ray.missed_side = below > slack ? -1 : 1;
      }
      continue;
    }
    const double enter = (slope > 0 ? below : above) / slope;
    const double leave = (slope > 0 ? above : below) / slope;
    if (enter > ray.low) {
      ray.low = enter;
      ray.low_pair = j;
    }
    if (leave < ray.high) {
      ray.high = leave;
      ray.high_pair = j;
    }
  }
  return ray;
}

class Facets : public WrenchSolver {
 public:
  void solve(const WrenchProgram& program, bool efforts, Capability& capability) override {
    if (program.columns() != 1) {
      throw std::invalid_argument("solver facets: got " + std::to_string(program.columns()) +
                                  " wrench columns, expected one (wrench pure)");
    }
    const Zonotope& set = *program.actuation;
    if (!set.has_facets) {
      throw std::invalid_argument(
          "solver facets: the actuators have too many facets to enumerate, expected another "
          "solver");
    }
    capability.iterations = 0;
    const Interval ray = shoot(set, program.tau_d, program.JtW.data());
    const bool upwards = program.c_w[0] >= 0;
    double x = upwards ? std::min(ray.high, program.w_max[0]) : std::max(ray.low, program.w_min[0]);
    const double low = std::max(ray.low, program.w_min[0]);
    const double high = std::min(ray.high, program.w_max[0]);
    if (ray.missed_pair >= 0 || low > high + kFeasibilityTolerance * (1 + std::abs(high))) {
      capability.status = Status::kInfeasible;
      capability.reason = "no actuator efforts balance the posture";
      fill_contradiction(program, ray, capability.lambda);
      return;
    }
    if (!std::isfinite(x)) {
      capability.status = Status::kUnbounded;
      capability.reason = "the wrench does not load any actuator";
      return;
    }
    fill(program, upwards ? ray.high_pair : ray.low_pair, x == (upwards ? ray.high : ray.low), x,
         capability);
    if (efforts) fill_efforts(program, *simplex_, capability);
  }

 private:
  static void fill(const WrenchProgram& program, int pair, bool facet_active, double x,
                   Capability& capability) {
    capability.status = Status::kOptimal;
    capability.reason = "";
    capability.beta = program.c_w[0] * x;
    capability.w.setConstant(1, x);
    if (facet_active) {
      const auto normal = program.actuation->N.col(pair);
      capability.lambda = normal * (-program.c_w[0] / normal.dot(program.JtW.col(0)));
    } else {
      capability.lambda.setZero(program.tau_d.size());
    }
  }

  /// y with sup {y'(B u - J'W w)} < y'tau_d: the missed pair, or the difference of the two that
  /// stop the ray before it begins, n/(n'J'W) each.
  static void fill_contradiction(const WrenchProgram& program, const Interval& ray,
                                 Eigen::VectorXd& y) {
    const Zonotope& set = *program.actuation;
    y.setZero(program.tau_d.size());
    if (ray.missed_pair >= 0) {
      y = ray.missed_side * set.N.col(ray.missed_pair);
      return;
    }
    const auto add = [&](int pair, double sign) {
      y += set.N.col(pair) * (sign / set.N.col(pair).dot(program.JtW.col(0)));
    };
    if (ray.high < program.w_max[0]) add(ray.high_pair, 1);
    if (ray.low > program.w_min[0]) add(ray.low_pair, -1);
  }

  std::unique_ptr<LpSolver> simplex_ = make_simplex();
};

}  // namespace

std::unique_ptr<WrenchSolver> make_facets() { return std::make_unique<Facets>(); }

}  // namespace maxwrench
