#include "lib/trajectory/program.h"

#include "lib/math/rotated.h"
#include "lib/trajectory/carried.h"

namespace maxwrench {
namespace {

/// Sets W, tau_d and J'W of one instant, as `set_posture` does for a posture.
void set_block(const Instant& instant, const Matrix6Xd& W, WrenchProgram& block) {
  block.W = W;
  block.tau_d = instant.tau_d;
  block.JtW.noalias() = instant.J.transpose().lazyProduct(W);
}

}  // namespace

bool start_is_block(const MotionTask& task, const SchemeMaps& maps) {
  return maps.starts && (task.start == Start::kStatic || task.start == Start::kRest);
}

TrajectoryProgram make_trajectory_program(const Problem& problem, const MotionTask& task,
                                          Wrench wrench, const SchemeMaps& maps) {
  const bool block = start_is_block(task, maps);
  const int skipped = maps.starts && !block ? 1 : 0;
  const int N = maps.instants() - skipped, m = problem.robot.actuators();
  TrajectoryProgram program;
  program.instants.assign(static_cast<std::size_t>(N), make_wrench_program(problem, wrench));
  program.du_max = Eigen::MatrixXd::Constant(m, std::max(N - 1, 0), kInfinity);
  program.first_min = problem.robot.actuation.u_min;
  program.first_max = problem.robot.actuation.u_max;
  const auto limit = [&](int from) -> Eigen::VectorXd {
    const auto at = static_cast<std::size_t>(from);
    return problem.robot.u_rate_max * (maps.t[at + 1] - maps.t[at]);
  };
  program.common = task.has_factor();
  for (WrenchProgram& at : program.instants) {
    if (!program.common) break;
    at.c_w.setOnes();
    if (task.payload) at.w_min.setZero();  // a mass
  }
  if (task.rates) {
    for (int i = 0; i + 1 < N; ++i) program.du_max.col(i) = limit(i + skipped);
  }
  if (block) {
    WrenchProgram& start = program.instants.front();
    start = make_wrench_program(problem, Wrench::kPure);
    start.w_min.setZero();
    start.w_max.setZero();
    program.first_elastic = 1;
  } else if (maps.starts && task.start == Start::kZero && task.rates) {
    program.first_min = program.first_min.cwiseMax(-limit(0));
    program.first_max = program.first_max.cwiseMin(limit(0));
  }
  return program;
}

void set_instants(const Problem& problem, const MotionTask& task, Wrench wrench,
                  const SchemeMaps& maps, std::vector<Instant>& instants,
                  TrajectoryProgram& program) {
  const std::size_t skipped = instants.size() - program.instants.size();
  const Eigen::Matrix3d back = maps.x.front().pose.R.transpose();
  const auto turn = [&](const Instant& instant) -> Eigen::Matrix3d {
    return task.c_turns ? Eigen::Matrix3d(instant.end_effector.R * back)
                        : Eigen::Matrix3d::Identity();
  };
  const Matrix6Xd own = wrench == Wrench::kPure ? Matrix6Xd(problem.c) : problem.W_any;
  for (std::size_t i = 0; i < instants.size(); ++i) {
    Instant& instant = instants[i];
    if (task.has_factor()) {
      instant.c = factored_wrench(problem.robot, task, instant.t, maps.x[i]);
      set_block(instant, Matrix6Xd(instant.c), program.instants[i]);
      continue;
    }
    instant.c = rotated(turn(instant), problem.c);
    if (i < skipped) continue;
    const bool start = i == 0 && start_is_block(task, maps);
    set_block(instant, start ? Matrix6Xd(instant.c) : rotated(turn(instant), own),
              program.instants[i - skipped]);
  }
}

void read_efforts(const Problem& problem, const MotionTask& task, const TrajectoryProgram& program,
                  const TrajectorySolution& solution, std::vector<Instant>& instants) {
  const std::size_t skipped = instants.size() - program.instants.size();
  for (std::size_t i = 0; i < program.instants.size(); ++i) {
    Instant& instant = instants[i + skipped];
    instant.u = solution.u.col(static_cast<Eigen::Index>(i));
    instant.h.noalias() = program.instants[i].W * solution.w[i];
    if (program.common) instant.factor = solution.w[i][0];
  }
  if (skipped == 0) return;
  Instant& start = instants.front();
  start.h.setZero();
  if (task.start == Start::kFree) {
    start.u = solution.u.col(0);
  } else {
    start.u = Eigen::VectorXd::Zero(problem.robot.actuators());
  }
}

}  // namespace maxwrench
