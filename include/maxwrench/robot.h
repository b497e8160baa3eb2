#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "maxwrench/types.h"
#include "maxwrench/zonotope.h"

/// @file
/// Robots: links, joints, thrusters, collision checks and actuators.

namespace maxwrench {

/// The tolerance of limits [rad or m]: a posture that exceeds a limit by less counts as inside.
///
/// theta_r may carry rounding from the unit cube of a search.
inline constexpr double kLimitTolerance = 1e-12;

/// The type of a joint.
enum class JointType {
  kRevolute,  ///< rotates about its axis [rad]
  kPrismatic  ///< slides along its axis [m]
};

/// Added mass and drag of one body, diagonal in the axes of its own frame.
///
/// They act on the velocity v = [linear; angular] at the origin of `frame`. The force of the drag
/// is -(linear + quadratic |v|) v.
struct HydrodynamicBody {
  Pose<double> frame;                          ///< link -> body
  Vector6d added_mass = Vector6d::Zero();      ///< added mass [kg; kg m^2]
  Vector6d damping_linear = Vector6d::Zero();  ///< linear drag coefficients [N s/m; N m s]
  /// Quadratic drag coefficients [N s^2/m^2; N m s^2].
  Vector6d damping_quadratic = Vector6d::Zero();
};

/// A rigid body of the robot.
///
/// Link 0 is the base, and link i + 1 moves with joint i. Bodies on fixed joints are part of the
/// link that carries them.
struct Link {
  std::string name;                                   ///< the name
  double mass = 0;                                    ///< mass [kg]
  Eigen::Vector3d com = Eigen::Vector3d::Zero();      ///< centre of mass in link axes [m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< inertia about com, in link axes [kg m^2]
  double volume = 0;                                  ///< displaced volume [m^3]
  Eigen::Vector3d cob = Eigen::Vector3d::Zero();      ///< centre of buoyancy in link axes [m]
  /// One for each body with such data. One matrix for all cannot express the terms |v| v.
  std::vector<HydrodynamicBody> hydrodynamics = {};
};

/// Floats added and ballast removed to balance a vehicle.
///
/// They exert a force of buoyancy_mass * gravity upwards, in water and in air, and have no inertia.
struct Trim {
  double buoyancy_mass = 0;  ///< mass that the trim carries [kg]; negative: ballast added
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< where the force acts, in base axes [m]
};

/// A body of a link, before bodies on fixed joints are joined into one: what uncertain data refer
/// to.
struct BodyPart {
  std::string name;                               ///< the name, for a URDF that of its link
  int link = 0;                                   ///< the link that it is part of
  Pose<double> frame;                             ///< link -> body
  double mass = 0;                                ///< mass [kg]
  Eigen::Vector3d com = Eigen::Vector3d::Zero();  ///< centre of mass in the axes of `frame` [m]
  double volume = 0;                              ///< displaced volume [m^3]
  Eigen::Vector3d cob = Eigen::Vector3d::Zero();  ///< centre of buoyancy, likewise [m]
};

/// A gear or linkage that moves a joint with another one: q = ratio q_leader + offset.
///
/// The leader's motor drives both. `complete_actuation` gives the gear a column of B: its force
/// u acts on the joint as u and on the leader as -ratio u, so it does no work.
struct Gear {
  int leader = -1;    ///< the joint that leads
  double ratio = 1;   ///< displacement per displacement of the leader [-, m/rad or rad/m]
  double offset = 0;  ///< position where the leader is at zero [rad or m]
};

/// A joint and its motor.
struct Joint {
  std::string name;                       ///< the name
  JointType type = JointType::kRevolute;  ///< revolute or prismatic
  int parent = 0;                         ///< link that carries the joint, always an earlier one
  Pose<double> placement;                 ///< parent link -> joint frame at q = 0
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit vector in the joint frame
  double q_min = -kInfinity,                        ///< lower limit [rad or m]
      q_max = kInfinity;                            ///< upper limit [rad or m]
  double velocity_max = kInfinity;                  ///< speed limit [rad/s or m/s]
  double effort_max = 0;                            ///< effort limit, in both directions [N m or N]
  /// The gear of a joint without a motor of its own; `effort_max` is then its limit. Between base
  /// and end effector, static tasks of one contact support it; its leader is then one of theta_r.
  std::optional<Gear> gear = {};
};

/// Returns q plus or minus whole turns, such that it is inside the limits of a revolute joint if
/// possible.
///
/// Whole turns do not change the posture of a revolute joint.
double turned_into_limits(const Joint& joint, double q);

/// A thruster, fixed to the base.
struct Thruster {
  std::string name;          ///< the name
  Eigen::Vector3d position;  ///< position in base axes [m]
  /// Unit vector of the force on the base at positive thrust, in base axes.
  Eigen::Vector3d direction;
  double force_min = 0,               ///< lower limit [N]
      force_max = 0;                  ///< upper limit [N]
  double force_rate_max = kInfinity;  ///< limit of the rate of the force [N/s]
};

/// A frame on a link that can touch the environment.
struct EndEffector {
  std::string name;        ///< the name
  int link = 0;            ///< the link that carries it
  Pose<double> placement;  ///< link -> end effector frame
};

/// A convex body on a link, for figures: all points within `radius` of the convex hull of `points`.
struct ConvexBody {
  int link = 0;                         ///< the link
  std::vector<Eigen::Vector3d> points;  ///< points in link axes [m]
  double radius = 0;                    ///< radius [m]
};

/// The closest points of two bodies on different links.
struct ClosestPoints {
  /// The distance less the margin [m]; negative: collision. It does not decrease further once the
  /// points coincide.
  double clearance = 0;
  int link_a = 0,  ///< the link of the first body
      link_b = 0;  ///< the link of the second body
  /// A point on the first body, in base axes [m]. The distance of both points changes with the
  /// links as the clearance does.
  Eigen::Vector3d on_a,
      on_b;  ///< a point on the second body, in base axes [m]
};

/// A convex body inside a body of a link: a box, which may be a segment or a point, or a hull.
struct InnerBody {
  int link = 0;                                          ///< the link
  Pose<double> placement;                                ///< link -> its axes
  Eigen::Vector3d half_sizes = Eigen::Vector3d::Zero();  ///< half the sizes [m] of a centred box
  /// If there are any, it is their convex hull in place of the box [m], in its axes.
  std::vector<Eigen::Vector3d> points = {};
};

/// Inner bodies of two bodies, which collide wherever these are closer than `reach`.
struct InnerBodyPair {
  InnerBody a,       ///< inside the first body
      b;             ///< inside the second body
  double reach = 0;  ///< distance [m]
};

/// Decides whether a posture is in self-collision.
///
/// An object is const and may be shared between threads. The argument `links` of its functions
/// holds the pose of each link relative to the base. Pairs of bodies are numbered from 0.
class CollisionChecker {
 public:
  virtual ~CollisionChecker() = default;
  /// Returns the first pair that collides, or -1.
  virtual int colliding_pair(const std::vector<Pose<double>>& links) const = 0;
  /// Returns whether any pair collides.
  bool collides(const std::vector<Pose<double>>& links) const { return colliding_pair(links) >= 0; }
  /// Returns the number of pairs.
  virtual int pairs() const = 0;
  /// Computes the closest points of a pair.
  ///
  /// @param links   poses of the links relative to the base
  /// @param pair    the pair
  /// @param result  receives the closest points
  /// @return false if the pair has no distance, only a test for collision
  virtual bool nearest(const std::vector<Pose<double>>& links, int pair,
                       ClosestPoints& result) const = 0;
  /// Returns the names of the URDF links of a pair, such as "forearm and base".
  virtual std::string pair_name(int pair) const = 0;
  /// Gives inner bodies of a pair, from which a collision over a range of postures can be proved.
  ///
  /// The arguments are the pair, and the result. It returns false if the pair has none, which is
  /// the default.
  virtual bool inner_bodies(int /*pair*/, InnerBodyPair& /*result*/) const { return false; }
};

/// A value of a robot's data that some tasks cannot use, in the words of an error message.
struct DataFault {
  std::string key,  ///< the key, as in files
      got,          ///< the value
      expected;     ///< what such a task needs
};

/// A robot: a tree of links on a base, with its actuators and limits.
///
/// It is const after loading and may be shared between threads.
struct Robot {
  std::string name;  ///< the name
  /// Pairs (block of the file, source of its numbers), in the order of the file.
  std::vector<std::pair<std::string, std::string>> sources;
  /// The free axes of the base velocity, as indices into [x y z roll pitch yaw] in increasing
  /// order. They are one of the eight subsets for which `base_axes_are_integrable` holds.
  std::vector<int> base_axes;
  /// Pose of the base in the world before it moves along its free axes. Unused with all six.
  Pose<double> mount;
  std::vector<Link> links;  ///< the base, then one link for each joint
  /// The bodies of the links, which add up to them. `finalize` makes one of each link if there are
  /// none; who changes a link of a complete robot clears them.
  std::vector<BodyPart> parts;
  std::vector<Joint> joints;               ///< the joints
  std::vector<Thruster> thrusters;         ///< the thrusters
  std::vector<EndEffector> end_effectors;  ///< the end effectors
  double gravity = 9.81;                   ///< gravity along -z of the world [m/s^2]
  double water_density = 0;                ///< density of the water [kg/m^3]; zero in air
  /// Steady velocity of the water in the world [m/s]; in a `Problem`, that of the task.
  Eigen::Vector3d current = Eigen::Vector3d::Zero();
  Trim trim;  ///< floats and ballast
  /// The actuators (n×m): thrusters first, then one directly driven motor for each joint.
  Zonotope actuation;
  Eigen::VectorXd u_rate_max;  ///< limits of effort rates (m) [N/s]; infinite for joints
  std::shared_ptr<const CollisionChecker> collision;  ///< null: there is nothing to check
  std::vector<ConvexBody> convex_bodies;              ///< shapes of the robot, for figures
  /// What is wrong with the robot's data, one line each: placeholders, and what no body or motor
  /// can have. Values computed from such data are as good as the data.
  std::vector<std::string> warnings;
  /// How the data were read, one line each: meshes, collision pairs left out, elements not read.
  std::vector<std::string> notes;
  /// Why the equation of motion does not hold, once for each link whose mass and inertia no body
  /// can have. At rest only mass and centre of mass count; tasks in time and the virtual tank
  /// reject such a robot. `finalize` adds to it.
  std::vector<DataFault> no_dynamics;
  /// The files that the robot was read from, its meshes among them. Empty for a robot made in code.
  std::vector<std::string> files;
  /// Named postures: positions [rad or m] of some joints, by name.
  std::map<std::string, std::map<std::string, double>> states;
  /// The name of the limits of joints and thrusters in use. Empty: the robot has only one set, or
  /// none was chosen.
  std::string limits;

  /// Returns n, the number of velocities: free base axes, then joints.
  int velocities() const { return static_cast<int>(base_axes.size() + joints.size()); }
  /// Returns m, the number of actuators: thrusters, then joints.
  int actuators() const { return static_cast<int>(thrusters.size() + joints.size()); }
};

/// Adds a rigid body to a link.
///
/// @param link     the link
/// @param mass     mass of the body [kg], positive
/// @param com      centre of mass of the body, in link axes [m]
/// @param inertia  inertia of the body about its centre of mass, in link axes [kg m^2]
void add_body(Link& link, double mass, const Eigen::Vector3d& com, const Eigen::Matrix3d& inertia);

/// Returns whether the poses that velocities along these base axes reach form a group.
///
/// The eight such sets are {}, {x}, {x,y}, {x,y,z}, {yaw}, {x,y,yaw}, {x,y,z,yaw} and all six.
bool base_axes_are_integrable(const std::vector<int>& axes);

/// Computes `Robot::actuation` and `Robot::u_rate_max` from the thrusters and joints.
///
/// The column of B of a thruster is [direction; position x direction] on the free base axes. The
/// column of a joint is a unit vector.
void complete_actuation(Robot& robot);

}  // namespace maxwrench
