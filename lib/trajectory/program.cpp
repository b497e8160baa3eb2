#include "lib/trajectory/program.h"

#include <algorithm>

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

/// The program of an instant in a scenario.
WrenchProgram block_of(const Problem& problem, const MotionScenario& scenario, const Matrix6Xd& W,
                       const Eigen::VectorXd& c_w) {
  WrenchProgram program;
  const Eigen::Index k = W.cols(), n = problem.robot.velocities();
  program.actuation = scenario.actuation;
  program.W = W;
  program.C_2.resize(6, 0);
  program.c_w = c_w;
  program.w_min.setConstant(k, -kInfinity);
  program.w_max.setConstant(k, kInfinity);
  program.JtW.setZero(n, k);
  program.tau_d.setZero(n);
  return program;
}

/// How far the wrenches have turned since the start.
Eigen::Matrix3d turn_of(const MotionTask& task, const Eigen::Matrix3d& back,
                        const Instant& instant) {
  return task.c_turns ? Eigen::Matrix3d(instant.end_effector.R * back)
                      : Eigen::Matrix3d::Identity();
}

/// The lags of all thrusters with a range, T over the time between instants. From no efforts at the
/// start, the first instant reaches u_max/(1 + lag).
void set_lags(const Problem& problem, const MotionTask& task, const SchemeMaps& maps, int skipped,
              TrajectoryProgram& program) {
  const auto thrusters = static_cast<Eigen::Index>(problem.robot.thrusters.size());
  const auto lag = [&](int from) {
    const auto at = static_cast<std::size_t>(from);
    return task.thruster_lag / (maps.t[at + 1] - maps.t[at]);
  };
  program.lag.setZero(program.du_max.rows(), program.du_max.cols());
  for (int i = 0; i + 1 < program.size(); ++i) {
    const int place = i % program.length();
    if (place + 1 == program.length()) continue;
    const Zonotope& set = *program.instants[static_cast<std::size_t>(i)].actuation;
    for (Eigen::Index j = 0; j < thrusters; ++j) {
      if (set.u_min[j] < set.u_max[j]) program.lag(j, i) = lag(place + skipped);
    }
  }
  if (!maps.starts || task.start != Start::kZero) return;
  const Zonotope& set = problem.robot.actuation;
  const double share = 1 / (1 + lag(0));
  program.first_min.head(thrusters) =
      program.first_min.head(thrusters).cwiseMax(share * set.u_min.head(thrusters));
  program.first_max.head(thrusters) =
      program.first_max.head(thrusters).cwiseMin(share * set.u_max.head(thrusters));
}

}  // namespace

bool start_is_block(const MotionTask& task, const SchemeMaps& maps) {
  return maps.starts && (task.start == Start::kStatic || task.start == Start::kRest);
}

TrajectoryProgram make_trajectory_program(const Problem& problem, const MotionTask& task,
                                          const std::vector<MotionScenario>& scenarios,
                                          const SchemeMaps& maps) {
  const bool block = start_is_block(task, maps);
  const int skipped = maps.starts && !block ? 1 : 0;
  const int length = maps.instants() - skipped, m = problem.robot.actuators();
  const int N = length * static_cast<int>(scenarios.size());
  TrajectoryProgram program;
  program.scenarios = static_cast<int>(scenarios.size());
  program.common = task.has_factor();
  program.instants.reserve(static_cast<std::size_t>(N));
  for (const MotionScenario& scenario : scenarios) {
    const WrenchProgram at = block_of(problem, scenario, scenario.W, scenario.c_w);
    program.instants.insert(program.instants.end(), static_cast<std::size_t>(length), at);
  }
  program.du_max = Eigen::MatrixXd::Constant(m, std::max(N - 1, 0), kInfinity);
  program.first_min = scenarios.front().actuation->u_min;
  program.first_max = scenarios.front().actuation->u_max;
  if (scenarios.size() > 1) {  // each scenario has its own limits beside these
    program.first_min.setConstant(-kInfinity);
    program.first_max.setConstant(kInfinity);
  }
  const auto limit = [&](int from) -> Eigen::VectorXd {
    const auto at = static_cast<std::size_t>(from);
    return problem.robot.u_rate_max * (maps.t[at + 1] - maps.t[at]);
  };
  for (WrenchProgram& at : program.instants) {
    if (!program.common) break;
    at.c_w.setOnes();
    if (task.payload) at.w_min.setZero();  // a mass
  }
  for (int i = 0; task.rates && i + 1 < N; ++i) {
    const int place = i % length;
    if (place + 1 < length) program.du_max.col(i) = limit(place + skipped);
  }
  if (task.thruster_lag > 0) set_lags(problem, task, maps, skipped, program);
  if (block) {
    for (std::size_t s = 0; s < scenarios.size(); ++s) {
      WrenchProgram& start = program.instants[s * static_cast<std::size_t>(length)];
      const bool hold = scenarios[s].c_w.isZero(0);
      const Matrix6Xd W = scenarios[s].choice.c;
      start = block_of(problem, scenarios[s], hold ? Matrix6Xd(6, 0) : W,
                       Eigen::VectorXd::Ones(hold ? 0 : 1));
      if (problem.scenarios.empty()) start.c_w = W.transpose() * problem.c;
      start.w_min.setZero();
      start.w_max.setZero();
    }
    program.first_elastic = 1;
  } else if (maps.starts && task.start == Start::kZero && task.rates) {
    program.first_min = program.first_min.cwiseMax(-limit(0));
    program.first_max = program.first_max.cwiseMin(limit(0));
  }
  return program;
}

void set_instants(const Problem& problem, const MotionTask& task,
                  const std::vector<MotionScenario>& scenarios, const SchemeMaps& maps,
                  std::vector<Instant>& instants, TrajectoryProgram& program) {
  const auto length = static_cast<std::size_t>(program.length());
  const std::size_t skipped = instants.size() - length;
  const Eigen::Matrix3d back = maps.x.front().pose.R.transpose();
  for (std::size_t i = 0; i < instants.size(); ++i) {
    Instant& instant = instants[i];
    const Eigen::Matrix3d turn = turn_of(task, back, instant);
    if (task.has_factor()) {
      instant.c = factored_wrench(problem.robot, task, instant.t, maps.x[i]);
    } else {
      instant.c = rotated(turn, scenarios.front().choice.c);
    }
    if (i < skipped) continue;
    const bool start = i == 0 && start_is_block(task, maps);
    for (std::size_t s = 0; s < scenarios.size(); ++s) {
      WrenchProgram& block = program.instants[s * length + i - skipped];
      if (task.has_factor()) {
        set_block(instant, Matrix6Xd(instant.c), block);
      } else if (start) {
        set_block(instant,
                  Matrix6Xd(rotated(turn, scenarios[s].choice.c)).leftCols(block.columns()), block);
      } else {
        set_block(instant, rotated(turn, scenarios[s].W), block);
      }
    }
  }
}

void read_efforts(const Problem& problem, const MotionTask& task, const TrajectoryProgram& program,
                  const TrajectorySolution& solution, const MotionScenario& scenario, int number,
                  std::vector<Instant>& instants) {
  const auto length = static_cast<std::size_t>(program.length());
  const std::size_t skipped = instants.size() - length;
  const std::size_t first = static_cast<std::size_t>(number) * length;
  const bool list = !problem.scenarios.empty();
  const Eigen::Matrix3d back = instants.front().end_effector.R.transpose();
  for (std::size_t i = 0; list && !task.has_factor() && i < instants.size(); ++i) {
    instants[i].c = rotated(turn_of(task, back, instants[i]), scenario.choice.c);
  }
  for (std::size_t i = 0; i < length; ++i) {
    Instant& instant = instants[i + skipped];
    const Eigen::VectorXd& w = solution.w[first + i];
    instant.u = solution.u.col(static_cast<Eigen::Index>(first + i));
    instant.h.noalias() = program.instants[first + i].W * w;
    if (program.common || list) instant.factor = w.size() > 0 ? w[0] : 0;
  }
  if (skipped == 0) return;
  Instant& start = instants.front();
  start.h.setZero();
  if (task.start == Start::kFree) {
    start.u = solution.u.col(static_cast<Eigen::Index>(first));
  } else {
    start.u = Eigen::VectorXd::Zero(problem.robot.actuators());
  }
}

}  // namespace maxwrench
