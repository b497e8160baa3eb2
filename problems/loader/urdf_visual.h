#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "problems/loader/urdf_element.h"
#include "problems/loader/visuals.h"
#include "problems/mesh/mesh_shape.h"

namespace maxwrench {

/// Red, green, blue and opacity by the name of a material.
using Materials = std::map<std::string, std::array<double, 4>>;

/// The named materials of an element <robot> that have a colour.
Materials read_materials(const UrdfElement& robot);

/// The elements `visual` of a link, in axes of the link, without its number. Looks change no
/// result: what cannot be read or found is left out, with a note if it is malformed.
std::vector<Visual> read_visuals(const UrdfElement& link, const Materials& materials,
                                 const MeshShapes& meshes, std::vector<std::string>& notes);

}  // namespace maxwrench
