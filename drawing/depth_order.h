#pragma once

#include <vector>

#include "drawing/face.h"

namespace maxwrench {

/// The faces in an order in which each one may be drawn over those before it.
///
/// Two faces are compared where they overlap on the picture: there the depth of one relative to the
/// other is affine, so its values at the corners of the overlap decide. Faces that pierce each
/// other are cut where they do, and one of those that cover each other in a ring is halved. Of
/// faces in one plane the later one is in front. Faces that are seen from their edge are left out.
///
/// @param faces      the faces, in any order
/// @param tolerance  lengths that the picture does not show [m]: faces that pierce each other by
///                   less are not cut
std::vector<Face> depth_order(std::vector<Face> faces, double tolerance);

}  // namespace maxwrench
