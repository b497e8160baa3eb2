#include <cmath>
#include <stdexcept>

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
  check(options.integrator);
}

void check(const Robot& robot) {
  const auto reject = [](const DataFault& fault) {
    throw std::invalid_argument(fault.key + ": got " + fault.got + ", expected " + fault.expected);
  };
  for (const Joint& joint : robot.joints) {
    if (!joint.gear) continue;
    reject({"joint[" + joint.name + "].mimic", "a gear",
            "a robot without gears: lock the joint, for the tank does not model them"});
  }
  if (!robot.no_dynamics.empty()) reject(robot.no_dynamics.front());
}

void check(const ScriptOptions& options) {
  require_not_negative("planned", options.planned);
  require_not_negative("thruster_lag", options.thruster_lag);
  require_margin(options.margin);
}

}  // namespace maxwrench
