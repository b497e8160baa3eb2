#include "solvers/certify/trajectory/edge_program.h"

#include <algorithm>
#include <cmath>

#include "lib/trajectory/program.h"
#include "maxwrench/strategies.h"

namespace maxwrench {
namespace {

/// Second differences at edges are no bound of the derivative between them.
constexpr double kBendSafety = 1.05;
/// The most of a limit's range that a margin takes.
constexpr double kMostOfRange = 0.25;
/// Wrenches that differ by this share of the value are the same.
constexpr double kEqualWrench = 1e-9;
/// A wrench that varies along a path must be larger by this share.
constexpr double kWorthVarying = 1e-5;
/// Efforts without a limit of their rates change by at most the first of these shares of their
/// range from knot to knot, or by the next one if it costs more than `kWorthJumping` of the value.
constexpr double kSteadyShares[] = {1, 4, 16};
constexpr double kWorthJumping = 1e-5;
/// Of an interval between knots, for the dependent joints.
constexpr int kPlacesOfInterval = 8;

/// Second differences of the columns of an interval; those of its ends are those beside them.
Eigen::MatrixXd second_differences(const Eigen::MatrixXd& x) {
  Eigen::MatrixXd bends(x.rows(), x.cols());
  for (Eigen::Index edge = 0; edge < x.cols(); ++edge) {
    const Eigen::Index at = std::clamp<Eigen::Index>(edge, 1, x.cols() - 2);
    bends.col(edge) = x.col(at + 1) - 2 * x.col(at) + x.col(at - 1);
  }
  return bends;
}

/// Bounds of the third differences of the parts of an interval, from the second ones. Where drag
/// turns, the second derivative jumps by some J. That changes the third differences of a part or
/// two by J H^2 in all, compared with those two parts away. The rate of a B-spline is off by J H/4
/// at most, where the jump is at an edge, instead of a sixth of the third difference over H.
Eigen::MatrixXd third_differences(const Eigen::MatrixXd& bends) {
  const Eigen::Index parts = bends.cols() - 1;
  const Eigen::MatrixXd steps = bends.rightCols(parts) - bends.leftCols(parts);
  Eigen::MatrixXd smooth(steps.rows(), parts), jumps(steps.rows(), parts);
  for (Eigen::Index k = 0; k < parts; ++k) {
    const Eigen::ArrayXd before = steps.col(std::max<Eigen::Index>(k - 2, 0));
    const Eigen::ArrayXd here = steps.col(k), after = steps.col(std::min(k + 2, parts - 1));
    smooth.col(k) = ((before - here).abs() < (after - here).abs()).select(before, after);
    jumps.col(k) = 6.0 / 4 * (here - smooth.col(k).array()).abs();
  }
  Eigen::MatrixXd most = smooth.cwiseAbs() + jumps;
  most.rightCols(parts - 1) += jumps.leftCols(parts - 1);
  most.leftCols(parts - 1) += jumps.rightCols(parts - 1);
  return most;
}

}  // namespace

Eigen::MatrixXd dependent_places(const Problem& problem, const Eigen::MatrixXd& knots) {
  if (problem.dependent.empty()) return {};
  MotionEvaluator motion(problem, make_dense_spline(*problem.motion, kPlacesOfInterval));
  std::vector<Instant> instants;
  motion.evaluate(all_knots(*problem.motion, knots), instants);
  Eigen::MatrixXd places(problem.dependent.size(), instants.size());
  for (Eigen::Index i = 0; i < places.cols(); ++i) {
    places.col(i) = instants[static_cast<std::size_t>(i)].q(problem.dependent);
  }
  return places;
}

EdgeProgram::EdgeProgram(const Problem& problem, const Eigen::MatrixXd& knots, int parts, int t_h)
    : problem_(problem),
      parts_(parts),
      motion_(problem, make_dense_spline(*problem.motion, parts)),
      solver_(trajectory_solvers().front().make()) {
  const MotionTask& task = *problem.motion;
  const SchemeMaps& maps = motion_.maps();
  const std::vector<MotionScenario> scenarios = motion_scenarios(problem, Wrench::kPure);
  loose_ = make_trajectory_program(problem, task, scenarios, maps);
  motion_.evaluate(all_knots(task, knots), instants_);
  set_instants(problem, task, scenarios, maps, instants_, loose_);
  if (!task.impulse) return;
  const bool block = start_is_block(task, maps);
  // At rest and in balance, w_0 cannot exceed the static capability.
  if (block && task.start == Start::kStatic) loose_.instants[0].w_max.setConstant(kInfinity);
  loose_.peak = t_h * parts - (block ? 0 : 1);
}

/// Second and third differences of p within each interval between knots; at a knot the third
/// derivative of theta_r jumps. `w`: at the edges. Where w bends, y bends with it, so its
/// differences count only together with those of J'c.
void EdgeProgram::measure_bends(const Eigen::VectorXd& w) {
  const Eigen::Index edges = w.size();
  const Zonotope& set = problem_.robot.actuation;
  Eigen::MatrixXd tau(set.actuators(), edges), a(set.actuators(), edges);
  for (Eigen::Index i = 0; i < edges; ++i) {
    const Instant& at = instants_[static_cast<std::size_t>(i)];
    tau.col(i) = set.B_pinv * at.tau_d;
    a.col(i) = set.B_pinv * (at.J.transpose() * at.c);
  }
  const double H = problem_.motion->T / static_cast<double>(edges - 1);
  off_.resize(tau.rows(), edges - 1);
  rate_off_.resize(tau.rows(), edges - 1);
  for (Eigen::Index first = 0; first + 1 < edges; first += parts_) {
    const auto of_interval = [&](const auto& x) { return x.middleCols(first, parts_ + 1); };
    const Eigen::MatrixXd a_bend = second_differences(of_interval(a));
    const Eigen::MatrixXd w_bend = second_differences(of_interval(w.transpose()));
    const Eigen::MatrixXd bend =  // H^2 p_ddot
        second_differences(of_interval(tau)) + a_bend * w.segment(first, parts_ + 1).asDiagonal();
    const Eigen::MatrixXd jerk = third_differences(bend);  // H^3 p_dddot
    for (Eigen::Index k = 0; k < parts_; ++k) {
      const Eigen::Index i = first + k;
      const auto larger = [k](const Eigen::MatrixXd& x) -> Eigen::VectorXd {
        return x.col(k).cwiseAbs().cwiseMax(x.col(k + 1).cwiseAbs());
      };
      const Eigen::VectorXd a_step = (a.col(i + 1) - a.col(i)).cwiseAbs();
      const double w_step = std::abs(w[i + 1] - w[i]);
      const Eigen::VectorXd most = larger(bend) + 2 * w_step * a_step;
      off_.col(i) = kBendSafety / 8 * most;
      if (k == 0 || k + 1 == parts_) {
        rate_off_.col(i) = kBendSafety / (2 * H) * most;
      } else {
        rate_off_.col(i) =
            kBendSafety / (6 * H) *
            (jerk.col(k) + 3 * larger(w_bend)[0] * a_step + 3 * w_step * larger(a_bend));
      }
    }
  }
}

/// The limits of the whole program are tighter by the largest margin of each actuator, the rates by
/// the margin of each part.
void EdgeProgram::tighten(double slack) {
  const Zonotope& set = problem_.robot.actuation;
  program_ = loose_;
  const double H = problem_.motion->T / static_cast<double>(off_.cols());
  Eigen::VectorXd margin = off_.rowwise().maxCoeff();
  const auto thrusters = static_cast<Eigen::Index>(problem_.robot.thrusters.size());
  margin.head(thrusters) +=  // of commands
      problem_.motion->thruster_lag * rate_off_.topRows(thrusters).rowwise().maxCoeff();
  for (Eigen::Index i = 0; i < margin.size(); ++i) {
    const double range = set.u_max[i] - set.u_min[i];
    if (!std::isfinite(range)) continue;
    margin[i] = std::min(margin[i] + slack * range, kMostOfRange * range);
  }
  tight_ = with_limits(set, set.u_min + margin, set.u_max - margin);
  for (WrenchProgram& at : program_.instants) at.actuation = &tight_;
  program_.first_min = tight_.u_min;
  program_.first_max = tight_.u_max;
  const Eigen::Index skipped = off_.cols() - program_.du_max.cols();
  for (Eigen::Index i = 0; i < program_.du_max.cols(); ++i) {
    for (Eigen::Index k = 0; k < off_.rows(); ++k) {
      double& most = program_.du_max(k, i);
      if (!std::isfinite(most)) continue;
      most =
          std::max(most * (1 - slack) - H * rate_off_(k, i + skipped), (1 - kMostOfRange) * most);
    }
  }
}

bool EdgeProgram::exerts_equally(const TrajectorySolution& solution) const {
  for (std::size_t i = 0; i < solution.w.size(); ++i) {
    const double w = solution.w[i][0] * program_.instants[i].c_w[0];
    if (!(std::abs(w - solution.value) <= kEqualWrench * (1 + std::abs(solution.value)))) {
      return false;
    }
  }
  return true;
}

EdgeEfforts EdgeProgram::read(const TrajectorySolution& solution) const {
  EdgeEfforts efforts;
  static_cast<Verdict&>(efforts) = solution;
  const Eigen::Index edges = static_cast<Eigen::Index>(instants_.size());
  const Eigen::Index blocks = program_.size();
  if (solution.status == Status::kInfeasible) {
    Eigen::Index worst = 0;
    if (solution.lambda.cols() == blocks) {
      solution.lambda.colwise().lpNorm<Eigen::Infinity>().maxCoeff(&worst);
    }
    efforts.t = instants_[static_cast<std::size_t>(worst + edges - blocks)].t;
  }
  if (solution.status != Status::kOptimal) return efforts;
  efforts.value = solution.value;
  efforts.y.resize(solution.u.rows(), edges);
  efforts.y.rightCols(blocks) = solution.u;
  if (blocks < edges) efforts.y.col(0) = solution.u.col(0);
  const Zonotope& set = problem_.robot.actuation;
  for (Eigen::Index i = 0; i < efforts.y.rows(); ++i) {  // exactly, without a column in B
    if (set.u_min[i] == set.u_max[i]) efforts.y.row(i).setConstant(set.u_min[i]);
  }
  if (!problem_.motion->impulse && exerts_equally(solution)) return efforts;
  efforts.w.resize(edges);
  for (Eigen::Index i = 0; i < blocks; ++i) {
    const auto at = static_cast<std::size_t>(i);
    efforts.w[i + edges - blocks] = solution.w[at][0] * program_.instants[at].c_w[0];
  }
  if (!problem_.motion->impulse) {
    efforts.value = efforts.w.minCoeff();
    return efforts;
  }
  if (blocks < edges) efforts.w[0] = efforts.w[1];
  if (problem_.motion->start == Start::kStatic) efforts.w[0] = std::max(efforts.w[0], 0.0);
  if (problem_.motion->start == Start::kRest) efforts.w[0] = 0;
  efforts.value = efforts.w[program_.peak + edges - blocks];
  return efforts;
}

/// Along a path the same wrench throughout is simpler than one that varies, if it is not less.
EdgeEfforts EdgeProgram::solve_program() {
  TrajectorySolution solution, equal;
  solver_->solve(program_, solution);
  if (solution.status != Status::kOptimal || problem_.motion->impulse || exerts_equally(solution)) {
    return read(solution);
  }
  program_.common = true;
  solver_->solve(program_, equal);
  program_.common = false;
  const double enough = solution.value - kWorthVarying * (1 + std::abs(solution.value));
  return read(equal.status == Status::kOptimal && equal.value >= enough ? equal : solution);
}

/// In an impulse only the peak has an objective. Without rates the wrench beside it could be any
/// other one, and u(t) would leave its limits by O(H) between them.
EdgeEfforts EdgeProgram::solve_steadily() {
  const EdgeEfforts& loose = most();
  if (!problem_.motion->impulse || loose.status != Status::kOptimal) return loose;
  const Zonotope& set = problem_.robot.actuation;
  const Eigen::VectorXd step = (set.u_max - set.u_min) / parts_;
  for (const double share : kSteadyShares) {
    const Eigen::MatrixXd most = (share * step).replicate(1, loose_.du_max.cols());
    program_.du_max = (loose_.du_max.array() < kInfinity).select(loose_.du_max, most);
    if (program_.du_max == loose_.du_max) break;
    EdgeEfforts steady = solve_program();
    const double enough = loose.value - kWorthJumping * (1 + std::abs(loose.value));
    if (steady.status != Status::kOptimal || steady.value < enough) continue;
    loose_.du_max = program_.du_max;
    return steady;
  }
  return loose;
}

const EdgeEfforts& EdgeProgram::most() {
  if (!most_) {
    program_ = loose_;
    most_ = solve_program();
  }
  return *most_;
}

EdgeEfforts EdgeProgram::solve(double slack) {
  if (off_.size() == 0) {
    const EdgeEfforts steady = solve_steadily();
    const auto edges = static_cast<Eigen::Index>(instants_.size());
    measure_bends(steady.w.size() > 0 ? steady.w : Eigen::VectorXd::Constant(edges, steady.value));
  }
  tighten(slack);
  return solve_program();
}

}  // namespace maxwrench
