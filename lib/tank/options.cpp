#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>

#include "lib/math/require.h"
#include "maxwrench/robot.h"
#include "maxwrench/tank.h"

namespace maxwrench {
namespace {

constexpr double kMostPeriods = 1e7;

void require_positive(const char* key, double value) {
  require(value > 0 && std::isfinite(value), key, value, "a finite number > 0");
}

void require_not_negative(const char* key, double value) {
  require(value >= 0 && std::isfinite(value), key, value, "a finite number >= 0");
}

void require_margin(double margin) {
  require(margin >= 0 && margin < 1, "margin", margin, "a share >= 0 and < 1");
}

}  // namespace

void check(const TankOptions& options) {
  require_positive("ramp", options.ramp);
  require_not_negative("hold", options.hold);
  require_positive("period", options.period);
  const double periods = (2 * options.ramp + options.hold) / options.period;
  require(periods <= kMostPeriods, "period", options.period,
          "at most ten million periods in the experiment");
  require_positive("thruster_lag", options.thruster_lag);
  require_not_negative("bandwidth", options.bandwidth);
  require_margin(options.margin);
  require_not_negative("load", options.load);
  require_positive("cell.stiffness_linear", options.cell.stiffness_linear);
  require_positive("cell.stiffness_angular", options.cell.stiffness_angular);
  require_not_negative("cell.damping_linear", options.cell.damping_linear);
  require_not_negative("cell.damping_angular", options.cell.damping_angular);
  require_not_negative("imperfections.thrust_efficiency", options.imperfections.thrust_efficiency);
  require_not_negative("imperfections.thrust_noise", options.imperfections.thrust_noise);
  for (const ActuatorDeath& death : options.deaths) require_not_negative("dies", death.t);
  require_not_negative("noticed_after", options.noticed_after);
  check(options.integrator);
}

void check_deaths(const TankOptions& options, const Robot& robot, double duration) {
  std::set<int> dead;
  for (const ActuatorDeath& death : options.deaths) {
    if (death.actuator < 0 || death.actuator >= robot.actuators()) {
      throw std::invalid_argument("dies: got actuator " + std::to_string(death.actuator) +
                                  ", expected one of " + std::to_string(robot.actuators()));
    }
    if (!dead.insert(death.actuator).second) {
      throw std::invalid_argument("dies: got actuator " + std::to_string(death.actuator) +
                                  " twice, expected each once");
    }
    require(death.t < duration, "dies", death.t, "a time before the end of the experiment");
  }
}

std::optional<DataFault> unmodelled(const Robot& robot) {
  for (const Joint& joint : robot.joints) {
    if (!joint.gear) continue;
    return DataFault{"joint[" + joint.name + "].mimic", "a gear",
                     "a robot without gears: lock the joint, for the tank does not model them"};
  }
  if (!robot.no_dynamics.empty()) return robot.no_dynamics.front();
  return std::nullopt;
}

void check(const Robot& robot) {
  if (const std::optional<DataFault> fault = unmodelled(robot)) {
    throw std::invalid_argument(fault->key + ": got " + fault->got + ", expected " +
                                fault->expected);
  }
}

void check(const ScriptOptions& options) {
  require_not_negative("planned", options.planned);
  require_not_negative("thruster_lag", options.thruster_lag);
  require_margin(options.margin);
}

}  // namespace maxwrench
