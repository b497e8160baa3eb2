#pragma once

#include <optional>
#include <string>
#include <vector>

#include "maxwrench/task.h"

namespace maxwrench {

/// The limits of all actuators of a scenario.
struct ActuatorLimits {
  std::string name;  ///< as `ScenarioLimits::name`
  Eigen::VectorXd u_min, u_max;
  bool resists = false;     ///< as `ScenarioLimits::resists`
  LostActuators lost = {};  ///< what the limits follow from
};

/// The limits of a robot with all its actuators, then those of each loss, in each case with the
/// actuators that are left as weak as they may be. Where an actuator must exert an effort, being
/// weaker is not always worse: there each combination of its full and its least strength follows.
std::vector<ActuatorLimits> actuator_limits(const std::optional<LossSpec>& loss,
                                            const UncertaintySpec& uncertainty, const Robot& robot);

/// The limits of the intact robot, and those of the loss of each one of `LossSpec::actuators`.
std::vector<ScenarioLimits> limits_of_each_loss(LossSpec loss, const Robot& robot);

}  // namespace maxwrench
