#pragma once

#include "problems/mesh/read_mesh.h"

namespace maxwrench {

/// A mesh with at most `most` triangles that looks like the given one, for pictures.
///
/// Points in the same cell of a grid become one, their mean; triangles with two corners in one cell
/// vanish, and so do repeated ones. The cells are as small as `most` allows, out of a fixed series
/// of sizes. A mesh with few triangles only loses repeated points.
Triangles thinned_out(const Triangles& mesh, std::size_t most);

}  // namespace maxwrench
