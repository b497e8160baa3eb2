#pragma once

#include <optional>
#include <string>
#include <vector>

#include "maxwrench/task.h"
#include "problems/loader/urdf_choices.h"
#include "problems/loader/urdf_element.h"
#include "problems/mesh/mesh_shape.h"

namespace maxwrench {

/// What becomes of the meshes of a URDF, and where what there is to say about them goes.
struct MeshReading {
  MeshShapes shapes;
  std::vector<std::string>&warnings, &notes, &files;
};

/// The shape of an element `collision` in axes of its URDF link, without its link. Empty where the
/// element has none that can be used; the reason is a warning, and the link then does not collide
/// there.
std::optional<Shape> read_shape(const UrdfElement& collision, MeshUse meshes, MeshReading& reading);

}  // namespace maxwrench
