#include "solvers/trajectory/by_facets.h"

#include <algorithm>

namespace maxwrench {

bool bounded_by_facets(const TrajectoryProgram& program) {
  const auto single = [](const WrenchProgram& at) {
    return at.columns() == 1 && at.c_w[0] > 0 && at.w_min[0] == -kInfinity &&
           at.w_max[0] == kInfinity;
  };
  const Zonotope& set = *program.instants.front().actuation;
  return program.peak < 0 && !program.common && set.has_facets && program.first_min == set.u_min &&
         program.first_max == set.u_max &&
         std::all_of(program.instants.begin(), program.instants.end(), single);
}

}  // namespace maxwrench
