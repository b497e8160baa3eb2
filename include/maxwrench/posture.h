#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "maxwrench/status.h"
#include "maxwrench/types.h"

/// @file
/// Postures: the configuration of a robot at theta_r, its Jacobians and gradients.

namespace maxwrench {

struct Capability;
struct Problem;

/// The number of postures that reach the pose and the second contact, and why some are invalid.
///
/// Each solution of the inverse kinematics is one posture. The numbers are for one theta_r, or sums
/// over several.
struct IkCounts {
  long unreachable = 0;   ///< number of theta_r without any posture
  long most = 0;          ///< largest number of postures at one theta_r
  long found = 0;         ///< number of all postures
  long beyond_limit = 0;  ///< postures that violate a joint limit
  long singular = 0;      ///< postures near a singularity
  long collision = 0;     ///< postures in self-collision
  long incomplete = 0;  ///< number of theta_r where postures may be missing, as two nearly coincide
  /// Returns the number of valid postures.
  long valid() const { return found - beyond_limit - singular - collision; }
};

/// Counts postures and undecided evaluations of an objective and all of its clones.
///
/// All functions may be called from any thread.
class Tally {
 public:
  /// Adds the postures of one evaluation.
  void add(const IkCounts& counts);
  /// Returns the sums over all evaluations.
  IkCounts sum() const;
  /// Adds an evaluation whose lower level ended without a verdict that the data confirm.
  void add_undecided() { ++undecided_; }
  /// Returns the number of such evaluations.
  long undecided() const { return undecided_; }

 private:
  std::atomic<long> undecided_ = 0;
  std::atomic<long> unreachable_ = 0, most_ = 0, found_ = 0;
  std::atomic<long> beyond_limit_ = 0, singular_ = 0, collision_ = 0, incomplete_ = 0;
};

/// What makes a posture invalid.
enum class Violation {
  kNone,            ///< nothing: the posture is valid
  kThetaR,          ///< a coordinate of theta_r exceeds its limits
  kDependentJoint,  ///< a dependent joint exceeds its limits
  kSecondArm,       ///< a joint of the second arm exceeds its limits, in each IK solution
  kBase,            ///< the base would have to move off its free axes
  kNoSolution,  ///< dependent joints or second arm have no IK solution, or one near a singularity
  kCollision    ///< self-collision
};

/// A posture: configuration, J and tau_d at one theta_r (eq:reducedDynamics).
///
/// The status is kValid if it exists and violates nothing, otherwise kInvalidPosture.
struct Posture : Verdict {
  Violation violation = Violation::kNone;  ///< the kind of violation that `reason` describes
  Eigen::VectorXd theta_r;                 ///< redundant coordinates (r)
  Pose<double> base;                       ///< pose of the base in the world
  Eigen::VectorXd q;                       ///< positions of all joints [rad or m]
  std::vector<Pose<double>> links;         ///< poses of the links relative to the base
  /// The rotation of the task's wrenches. It is the identity unless they turn with an end effector
  /// whose pose is partly free.
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Matrix6Xd J;  ///< Jacobian (6×n) [-, m]: velocities -> twist of the end effector in world axes
  /// Jacobian of the second end effector at the contact point (6×n), as J. Empty without a second
  /// contact.
  Matrix6Xd J_2;
  /// Basis of the wrenches of the second contact, in world axes (6×l). Empty without one.
  Matrix6Xd C_2;
  Pose<double> contact;   ///< the frame of the second contact in the world
  IkCounts ik_solutions;  ///< counts of all postures at this theta_r
  /// Forces that the actuators must exert at rest without contact (n) [N, N m].
  Eigen::VectorXd tau_d;
};

/// Returns the reason why a posture is invalid, with the joint or bodies and the numbers.
///
/// Examples are "joint limit: elbow at 1.95 rad, limits -1 .. 1" and "self-collision: forearm and
/// base". For a valid posture the text is empty.
std::string describe_violation(const Problem& problem, const Posture& posture);

/// Evaluates the postures of one problem.
///
/// It reuses its storage, so nothing is allocated after the first call. Use one object per thread.
class PostureEvaluator {
 public:
  /// Keeps a reference to the problem, which must outlive the evaluator.
  ///
  /// @param problem          the task
  /// @param check_collision  whether postures that collide are invalid
  explicit PostureEvaluator(const Problem& problem, bool check_collision = true);
  /// Deleted: the problem must outlive the evaluator, and a temporary does not.
  explicit PostureEvaluator(const Problem&& problem, bool check_collision = true) = delete;
  ~PostureEvaluator();

  /// Computes the posture at theta_r.
  ///
  /// The limits of joints, reach and self-collision determine its status. J and tau_d are always
  /// filled. They belong to the first valid posture, or to one that shows the violation. If no
  /// posture reaches the pose, they belong to theta_r with the guess of the dependent coordinates.
  ///
  /// @param theta_r  the redundant coordinates (r)
  /// @return the posture, valid until the next call
  /// @throws std::invalid_argument if theta_r has the wrong size or is not finite.
  const Posture& evaluate(const Eigen::VectorXd& theta_r);

  /// Returns the number of valid postures at the last theta_r.
  ///
  /// There is one for each IK solution of the dependent joints and of the second arm. Without
  /// either there is at most one.
  int ik_solutions() const;
  /// Switches to one of the valid postures at the last theta_r.
  ///
  /// @param ik_solution  its number, from 0 to `ik_solutions()` - 1
  /// @return the posture, valid until the next call
  const Posture& select(int ik_solution);

  /// Computes the gradient of a function of tau_d and J by theta_r, exactly, by reverse
  /// accumulation.
  ///
  ///     gradient_k = tau_seed' d tau_d/d theta_r_k + <J_seed, d J/d theta_r_k>
  ///
  /// For wrenches that turn, (d (R'J)) R takes the place of d J, with R the `Posture::turn`,
  /// because the value depends on that. The call is cheapest after `evaluate` at the same theta_r;
  /// it then uses the selected posture.
  ///
  /// @param theta_r   the redundant coordinates (r)
  /// @param tau_seed  the derivative by tau_d (n)
  /// @param J_seed    the derivative by J (6×n)
  /// @param gradient  receives r numbers
  /// @throws std::invalid_argument if theta_r has the wrong size or is not finite, or a derivative
  ///         has the wrong size.
  void pull_back(const Eigen::VectorXd& theta_r, const Eigen::VectorXd& tau_seed,
                 const Matrix6Xd& J_seed, Eigen::VectorXd& gradient);

  /// Computes the gradient of beta by theta_r from the derivatives in a capability.
  ///
  /// With a second contact it belongs to the IK solution of the posture, whose joints q_2 follow
  /// from the implicit function theorem. Let S_k be the twist of the second end effector at the
  /// contact point along joint k, and t_i the twist of the contact frame along s_i. Then
  ///
  ///     J_f dq_2 = sum_i t_i ds_i - sum_k S_k dq_k
  ///
  /// where J_f holds the columns of J_2 of the dependent joints of the contact. C_2 turns with the
  /// contact frame.
  ///
  /// @param theta_r     the redundant coordinates (r)
  /// @param capability  the result of a measure at this posture
  /// @param gradient    receives r numbers
  /// @throws std::invalid_argument as above.
  void pull_back(const Eigen::VectorXd& theta_r, const Capability& capability,
                 Eigen::VectorXd& gradient);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace maxwrench
