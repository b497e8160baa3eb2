#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "maxwrench/problem.h"

namespace maxwrench {

/// One HTML file that needs no other file and no network: the page of view/page/ with a scene and,
/// if the engine of pages supports the task, with that engine.
///
/// @param task   the task of the scene, whose name is the title
/// @param scene  as `scene_of` returns it
std::string view_page(const Problem& task, const nlohmann::ordered_json& scene);

}  // namespace maxwrench
