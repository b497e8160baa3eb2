#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "maxwrench/solve.h"
#include "problems/loader/visuals.h"

namespace maxwrench {

struct GoodPostures;

/// A posture or trajectory that a page shows by a name of its own.
struct Shown {
  std::string name;  ///< "best", "default" or "given"
  Answer answer;
  bool tank = false;  ///< whether to show its experiment in the virtual tank, too
};

/// Rejects a task whose trajectories the virtual tank cannot carry out.
///
/// @throws std::invalid_argument with one line that begins with the key
void require_tank(const Problem& problem, const std::string& measure, const std::string& key);

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

/// The regions of good postures of a static task, the key "within" of a scene.
///
/// `lower` and `upper` are the ends of at most 20,000 boxes as 16-bit shares of `low` and `extent`,
/// rounded outward, those with the largest bounds first; `cluster` has a byte for each. More boxes
/// are joined: no good posture is outside these either.
///
/// @param good   what `find_good_postures` found
/// @param share  of the best value
nlohmann::ordered_json within_json(const Problem& problem, const GoodPostures& good, double share);

}  // namespace maxwrench
