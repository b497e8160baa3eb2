#include "lib/scenario/ball_across.h"

#include <algorithm>

namespace maxwrench {
namespace {

/// Wrenches of an unbounded set are cut here [N, N m]. Ends above a tenth of it count as none.
constexpr double kCut = 1e7;
/// The largest number of programs of one scenario; a polygon of 12 actuators needs a dozen.
constexpr int kMostPrograms = 1000;

}  // namespace

bool BallAcross::supports(const ScenarioList& list) {
  return list.ball && list.ball->E.cols() <= 2 &&
         std::all_of(list.wrenches.begin(), list.wrenches.end(),
                     [](const ScenarioWrench& wrench) { return wrench.c.isZero(0); });
}

BallAcross::BallAcross(const Problem& problem, Wrench wrench)
    : list_(problem.scenarios),
      program_(problem, wrench, static_cast<int>(problem.scenarios.ball->E.cols())) {}

Status BallAcross::find(ScenarioPosture& at, ScenarioChoice& choice, double most,
                        WrenchSolver& solver) {
  iterations = 0;
  program_.write(at, choice);
  const bool line = list_.ball->E.cols() == 1;
  const Status status = line ? find_on_line(solver) : find_in_plane(most, solver);
  choice.c = normal_[0] * at.ball_axis(0);
  if (!line) choice.c += normal_[1] * at.ball_axis(1);
  return status;
}

/// max d'z over P: its value is `result.beta`. kUnbounded leaves `point` as it is.
Status BallAcross::support(const Eigen::Vector2d& d, WrenchSolver& solver, Eigen::Vector2d& point) {
  solver.solve(program_.aim_along(d), false, result);
  iterations += result.iterations;
  if (result.status != Status::kOptimal) return result.status;
  point[0] = result.w[0];
  point[1] = list_.ball->E.cols() > 1 ? result.w[1] : 0;
  return Status::kOptimal;
}

Status BallAcross::find_on_line(WrenchSolver& solver) {
  high = kInfinity;
  for (const double side : {1.0, -1.0}) {
    Eigen::Vector2d point = Eigen::Vector2d::Zero();
    const Eigen::Vector2d d(side, 0);
    const Status status = support(d, solver, point);
    if (status == Status::kUnbounded) continue;
    if (status != Status::kOptimal) return status;
    if (!(result.beta < high)) continue;
    high = result.beta;
    normal_ = d;
  }
  return high < kInfinity ? Status::kOptimal : Status::kUnbounded;
}

/// If P is unbounded along one of the axes, it is cut; else it is bounded.
Status BallAcross::find_in_plane(double most, WrenchSolver& solver) {
  double cut = kInfinity;
  const double farthest = kCut / list_.ball->radius;
  int programs = 0;
  for (edge_.start(); edge_.asks();) {
    if (edge_.inner() >= most) break;
    if (++programs > kMostPrograms)
      return result.conclude(Status::kNumericalError, "too many edges");
    Eigen::Vector2d point = Eigen::Vector2d::Zero();
    const Status status = support(edge_.direction(), solver, point);
    if (status == Status::kUnbounded && cut == kInfinity) {
      cut = farthest;
      program_.cut(cut);
      edge_.start();
      continue;
    }
    if (status != Status::kOptimal) return status;
    edge_.answer(result.beta, point);
  }
  high = edge_.value();
  normal_ = edge_.normal();
  if (cut < kInfinity && high > cut / 10) return Status::kUnbounded;
  return Status::kOptimal;
}

}  // namespace maxwrench
