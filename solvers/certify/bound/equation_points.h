#pragma once

#include <vector>

#include "solvers/certify/bound/multi_affine.h"

namespace maxwrench {

struct LoopModel;
struct LoopPart;

/// The signs of the equations over boxes, from their control points.
class EquationPoints {
 public:
  /// Keeps a reference to the model.
  explicit EquationPoints(const LoopModel& model);
  explicit EquationPoints(const LoopModel&&) = delete;

  /// 1 if nu'f > 0 in all of a box, even with rounding errors; -1 if nu'f < 0; 0 if neither is
  /// proven.
  int sign(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, const Eigen::VectorXd& nu);

 private:
  const LoopModel& model_;
  std::vector<const LoopPart*> parts_;
  std::vector<ControlPoints> corners_;
  Eigen::VectorXd own_, values_;
};

}  // namespace maxwrench
