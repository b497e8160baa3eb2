#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "maxwrench/status.h"
#include "maxwrench/types.h"

namespace maxwrench {

struct Capability;
struct Problem;

/// What became of the postures that reach the pose, and the second contact, at one theta_r or in
/// sum over several: one for each solution of the inverse kinematics of what follows from theta_r.
struct IkCounts {
  long unreachable = 0;   ///< how many theta_r have none
  long most = 0;          ///< how many one theta_r has at most
  long found = 0;         ///< all of them
  long beyond_limit = 0;  ///< of them, those that leave a joint's limits,
  long singular = 0;      ///< are near singular,
  long collision = 0;     ///< collide with the robot itself
  long incomplete = 0;    ///< at how many theta_r some may be missing, as two all but meet there
  long valid() const { return found - beyond_limit - singular - collision; }
};

/// Sums up over all evaluations of an objective and its clones, in any threads: their postures, and
/// how often the lower level ended without a verdict that the data confirm.
class Tally {
 public:
  void add(const IkCounts& counts);
  IkCounts sum() const;
  void add_undecided() { ++undecided_; }
  long undecided() const { return undecided_; }

 private:
  std::atomic<long> undecided_ = 0;
  std::atomic<long> unreachable_ = 0, most_ = 0, found_ = 0;
  std::atomic<long> beyond_limit_ = 0, singular_ = 0, collision_ = 0, incomplete_ = 0;
};

/// What makes a posture invalid.
enum class Violation {
  kNone,
  kThetaR,          ///< a coordinate of theta_r is beyond its limits
  kDependentJoint,  ///< so is a joint that follows from theta_r,
  kSecondArm,       ///< or one of a second arm, in each of its solutions
  kBase,            ///< the base would leave its free axes
  kNoSolution,      ///< nothing follows from theta_r or for the second arm, or it is near singular
  kCollision
};

/// Everything known at one theta_r (eq:reducedDynamics): the configuration, J and tau_d. kValid if
/// it exists and violates nothing, else kInvalidPosture.
struct Posture : Verdict {
  Violation violation = Violation::kNone;  ///< what `reason` is about
  Eigen::VectorXd theta_r;
  Pose<double> base;                ///< of the base in the world
  Eigen::VectorXd q;                ///< all joints
  std::vector<Pose<double>> links;  ///< relative to the base
  /// By which the task's wrenches have turned; the identity unless they turn with an end effector
  /// whose pose is free.
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Matrix6Xd J;  ///< 6×n [-, m], velocities -> twist of the end effector in world axes
  // Of the second contact, else empty.
  Matrix6Xd J_2;          ///< 6×n, as J: the twist of the second end effector at the contact point
  Matrix6Xd C_2;          ///< 6×l, basis of its wrenches in world axes
  Pose<double> contact;   ///< the contact frame in the world
  IkCounts ik_solutions;  ///< the postures at this theta_r, of which this is one
  Eigen::VectorXd tau_d;  ///< n [N, N m], what the actuators must exert at rest without contact
};

/// The reason of a posture that is not valid, with what it is about: "joint limit: elbow at 1.95
/// rad, limits -1 .. 1" or "self-collision: forearm and base". Empty for a valid one.
std::string describe_violation(const Problem& problem, const Posture& posture);

/// Evaluates the postures of one problem, reusing its storage: no allocation after the first call.
class PostureEvaluator {
 public:
  /// Keeps a reference to the problem.
  explicit PostureEvaluator(const Problem& problem, bool check_collision = true);
  explicit PostureEvaluator(const Problem&& problem, bool check_collision = true) = delete;
  ~PostureEvaluator();

  /// Joint limits, reach and self-collision decide `status`; J and tau_d are filled in any case:
  /// of the first valid posture, or of one that shows what is wrong with all, or, where none
  /// reaches the pose, of theta_r with the guess of what follows. Throws std::invalid_argument if
  /// theta_r has the wrong size or is not finite.
  const Posture& evaluate(const Eigen::VectorXd& theta_r);

  /// How many valid postures the last theta_r has: one for each solution of the inverse kinematics
  /// of dependent joints and of the second arm, at most one without either. `select` turns to one
  /// of them.
  int ik_solutions() const;
  const Posture& select(int ik_solution);

  /// gradient_k = tau_seed' d tau_d/d theta_r_k + <J_seed, d J/d theta_r_k>, exact, by reverse
  /// accumulation; of wrenches that turn, d (R'J) R for d J, R the `turn`: what a value depends on.
  /// Cheapest after `evaluate` at the same theta_r, whose posture it keeps.
  void pull_back(const Eigen::VectorXd& theta_r, const Eigen::VectorXd& tau_seed,
                 const Matrix6Xd& J_seed, Eigen::VectorXd& gradient);

  /// The gradient of beta from its seeds. With a second contact, on the IK solution of the posture:
  /// its joints q_2 follow by the implicit function theorem. With S_k the twist of the second end
  /// effector at the contact point along joint k and t_i that of the contact frame along s_i,
  ///
  ///     J_f dq_2 = sum_i t_i ds_i - sum_k S_k dq_k,
  ///
  /// J_f the columns of J_2 of the joints that follow; and C_2 turns with the contact frame.
  void pull_back(const Eigen::VectorXd& theta_r, const Capability& capability,
                 Eigen::VectorXd& gradient);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace maxwrench
