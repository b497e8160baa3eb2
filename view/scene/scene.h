#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "maxwrench/solve.h"
#include "problems/loader/visuals.h"

namespace maxwrench {

/// A posture or trajectory that a page shows by a name of its own.
struct Shown {
  std::string name;  ///< "best", "default" or "given"
  Answer answer;
};

/// A posture or trajectory as a page shows it: status, value, frames, what binds, scenarios.
///
/// @param shown      the posture or trajectory
/// @param most_sets  at most so many instants have sets of wrenches
nlohmann::ordered_json shown_json(const Shown& shown, std::size_t most_sets);

/// All that a page draws, as one object: the robot, the task, its surroundings and the frames of
/// what is shown. docs/view.md lists its keys.
///
/// @param problem  the task
/// @param visuals  what its robot looks like; without any, its bodies for figures are drawn
/// @param shown    its postures or trajectories; those without a posture are left out of the key
///                 "shown"
nlohmann::ordered_json scene_of(const Problem& problem, const std::vector<Visual>& visuals,
                                const std::vector<Shown>& shown);

}  // namespace maxwrench
