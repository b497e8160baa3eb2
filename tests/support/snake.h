#pragma once

#include <string>

#include "tests/support/support.h"

namespace maxwrench {

/// A vehicle on six axes with a chain of many revolute joints, all of them in theta_r, as files in
/// a folder: robot.urdf, robot.toml and task.toml, which maximises the forward force.
class Snake {
 public:
  explicit Snake(int joints);
  std::string task() const { return folder_.path() / "task.toml"; }
  const std::filesystem::path& path() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
};

}  // namespace maxwrench
