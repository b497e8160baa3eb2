#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "maxwrench/types.h"
#include "maxwrench/zonotope.h"

namespace maxwrench {

/// [rad or m] A posture on its limit is inside: theta_r may carry rounding from a search's box.
inline constexpr double kLimitTolerance = 1e-12;

enum class JointType { kRevolute, kPrismatic };

/// Added mass and drag of one body, diagonal in its own frame: in the axes of `frame`, for the
/// velocity [linear; angular] at its origin. Force of the drag: -(linear + quadratic |v|) v.
struct HydrodynamicBody {
  Pose<double> frame;                             ///< link -> body
  Vector6d added_mass = Vector6d::Zero();         ///< [kg, kg m^2]
  Vector6d damping_linear = Vector6d::Zero();     ///< [N s/m, N m s]
  Vector6d damping_quadratic = Vector6d::Zero();  ///< [N s^2/m^2, N m s^2]
};

/// The rigid body that moves with joint i is link i + 1; link 0 is the base. Bodies on fixed joints
/// are part of the link that carries them.
struct Link {
  std::string name;
  double mass = 0;                                    ///< kg
  Eigen::Vector3d com = Eigen::Vector3d::Zero();      ///< m, in link axes
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< kg m^2, about com, in link axes
  double volume = 0;                                  ///< m^3, displaced
  Eigen::Vector3d cob = Eigen::Vector3d::Zero();      ///< m, centre of buoyancy in link axes
  /// One for each body that has such data: |v| v of a whole does not follow from one matrix.
  std::vector<HydrodynamicBody> hydrodynamics = {};
};

/// Floats added and ballast removed to balance a vehicle: a force of buoyancy_mass * gravity
/// upwards, in water and in air, without inertia. Negative: ballast added.
struct Trim {
  double buoyancy_mass = 0;                            ///< kg
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m, in base axes
};

struct Joint {
  std::string name;
  JointType type = JointType::kRevolute;
  int parent = 0;          ///< link that carries the joint, always an earlier one
  Pose<double> placement;  ///< parent link -> joint frame at q = 0
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit vector in the joint frame
  double q_min = -kInfinity, q_max = kInfinity;     ///< rad or m
  double velocity_max = kInfinity;                  ///< rad/s or m/s
  double effort_max = 0;                            ///< N m or N
};

/// A revolute joint means the same after whole turns: q less those that bring it inside its limits.
double turned_into_limits(const Joint& joint, double q);

struct Thruster {
  std::string name;
  Eigen::Vector3d position;             ///< m, in base axes
  Eigen::Vector3d direction;            ///< unit vector of the force on the base at positive thrust
  double force_min = 0, force_max = 0;  ///< N
  double force_rate_max = kInfinity;    ///< N/s
};

struct EndEffector {
  std::string name;
  int link = 0;
  Pose<double> placement;  ///< link -> end effector frame
};

/// A convex body on a link, for pictures: all points within `radius` of the hull of `points`, in
/// link axes.
struct ConvexBody {
  int link = 0;
  std::vector<Eigen::Vector3d> points;  ///< m
  double radius = 0;                    ///< m
};

/// How near two bodies on different links are.
struct ClosestPoints {
  /// m, what is left of the distance beyond the margin; negative: collision. It grows no deeper
  /// where the points fall together.
  double clearance = 0;
  int link_a = 0, link_b = 0;
  /// Points whose distance changes with the links as the clearance does, in base axes.
  Eigen::Vector3d on_a, on_b;
};

/// A box (or a segment, or a point) on a link.
struct InscribedBox {
  int link = 0;
  Pose<double> placement;                                ///< link -> box, centred at its origin
  Eigen::Vector3d half_sizes = Eigen::Vector3d::Zero();  ///< m
};

/// Two bodies collide wherever their cores are closer than `reach` [m].
struct InscribedBoxPair {
  InscribedBox a, b;
  double reach = 0;
};

/// Decides whether a posture collides with itself. Const and shared between threads.
class CollisionChecker {
 public:
  virtual ~CollisionChecker() = default;
  /// The first pair that collides, or -1. `links`: pose of each link relative to the base.
  virtual int colliding_pair(const std::vector<Pose<double>>& links) const = 0;
  bool collides(const std::vector<Pose<double>>& links) const { return colliding_pair(links) >= 0; }
  virtual int pairs() const = 0;
  /// How near a pair is; false if only a test is known of it.
  virtual bool nearest(const std::vector<Pose<double>>& links, int pair,
                       ClosestPoints& result) const = 0;
  /// The links of the URDF that a pair is about, such as "forearm and base".
  virtual std::string pair_name(int pair) const = 0;
  /// Where a pair is sure to collide; false if nothing is known of that.
  virtual bool inscribed_boxes(int /*pair*/, InscribedBoxPair& /*result*/) const { return false; }
};

/// A tree of links on a base, with its actuators and limits. Const after loading and shared between
/// threads.
struct Robot {
  std::string name;
  /// (block of the file, where its numbers come from), in the order of the file.
  std::vector<std::pair<std::string, std::string>> sources;
  /// The free axes of the base velocity, as indices into [x y z roll pitch yaw] in increasing
  /// order: one of the eight subsets that are integrable in base axes (see
  /// `base_axes_are_integrable`).
  std::vector<int> base_axes;
  /// Of the base in the world before it moves along its free axes. No meaning with all six.
  Pose<double> mount;
  std::vector<Link> links;  ///< joints + 1
  std::vector<Joint> joints;
  std::vector<Thruster> thrusters;
  std::vector<EndEffector> end_effectors;
  double gravity = 9.81;     ///< m/s^2, along -z of the world
  double water_density = 0;  ///< kg/m^3, zero in air
  Trim trim;
  /// Actuators: thrusters first, then one directly driven motor for each joint.
  Zonotope actuation;                                 ///< n×m
  Eigen::VectorXd u_rate_max;                         ///< m, per second; infinite for joints
  std::shared_ptr<const CollisionChecker> collision;  ///< null: nothing to check
  std::vector<ConvexBody> convex_bodies;              ///< its shapes

  /// n: free base axes, then joints.
  int velocities() const { return static_cast<int>(base_axes.size() + joints.size()); }
  int actuators() const { return static_cast<int>(thrusters.size() + joints.size()); }
};

/// Makes a rigid body part of the link: its mass > 0, centre of mass, and inertia about it, in link
/// axes.
void add_body(Link& link, double mass, const Eigen::Vector3d& com, const Eigen::Matrix3d& inertia);

/// Whether velocities along these base axes reach a group of poses: {}, {x}, {x,y}, {x,y,z}, {yaw},
/// {x,y,yaw}, {x,y,z,yaw} or all six.
bool base_axes_are_integrable(const std::vector<int>& axes);

/// Fills `actuation` and `u_rate_max` from the thrusters and joints: a thruster's column of B is
/// its [direction; position x direction] on the free base axes, a joint's a unit vector.
void complete_actuation(Robot& robot);

}  // namespace maxwrench
