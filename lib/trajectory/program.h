#pragma once

#include <vector>

#include "lib/trajectory/motion_scenarios.h"
#include "lib/trajectory/scheme.h"
#include "maxwrench/problem.h"
#include "maxwrench/trajectory.h"

namespace maxwrench {

/// Weight of the slack in elastic programs, per N and N m.
inline constexpr double kElasticWeight = 100;

/// The program of a task's instants in all scenarios, before any motion is set. A start that must
/// balance (`Start::kStatic`, `kRest`) is the first block of each scenario; otherwise the first
/// block is the instant after the start.
TrajectoryProgram make_trajectory_program(const Problem& problem, const MotionTask& task,
                                          const std::vector<MotionScenario>& scenarios,
                                          const SchemeMaps& maps);

/// Whether the start of an impulse is a block of the program.
bool start_is_block(const MotionTask& task, const SchemeMaps& maps);

/// Sets tau_d and J'W of all blocks, and c of the instants to that of the first scenario. W and c
/// turn with the end effector if the task says so.
void set_instants(const Problem& problem, const MotionTask& task,
                  const std::vector<MotionScenario>& scenarios, const SchemeMaps& maps,
                  std::vector<Instant>& instants, TrajectoryProgram& program);

/// Reads u, h and c of the instants from an answer in one scenario. A start without a block of its
/// own has u_0 = 0, or u_0 = u_1 if it is free.
void read_efforts(const Problem& problem, const MotionTask& task, const TrajectoryProgram& program,
                  const TrajectorySolution& solution, const MotionScenario& scenario, int number,
                  std::vector<Instant>& instants);

}  // namespace maxwrench
