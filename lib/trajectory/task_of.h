#pragma once

namespace maxwrench {

struct Problem;
class TrajectoryObjective;

/// The task of an objective that `make_trajectory_objective` made. Throws std::invalid_argument if
/// the objective is another one.
const Problem& task_of(const TrajectoryObjective& objective);

}  // namespace maxwrench
