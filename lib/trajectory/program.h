#pragma once

#include <vector>

#include "lib/trajectory/scheme.h"
#include "maxwrench/problem.h"
#include "maxwrench/trajectory.h"

namespace maxwrench {

/// Weight of the slack per N and N m of elastic programs.
inline constexpr double kElasticWeight = 100;

/// The program of a task's instants, before the first motion. A start that balances
/// (`Start::kStatic`, `kRest`) is its first block; otherwise the blocks begin after it.
TrajectoryProgram make_trajectory_program(const Problem& problem, const MotionTask& task,
                                          Wrench wrench, const SchemeMaps& maps);

/// Whether the start of an impulse is a block of the program.
bool start_is_block(const MotionTask& task, const SchemeMaps& maps);

/// Sets tau_d and J'W of all blocks and c of the instants, W and c turned with the end effector
/// where the task says so.
void set_instants(const Problem& problem, const MotionTask& task, Wrench wrench,
                  const SchemeMaps& maps, std::vector<Instant>& instants,
                  TrajectoryProgram& program);

/// u and h of the instants from an answer. Without a block of its own the start has u_0 = 0, or
/// what u_1 is where it is free.
void read_efforts(const Problem& problem, const MotionTask& task, const TrajectoryProgram& program,
                  const TrajectorySolution& solution, std::vector<Instant>& instants);

}  // namespace maxwrench
