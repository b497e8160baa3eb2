#pragma once

#include <vector>

#include "maxwrench/problem.h"

namespace maxwrench {

/// The smallest singular value [-] that counts where a second contact holds, the `rank`-th largest
/// of [J_1; J_2] in units of its length_scale (see `Contact`), at poses of the links relative to
/// the base.
double contact_gain(const Problem& problem, const std::vector<Pose<double>>& links);

}  // namespace maxwrench
