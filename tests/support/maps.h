#pragma once

#include <utility>
#include <vector>

#include "maxwrench/map.h"

namespace maxwrench {

inline MapPlan plan_over(std::vector<MapAxis> over) {
  MapPlan plan;
  plan.over = std::move(over);
  return plan;
}

inline Options with_budget(long budget, int threads = 2) {
  Options options;
  options.budget = budget;
  options.threads = threads;
  return options;
}

}  // namespace maxwrench
