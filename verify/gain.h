#pragma once

#include <vector>

#include "maxwrench/problem.h"

namespace maxwrench {

/// The gain that sigma_min limits at a second contact: the `rank`-th largest singular value [-] of
/// [J_1; J_2] in units of the contact's length_scale (see `Contact`), at poses of the links
/// relative to the base.
double contact_gain(const Problem& problem, const std::vector<Pose<double>>& links);

}  // namespace maxwrench
