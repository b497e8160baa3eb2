#pragma once

#include <optional>
#include <vector>

#include "lib/posture/posture_state.h"
#include "lib/scenario/current_load.h"
#include "maxwrench/capability.h"

namespace maxwrench {

/// The parts of a gradient that belong to the loads and the wrench of the scenario that decides.
class ScenarioSlopes {
 public:
  explicit ScenarioSlopes(const Problem& problem);
  explicit ScenarioSlopes(const Problem&& problem) = delete;

  /// Sets wet masses to those of the scenario, and back to those of the robot.
  void load(const ScenarioChoice& choice, PostureState& state);
  void unload(PostureState& state);
  /// Adds the derivatives of lambda'tau of the scenario's current by all joint positions, at
  /// resting end effector. Returns the derivative of beta by a turn of the whole robot, in world
  /// axes, because of the current and of a payload's wrench.
  Eigen::Vector3d add(const PostureState& state, const Capability& capability,
                      Eigen::VectorXd& q_gradient);

 private:
  const Problem& problem_;
  std::optional<CurrentLoad> water_;
  std::vector<LinkLoad> changes_;
  Eigen::VectorXd tau_;
};

}  // namespace maxwrench
