#pragma once

#include <memory>
#include <vector>

#include "lib/problem.h"
#include "lib/status.h"

namespace maxwrench {

/// Everything known at one theta_r (eq:reducedDynamics): the configuration, J and tau_d.
struct Posture {
  Status status = Status::kInvalidPosture;  ///< kOptimal: the posture exists and violates nothing
  const char* reason = "";
  Eigen::VectorXd theta_r;
  Pose<double> base;                ///< of the base in the world
  Eigen::VectorXd q;                ///< all joints
  std::vector<Pose<double>> links;  ///< relative to the base
  Matrix6Xd J;            ///< 6×n [-, m], velocities -> twist of the end effector in world axes
  Eigen::VectorXd tau_d;  ///< n [N, N m], what the actuators must exert at rest without contact
};

/// Evaluates the postures of one problem, reusing its storage: no allocation after the first call.
class PostureModel {
 public:
  explicit PostureModel(const Problem& problem, bool check_collision = true);
  ~PostureModel();

  /// Joint limits, reach and self-collision decide `status`; J and tau_d are filled in any case.
  /// Where dependent joints do not follow (see lib/branch.h) they are those of the last point on
  /// the way to theta_r. Throws std::invalid_argument if theta_r has the wrong size or is not
  /// finite.
  const Posture& evaluate(const Eigen::VectorXd& theta_r);

  /// gradient_k = tau_seed' d tau_d/d theta_r_k + <J_seed, d J/d theta_r_k>, exact, by reverse
  /// accumulation. Cheapest after `evaluate` at the same theta_r, whose posture it keeps.
  void pull_back(const Eigen::VectorXd& theta_r, const Eigen::VectorXd& tau_seed,
                 const Matrix6Xd& J_seed, Eigen::VectorXd& gradient);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace maxwrench
