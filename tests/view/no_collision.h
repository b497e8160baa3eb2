#pragma once

#include <memory>
#include <string>
#include <vector>

#include "maxwrench/robot.h"

namespace maxwrench {

/// A collision check that the engine of pages does not know. Nothing collides.
struct NoCollision final : CollisionChecker {
  int colliding_pair(const std::vector<Pose<double>>&) const override { return -1; }
  int pairs() const override { return 0; }
  bool nearest(const std::vector<Pose<double>>&, int, ClosestPoints&) const override {
    return false;
  }
  std::string pair_name(int) const override { return ""; }
};

}  // namespace maxwrench
