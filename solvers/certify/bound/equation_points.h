#pragma once

#include <vector>

#include "solvers/certify/bound/multi_affine.h"

namespace maxwrench {

struct LoopModel;
struct LoopPart;

/// The equations over boxes, by their control points.
class EquationPoints {
 public:
  /// Keeps a reference.
  explicit EquationPoints(const LoopModel& model);
  explicit EquationPoints(const LoopModel&&) = delete;

  /// 1 if nu'f > 0 in all of a box, with room for what rounding may do to it; -1 if it is < 0; 0:
  /// not known.
  int sign(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, const Eigen::VectorXd& nu);

 private:
  const LoopModel& model_;
  std::vector<const LoopPart*> parts_;
  std::vector<ControlPoints> corners_;
  Eigen::VectorXd own_, values_;
};

}  // namespace maxwrench
