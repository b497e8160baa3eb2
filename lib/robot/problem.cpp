#include "maxwrench/problem.h"

namespace maxwrench {

const char* to_string(Wrench wrench) { return wrench == Wrench::kPure ? "pure" : "any"; }

const char* Problem::unit() const {
  if (c.tail<3>().isZero()) return "N";
  if (c.head<3>().isZero()) return "N m";
  return "mixed";
}

const char* Problem::type() const {
  if (!motion) return "static";
  return motion->impulse ? "impulse" : "trajectory";
}

std::string Problem::theta_r_name(int i) const {
  const int joints = static_cast<int>(redundant.size());
  if (i >= joints) return "regrasp_" + std::to_string(i - joints + 1);
  return robot.joints[static_cast<std::size_t>(redundant[static_cast<std::size_t>(i)])].name;
}

}  // namespace maxwrench
