#include "lib/trajectory/window_evaluator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "lib/trajectory/clearance.h"
#include "lib/trajectory/limits.h"
#include "lib/trajectory/program.h"
#include "lib/trajectory/workspace.h"

namespace maxwrench {
namespace {

constexpr double kNoMultiplierOfWindow = 1e-7;  // smaller ones are rounding of an ipm, as prices

SchemeMaps empty_maps(Eigen::Index instants, Eigen::Index columns) {
  SchemeMaps maps;
  for (Eigen::MatrixXd* rows : {&maps.P, &maps.V, &maps.A}) rows->setZero(instants, columns);
  for (Eigen::MatrixXd* rows : {&maps.speed, &maps.place, &maps.zero}) rows->resize(0, columns);
  // Differences of dependent joints between columns, which are no knots, have no meaning.
  maps.knot_at.assign(static_cast<std::size_t>(columns), 0);
  maps.moves.setOnes(instants);
  return maps;
}

/// Weights of the four control points of an interval at its share s, and their derivatives by s.
std::array<std::array<double, 4>, 3> basis(double s) {
  const double r = 1 - s;
  return {{{r * r * r / 6, (3 * s * s * s - 6 * s * s + 4) / 6, (3 * r * r * r - 6 * r * r + 4) / 6,
            s * s * s / 6},
           {-r * r / 2, (3 * s * s - 4 * s) / 2, (4 * r - 3 * r * r) / 2, s * s / 2},
           {r, 3 * s - 2, 1 - 3 * s, s}}};
}

}  // namespace

SchemeMaps make_resting_instant(const MotionTask& task, double t) {
  SchemeMaps maps = empty_maps(1, 1);
  maps.P(0, 0) = 1;
  maps.t.assign(1, t);
  maps.x.assign(1, task.path.at(t));
  return maps;
}

SchemeMaps make_spline_window(const MotionTask& task, int first, int last) {
  const int per = task.instants_per_interval;
  const int skipped = first == 0 ? 0 : 1;  // the instant of knot `first`
  const int column_0 = first == 0 ? 0 : first - 1;
  SchemeMaps maps = empty_maps((last - first) * per + 1 - skipped, last - column_0 + 1);
  maps.before = first == 0 ? 0 : 3;
  maps.dt = task.T / (task.k - 1);
  for (int n = 0; n < maps.P.rows(); ++n) {
    const int step = n + skipped;
    const int interval = std::min(first + step / per, last - 1);
    const double s = static_cast<double>(first * per + step - interval * per) / per;
    const auto weights = basis(s);
    for (int j = 0; j < 4; ++j) {
      int point = interval - 1 + j;
      if (point < 0) point = -point;
      if (point > last) point = 2 * last - point;
      const auto at = static_cast<std::size_t>(j);
      maps.P(n, point - column_0) += weights[0][at];
      maps.V(n, point - column_0) += weights[1][at] / maps.dt;
      maps.A(n, point - column_0) += weights[2][at] / (maps.dt * maps.dt);
    }
    maps.t.push_back(maps.dt * (first + static_cast<double>(step) / per));
    maps.x.push_back(task.path.at(maps.t.back()));
  }
  return maps;
}

WindowEvaluator::WindowEvaluator(const Problem& problem, Wrench wrench,
                                 const TrajectorySolverMaker& make, bool check_collision,
                                 SchemeMaps maps)
    : problem_(problem),
      task_(task_of(problem)),
      scenarios_(motion_scenarios(problem, wrench)),
      check_collision_(check_collision && problem.robot.collision != nullptr),
      motion_(problem, std::move(maps)),
      turned_from_start_(motion_.maps()),
      program_(make_trajectory_program(problem, task_, scenarios_, motion_.maps())),
      solver_(make()),
      links_(problem.robot) {
  // The wrench of a factor is a function of the motion at each instant, and is not turned.
  if (!task_.has_factor()) turned_from_start_.x.front() = task_.path.at(0);
}

void WindowEvaluator::set_time(double t) {
  const PathPoint x = task_.path.at(t);
  motion_.set_instant(0, t, x);
  turned_from_start_.t.front() = t;
  if (task_.has_factor()) turned_from_start_.x.front() = x;
}

double WindowEvaluator::evaluate(const Eigen::MatrixXd& Q) {
  motion_.evaluate(Q, instants_);
  if (!motion_violation(problem_, motion_, instants_).empty()) return -kInfinity;
  set_instants(problem_, task_, scenarios_, turned_from_start_, instants_, program_);
  program_.rho = kInfinity;
  solver_->solve(program_, solution_);
  if (solution_.status != Status::kOptimal) {
    program_.rho = kElasticWeight;
    solver_->solve(program_, solution_);
  }
  return solution_.status == Status::kOptimal ? solution_.value - solution_.price : -kInfinity;
}

bool WindowEvaluator::is_knot(int instant) const {
  if (maps().dt == 0) return true;
  const double knot = maps().t[static_cast<std::size_t>(instant)] / maps().dt;
  return std::abs(knot - std::round(knot)) < 1e-6;
}

bool WindowEvaluator::collides() {
  for (int i = 0; check_collision_ && i < maps().instants(); ++i) {
    if (!is_knot(i)) continue;
    links_.set_joints(instants_[static_cast<std::size_t>(i)].q);
    if (problem_.robot.collision->colliding_pair(links_.links()) >= 0) return true;
  }
  return false;
}

const std::vector<NearPair>& WindowEvaluator::near_pairs(const Eigen::MatrixXd& Q, double within) {
  near_.clear();
  if (!check_collision_) return near_;
  motion_.visit(Q, [&](int instant, const Eigen::VectorXd& q, const Eigen::MatrixXd& slopes) {
    if (!is_knot(instant)) return;
    links_.set_joints(q);
    find_near_pairs(problem_, links_, instant, within, near_, slopes);
  });
  return near_;
}

/// Sets efforts and wrenches of the instants to those of a scenario, and the slopes about them.
void WindowEvaluator::read_scenario(int scenario) {
  read_efforts(problem_, task_, program_, solution_, scenarios_[static_cast<std::size_t>(scenario)],
               scenario, instants_);
  motion_.linearize(instants_, slopes_);
}

void WindowEvaluator::gradient(Eigen::MatrixXd& gradient) {
  gradient.setZero(maps().knots(), problem_.redundancy());
  const Eigen::Index length = program_.length();
  for (int s = 0; s < program_.scenarios; ++s) {
    lambda_ = solution_.lambda.middleCols(s * length, length);
    if (s > 0 && lambda_.isZero(0)) continue;
    read_scenario(s);
    motion_.pull_back(slopes_, lambda_, part_);
    gradient += part_;
  }
}

bool WindowEvaluator::coupled() const {
  return solution_.price > kNoMultiplierOfWindow ||
         (solution_.mu.array().abs() > kNoMultiplierOfWindow).any() ||
         (solution_.kappa.array().abs() > kNoMultiplierOfWindow).any();
}

TrajectoryProgram& WindowEvaluator::linearize() {
  bordered_ = program_;
  bordered_.rho = kElasticWeight;
  bordered_.G.resize(bordered_.instants.size());
  const Eigen::Index r = problem_.redundancy();
  const int length = program_.length();
  for (int s = 0; s < program_.scenarios; ++s) {
    read_scenario(s);
    for (int i = 0; i < length; ++i) {
      motion_.push_forward(slopes_, i, G_);
      bordered_.G[static_cast<std::size_t>(s * length + i)] =
          -G_.middleCols(maps().before * r, maps().rows() * r);
    }
  }
  dependent_rows_ = make_dependent_rows(problem_, motion_, instants_, slopes_);
  return bordered_;
}

}  // namespace maxwrench
