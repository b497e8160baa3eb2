#include "verify/trajectory/screw_path.h"

namespace maxwrench {

std::optional<ScrewPath> screw_of(const Path& path) {
  if (path.is_spline()) return std::nullopt;
  return ScrewPath{path.start(),        path.axis(),  path.centre(),
                   path.displacement(), path.angle(), path.timing()};
}

}  // namespace maxwrench
