#pragma once

#include <string>
#include <vector>

#include "maxwrench/task.h"

namespace maxwrench {

/// The body of this name. Rejects other names, as the key `key`.`name`.
const BodyPart& find_part(const std::string& key, const std::string& name, const Robot& robot);

/// Rejects a current, the value `got` of `key`, that is too fast or has no effect on the robot.
void require_current(const std::string& key, const std::string& got, double speed,
                     const Robot& robot);

/// The uncertain loads of a robot, each with the corners of its intervals: a group for mass and
/// centre of mass of each body, one for its volume and centre of buoyancy, then trim, payload and
/// current. What has no width makes no group.
std::vector<LoadGroup> uncertain_loads(const UncertaintySpec& uncertainty, const Problem& problem);

}  // namespace maxwrench
