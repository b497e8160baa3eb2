#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "maxwrench/types.h"
#include "maxwrench/zonotope.h"

/// @file
/// Lists of scenarios: several wrenches, lost actuators and uncertain loads in one task.

namespace maxwrench {

struct Problem;
struct ScenarioChoice;

/// The largest number of scenarios of a list.
inline constexpr long kMostScenarios = 100'000;

/// A change of the wet mass of a link, at rest.
///
/// At rest a link loads the robot by its wet mass m - rho V and the first moment of that,
/// m com - rho V cob. The generalised forces are linear in both.
struct LinkLoad {
  int link = 0;     ///< the link
  double mass = 0;  ///< change of the wet mass [kg]
  /// Change of its first moment about the origin of the link, in link axes [kg m].
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
};

/// A change of a nominal value, by its key in the table `[uncertainty]`.
struct Delta {
  std::string key;         ///< such as "mass.link_4" or "com.base"
  Eigen::VectorXd change;  ///< one number, or three of a centre, in the unit of the key
};

/// One case of an uncertain load.
struct LoadCase {
  std::string name;             ///< for messages, such as "base mass +0.1 kg"; empty: nominal
  std::vector<LinkLoad> loads;  ///< changes of the nominal robot
  /// Velocity of the water in the world [m/s]; zero: at rest.
  Eigen::Vector3d current = Eigen::Vector3d::Zero();
  std::vector<Delta> deltas = {};  ///< what `loads` follows from, as the task states it
};

/// The cases of one uncertain load, of which exactly one holds. Groups are independent.
using LoadGroup = std::vector<LoadCase>;

/// The actuators that a scenario has lost, and those that are weaker, by their indices in u.
struct LostActuators {
  std::vector<int> dead = {},         ///< thrusters that exert nothing
      limp = {},                      ///< joints without a motor
      locked = {};                    ///< joints that their brakes hold
  std::map<int, double> weaker = {};  ///< the share by which an actuator is weaker [-]
};

/// The limits of the actuators, with all or with some of them lost.
struct ScenarioLimits {
  std::string name;  ///< for messages, such as "front_left dead"; empty: nothing is lost
  /// The robot's zonotope with other limits of u. B is the same, and so are the normals N if there
  /// are facets.
  Zonotope actuation;
  /// Whether a lost joint has a brake or friction: its effort is within limits, but no command.
  bool resists = false;
  LostActuators lost = {};  ///< what the limits follow from
};

/// One wrench of a task.
struct ScenarioWrench {
  std::string name;  ///< for messages, such as "wrench 2"
  /// [force; torque] in the axes of `Problem::c`, of any length. Zero: only the ball is added to
  /// it, or `hold`.
  Vector6d c = Vector6d::Zero();
  /// Whether the robot must hold its posture without a wrench. c is zero then, and no ball is
  /// added.
  bool hold = false;
};

/// A ball of wrenches {E z : |z| <= radius}, which is added to each wrench of a task except `hold`.
struct WrenchBall {
  /// Orthonormal axes in those of `Problem::c`, all of forces or all of torques (6×d).
  Matrix6Xd E;
  double radius = 0;  ///< radius [N or N m]
};

/// The load of 1 kg that the end effector carries, at rest.
struct CarriedLoad {
  double wet_mass = 1;  ///< mass less displaced water, per kg [-]
  /// First moment of the wet mass about the end effector's origin, in its axes, per kg [m].
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
};

/// What a task asks for beyond one wrench of the nominal robot.
///
/// A scenario s is one wrench c_s, one set of limits, and one case of each load. The factors beta
/// for which some efforts within the limits balance the posture,
///
///     I_s = {beta : B u - J'(beta c_s + F w) = tau_s for some u within limits s and some w},
///
/// are an interval [lo_s, hi_s]. The value of the list is min hi_s if each interval has a point and
/// min hi_s >= max lo_s; otherwise the posture is infeasible. Efforts may differ from scenario to
/// scenario: each is held, not all at once.
struct ScenarioList {
  std::vector<ScenarioWrench> wrenches;  ///< the wrenches; none: the task has no list
  std::optional<WrenchBall> ball;        ///< added to each wrench except `hold`
  /// The payload whose mass is the value. The only wrench is its weight at `Problem::pose`; at a
  /// posture it is the weight there, since the weight does not turn with the end effector.
  std::optional<CarriedLoad> payload;
  /// Basis of the components that `Wrench::kAny` leaves free in each scenario (6×k).
  Matrix6Xd F = Matrix6Xd(6, 0);
  /// The first has all actuators; none where there is no list. Where actuators may be weaker, these
  /// are the limits of the weakest, in all of them.
  std::vector<ScenarioLimits> limits;
  std::vector<LoadGroup> loads;  ///< the uncertain loads
  bool non_negative = false;     ///< whether beta >= 0 is required: of a ball, and of a mass
  /// The unit of the value: "N", "N m", "mixed" of one wrench, "kg" of a payload, or "-" of a
  /// factor of the stated wrenches.
  const char* unit = "";

  /// Returns whether the task has no list.
  bool empty() const { return wrenches.empty(); }
  /// Returns the number of scenarios, without those of the ball; at most `kMostScenarios` + 1.
  long count() const;
};

/// Returns what tells a scenario from the others of its list.
///
/// An example is "wrench 2; front_left dead; base com.x +0.005 m". If there is nothing to tell, it
/// is "nominal", or "weaker actuators" where the limits are theirs.
std::string describe(const ScenarioList& list, const ScenarioChoice& choice);

/// A scenario in the keys of its task.
struct ScenarioData {
  std::string wrench;                  ///< the name of one of several wrenches; empty: there is one
  Vector6d c;                          ///< the wrench per unit of the value, as `ScenarioChoice::c`
  std::vector<Delta> deltas;           ///< changes of uncertain values; zeros are listed as well
  std::vector<std::string> dead = {},  ///< names of thrusters that exert nothing,
      limp = {},                       ///< of joints without a motor,
      locked = {};                     ///< and of joints that their brakes hold
  /// The names of weaker actuators with the share by which each is weaker [-].
  std::vector<std::pair<std::string, double>> weaker = {};
  /// Velocity of the water in the world [m/s]; none: the task has no current.
  std::optional<Eigen::Vector3d> current = {};
};

/// Returns what a scenario of a task consists of: the data that `describe` puts into words.
ScenarioData scenario_data(const Problem& problem, const ScenarioChoice& choice);

/// Returns the task without uncertainty and loss: its wrenches with the nominal robot.
///
/// A load with a single case without a name is known, such as a known current, and stays.
/// A list that has one wrench, no ball and no payload then becomes an ordinary task, unless the
/// wrench comes from a set, which keeps its length.
Problem nominal(Problem problem);

}  // namespace maxwrench
