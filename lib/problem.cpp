#include "lib/problem.h"

namespace maxwrench {

const char* to_string(Wrench wrench) { return wrench == Wrench::kPure ? "pure" : "any"; }

const char* Problem::unit() const {
  if (c.tail<3>().isZero()) return "N";
  if (c.head<3>().isZero()) return "N m";
  return "mixed";
}

}  // namespace maxwrench
