#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace maxwrench {

/// Draws a scene for print as SVG, in three-quarter view without perspective: the robot with light
/// and depth, its efforts with their names, and the wrench. It is what the page of `view` shows.
///
/// All that the scene shows is side by side at one scale: postures in one row, or the stills of
/// each trajectory in a row of its own.
///
/// @param scene  as `scene_of` makes it; it must show something
/// @param times  for a task in time: the instants closest to these times [s] are drawn
/// @throws std::invalid_argument if there is nothing to draw
std::string still_figure(const nlohmann::ordered_json& scene, const std::vector<double>& times);

}  // namespace maxwrench
