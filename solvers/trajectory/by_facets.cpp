#include "solvers/trajectory/by_facets.h"

#include <algorithm>

namespace maxwrench {

bool starts_anywhere(const TrajectoryProgram& program) {
  for (int i = 0; i < program.size(); i += program.length()) {
    const Zonotope& set = *program.instants[static_cast<std::size_t>(i)].actuation;
    if (!set.has_facets) return false;
    for (int j = 0; j < set.actuators(); ++j) {
      if (program.u_min(j, i) != set.u_min[j] || program.u_max(j, i) != set.u_max[j]) return false;
    }
  }
  return true;
}

bool bounded_by_facets(const TrajectoryProgram& program) {
  const auto single = [](const WrenchProgram& at) {
    return at.columns() == 1 && at.c_w[0] > 0 && at.w_min[0] == -kInfinity &&
           at.w_max[0] == kInfinity;
  };
  return program.peak < 0 && !program.common && starts_anywhere(program) &&
         std::all_of(program.instants.begin(), program.instants.end(), single);
}

}  // namespace maxwrench
