#pragma once

#include <memory>
#include <optional>

#include "maxwrench/capability.h"
#include "maxwrench/measure.h"
#include "maxwrench/posture.h"
#include "maxwrench/wrench_program.h"
#include "maxwrench/wrench_set.h"

namespace maxwrench {

/// The point of a wrench set that is farthest along a direction.
struct SupportPoint {
  Eigen::VectorXd f;  ///< the point (k)
  double value = 0;   ///< the largest d'f over the set
  Eigen::VectorXd u;  ///< efforts at the point (m)
  Vector6d h;         ///< wrench at the point
};

/// The support function of a wrench set. Each of its values is verified: u and h reach the point,
/// and the multipliers prove that none is farther.
class WrenchSupport {
 public:
  /// Keeps references to task and posture. Throws std::invalid_argument as `force_polytope`.
  WrenchSupport(const Problem& task, const Posture& posture, const WrenchSetOptions& options);

  /// The point that is farthest along a unit direction d (k). None: `report` says why.
  std::optional<SupportPoint> farthest(const Eigen::VectorXd& d);
  /// Copies residual and number of programs into a set, and after a failure verdict and ray.
  void report(WrenchSet& set) const;

 private:
  /// Replaces the verdict kUnbounded by one with a ray, if there is one.
  void confirm_unbounded(const Eigen::VectorXd& d);

  const Posture& posture_;
  WrenchProgram program_;
  std::unique_ptr<Measure> measure_;
  Capability capability_;
  Verdict verdict_;
  Eigen::VectorXd ray_;
  Residual residual_;
  int programs_ = 0;
};

}  // namespace maxwrench
