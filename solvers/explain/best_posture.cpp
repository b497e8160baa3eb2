#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/math/decompositions.h"
#include "lib/robot/chain.h"
#include "lib/search/facet_program.h"
#include "solvers/explain/parts.h"
#include "solvers/lp/makers.h"
#include "solvers/solve/format.h"
#include "solvers/solve/method.h"

namespace maxwrench {
namespace {

/// A row within this share of half its width of its bound is active.
constexpr double kActiveRow = 1e-6;
/// The largest residual of the multipliers, relative to 1 + |beta|.
constexpr double kStationary = 1e-6;
/// A multiplier below this share of the largest is rounding.
constexpr double kLeastRate = 1e-9;

/// A side of a row that is active: sign * gradient points out of what is allowed.
struct ActiveSide {
  /// What the row is: facet pair, clearance, dependent joint, coordinate of theta_r or of w.
  enum class Kind { kFacet, kClearance, kJoint, kThetaR, kForce } kind;
  std::size_t index;  ///< among its kind
  double sign;        ///< 1 at the upper bound, -1 at the lower one
  Eigen::VectorXd gradient;
};

/// The program at a best posture: the sides that are active, and c.
class BestPosture {
 public:
  BestPosture(const Answer& answer, FacetProgram& program)
      : answer_(answer), task_(*answer.task), program_(program) {}

  /// False if the program does not exist at the posture.
  bool load() {
    const Eigen::VectorXd& theta_r = answer_.posture.theta_r;
    const Eigen::VectorXd& w = answer_.capability.w;
    if (!choose_solution(theta_r) || !program_.evaluate(theta_r, w)) return false;
    program_.linearize();
    const auto r = theta_r.size(), k = w.size();
    objective_ = Eigen::VectorXd::Zero(r + k);
    objective_.tail(k) = program_.c_w();
    for (Eigen::Index row = 0; row < program_.rows().size(); ++row) {
      Eigen::VectorXd gradient(r + k);
      gradient << program_.by_theta_r().row(row).transpose(), program_.by_w().row(row).transpose();
      const auto [kind, index] = place_of(row);
      add(kind, index, program_.rows()[row], program_.row_min()[row], program_.row_max()[row],
          program_.row_unit()[row], gradient);
    }
    for (Eigen::Index i = 0; i < r + k; ++i) {
      const bool of_theta_r = i < r;
      const auto j = of_theta_r ? i : i - r;
      const double low = of_theta_r ? task_.theta_r_min[j] : program_.w_min()[j];
      const double high = of_theta_r ? task_.theta_r_max[j] : program_.w_max()[j];
      add(of_theta_r ? Kind::kThetaR : Kind::kForce, static_cast<std::size_t>(j),
          of_theta_r ? theta_r[j] : w[j], low, high, 1, Eigen::VectorXd::Unit(r + k, i));
    }
    return true;
  }

  /// Fills residual, uniqueness and the rates.
  void solve(BestPostureRates& best) {
    best.residual = objective_.lpNorm<Eigen::Infinity>();
    if (sides_.empty()) return;
    Eigen::MatrixXd A(objective_.size(), sides_.size());
    Eigen::Index column = 0;
    for (const ActiveSide& side : sides_) A.col(column++) = side.sign * side.gradient;
    const Eigen::VectorXd mu = multipliers(A);
    best.residual = (objective_ - A * mu).lpNorm<Eigen::Infinity>();
    best.unique = split(A).range.cols() == A.cols();
    if (best.residual <= kStationary * (1 + std::abs(answer_.beta()))) fill_rates(mu, best);
  }

 private:
  using Kind = ActiveSide::Kind;

  /// The IK solution of the answer: that with its value.
  bool choose_solution(const Eigen::VectorXd& theta_r) {
    int nearest = -1;
    double least = kInfinity;
    Eigen::VectorXd w;
    const int solutions = program_.ik_solutions(theta_r);
    for (int i = 0; i < solutions; ++i) {
      if (!program_.set_out(theta_r, i, w)) continue;
      const double away = std::abs(program_.c_w().dot(w) - answer_.beta());
      if (!(away < least)) continue;
      least = away;
      nearest = i;
    }
    return nearest >= 0 && program_.set_out(theta_r, nearest, w);
  }

  std::pair<Kind, std::size_t> place_of(Eigen::Index row) const {
    auto index = static_cast<std::size_t>(row);
    const auto facets = static_cast<std::size_t>(program_.force_rows());
    if (index < facets) return {Kind::kFacet, index};
    index -= facets;
    if (index < program_.pairs().size()) return {Kind::kClearance, index};
    return {Kind::kJoint, index - program_.pairs().size()};
  }

  void add(Kind kind, std::size_t index, double value, double low, double high, double unit,
           const Eigen::VectorXd& gradient) {
    if (high - value <= kActiveRow * unit) sides_.push_back({kind, index, 1, gradient});
    if (value - low <= kActiveRow * unit) sides_.push_back({kind, index, -1, gradient});
  }

  /// mu >= 0 with the least sum |c - A mu|_1.
  Eigen::VectorXd multipliers(const Eigen::MatrixXd& A) const {
    const Eigen::Index n = A.rows(), count = A.cols();
    Eigen::MatrixXd all(n, count + 2 * n);
    all << A, Eigen::MatrixXd::Identity(n, n), -Eigen::MatrixXd::Identity(n, n);
    LinearProgram lp;
    lp.A = all.sparseView();
    lp.A.makeCompressed();
    lp.b = objective_;
    lp.c = Eigen::VectorXd::Zero(count + 2 * n);
    lp.c.tail(2 * n).setConstant(-1);
    lp.l = Eigen::VectorXd::Zero(count + 2 * n);
    lp.u = Eigen::VectorXd::Constant(count + 2 * n, kInfinity);
    LpSolution solution;
    make_simplex()->solve(lp, solution);
    if (solution.status != Status::kOptimal) return Eigen::VectorXd::Zero(count);
    return solution.x.head(count).cwiseMax(0);
  }

  void fill_rates(const Eigen::VectorXd& mu, BestPostureRates& best) {
    const Zonotope& set = task_.robot.actuation;
    Eigen::VectorXd lower = Eigen::VectorXd::Zero(set.actuators()), upper = lower;
    const double least = kLeastRate * mu.lpNorm<Eigen::Infinity>();
    std::vector<LimitRate> others;
    Eigen::Index j = 0;
    for (const ActiveSide& side : sides_) {
      const double multiplier = mu[j++];
      if (!(multiplier > least)) continue;
      if (side.kind != Kind::kFacet) {
        others.push_back(limit_of(side, multiplier));
        continue;
      }
      const FacetSide facet = program_.facet(static_cast<Eigen::Index>(side.index));
      const Eigen::VectorXd along =
          side.sign * facet.sign * multiplier * (set.B.transpose() * set.N.col(facet.pair));
      const Eigen::VectorXd out = along.cwiseMax(0), in = along.cwiseMin(0);
      const auto rates = [&](std::size_t tied, LimitSide which) -> Eigen::VectorXd {
        const Eigen::VectorXd& part = which == LimitSide::kUpper ? out : in;
        return part.cwiseProduct(share_of(facet, tied, which));
      };
      upper += rates(0, LimitSide::kUpper);
      lower += rates(0, LimitSide::kLower);
      // Limits that bound the same facet may differ in which actuators are lost.
      for (std::size_t tied = 1; tied < facet.limits.size(); ++tied) {
        for (const LimitSide which : {LimitSide::kUpper, LimitSide::kLower}) {
          const double apart = (rates(tied, which) - rates(0, which)).lpNorm<Eigen::Infinity>();
          best.unique = best.unique && apart <= kLeastRate * along.lpNorm<Eigen::Infinity>();
        }
      }
    }
    const double smallest = kLeastRate * std::max(upper.maxCoeff(), -lower.minCoeff());
    for (Eigen::Index i = 0; i < upper.size(); ++i) {
      const auto add_rate = [&](LimitSide which, double limit, double rate) {
        if (!(std::abs(rate) > smallest) || !std::isfinite(limit)) return;
        best.limits.push_back(
            {actuator_name(task_.robot, i), actuator_unit(task_.robot, i), which, limit, rate});
      };
      add_rate(LimitSide::kLower, set.u_min[i], lower[i]);
      add_rate(LimitSide::kUpper, set.u_max[i], upper[i]);
    }
    std::stable_sort(best.limits.begin(), best.limits.end(), [](const auto& a, const auto& b) {
      return std::abs(a.rate * a.limit) > std::abs(b.rate * b.limit);
    });
    best.limits.insert(best.limits.end(), others.begin(), others.end());
  }

  /// By how much the limits of each actuator that bound a facet change with those of the robot: by
  /// the share that a weaker actuator keeps, and not at all where it is lost.
  Eigen::VectorXd share_of(const FacetSide& facet, std::size_t tied, LimitSide which) const {
    const auto limits = [which](const Zonotope& set) -> const Eigen::VectorXd& {
      return which == LimitSide::kUpper ? set.u_max : set.u_min;
    };
    const Eigen::VectorXd& robot = limits(task_.robot.actuation);
    Eigen::VectorXd share = Eigen::VectorXd::Ones(robot.size());
    if (facet.limits.empty()) return share;
    const auto& list = task_.scenarios.limits;
    const Zonotope& all = list.front().actuation;
    const Zonotope& left = list[static_cast<std::size_t>(facet.limits[tied])].actuation;
    for (Eigen::Index i = 0; i < robot.size(); ++i) {
      const bool lost = left.u_min[i] != all.u_min[i] || left.u_max[i] != all.u_max[i];
      if (robot[i] != 0) share[i] = lost ? 0 : limits(all)[i] / robot[i];
    }
    return share;
  }

  LimitRate limit_of(const ActiveSide& side, double multiplier) const {
    const bool upper = side.sign > 0;
    LimitRate rate{"", "m", upper ? LimitSide::kUpper : LimitSide::kLower, 0,
                   side.sign * multiplier};
    const auto i = static_cast<Eigen::Index>(side.index);
    switch (side.kind) {
      case Kind::kClearance:
        rate.name =
            "clearance of " + task_.robot.collision->pair_name(program_.pairs()[side.index]);
        break;
      case Kind::kJoint: {
        const int at = program_.following()[side.index];
        const Joint& joint = task_.robot.joints[static_cast<std::size_t>(at)];
        rate.name = "position of " + joint.name;
        rate.unit = joint.type == JointType::kRevolute ? "rad" : "m";
        rate.limit = upper ? joint.q_max : joint.q_min;
        break;
      }
      case Kind::kThetaR:
        rate.name = "position of " + task_.theta_r_name(static_cast<int>(side.index));
        rate.unit = task_.theta_r_unit(static_cast<int>(side.index));
        rate.limit = upper ? task_.theta_r_max[i] : task_.theta_r_min[i];
        break;
      case Kind::kForce:
      case Kind::kFacet:
        rate.name = contact_force_name(i - (program_.c_w().size() - task_.contact_columns()));
        rate.unit =
            contact_force_unit(task_, i - (program_.c_w().size() - task_.contact_columns()));
        rate.limit = upper ? program_.w_max()[i] : program_.w_min()[i];
        break;
    }
    return rate;
  }

  const Answer& answer_;
  const Problem& task_;
  FacetProgram& program_;
  Eigen::VectorXd objective_;
  std::vector<ActiveSide> sides_;
};

/// Why the rates of a best posture do not exist; empty: they may.
std::string without_best(const Answer& answer) {
  const Problem& task = *answer.task;
  if (answer.choice.measure != Case().measure) {
    return "the measure is " + answer.choice.measure + ", only linf_polytope has them";
  }
  if (answer.given_joints) return "all joints are given";
  if (task.redundancy() == 0) return "the task leaves no coordinate free";
  if (!has_facet_program(task, answer.choice.wrench)) {
    return task.scenarios.empty() ? "the actuators have too many facets"
                                  : "the list has no program of few facets";
  }
  return "";
}

}  // namespace

void explain_best_posture(const Answer& answer, BestPostureRates& best) {
  best.missing = without_best(answer);
  if (!best.missing.empty()) return;
  const LowerLevel lower = resolve_lower_level(*answer.task, answer.choice);
  FacetProgram program(*answer.task, answer.choice.wrench, lower.make_measure, answer.collision);
  BestPosture at(answer, program);
  if (!at.load()) {
    best.missing = "the posture has no smooth program";
    return;
  }
  at.solve(best);
  if (best.limits.empty()) {
    best.missing = fmt::format(
        "the posture is no local optimum between its limits (residual {:.1e})", best.residual);
  }
}

}  // namespace maxwrench
