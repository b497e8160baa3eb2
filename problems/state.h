#pragma once

#include <filesystem>

#include "lib/robot.h"

namespace maxwrench {

/// One instant of a robot's motion.
struct State {
  Pose<double> base;                       ///< in the world
  Eigen::VectorXd q;                       ///< all joints
  Eigen::VectorXd velocity, acceleration;  ///< n, see lib/dynamics.h
};

/// Reads a state from TOML: `[theta]` with the base's `position` and `rpy` in the world, which may
/// differ from the mount along the free axes only, and each joint by its name; `velocity`
/// and `acceleration` with n numbers, zero where they are missing. Errors as `load_robot`.
State load_state(const std::filesystem::path& file, const Robot& robot);

}  // namespace maxwrench
