#pragma once

#include <vector>

#include "maxwrench/bound.h"
#include "solvers/certify/bound/bound_points.h"
#include "solvers/certify/bound/equation_points.h"
#include "solvers/certify/bound/loop_box.h"
#include "solvers/certify/bound/loop_linear.h"
#include "solvers/certify/bound/multiplier_program.h"

namespace maxwrench {

/// The linear program that looks for a nu with nu'f > 0 in all of a box, so that no x in it
/// satisfies f(x) = 0. Control points of f are added in rounds.
class EquationProgram {
 public:
  /// Keeps a reference to the model.
  explicit EquationProgram(const LoopModel& model);
  explicit EquationProgram(const LoopModel&&) = delete;

  /// If it finds such a nu, stores it in the proof and returns true. Requires that `box.set` and
  /// `linear.precondition` had this box. Overwrites `box.g()` and `box.h()`.
  bool exclude(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, LoopBox& box,
               const LoopLinear& linear, BoxProof& proof);

 private:
  bool find(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, LoopBox& box,
            const LoopLinear& linear);
  void write_points(Eigen::Index first, LoopBox& box, const LoopLinear& linear);

  const LoopModel& model_;
  MultiplierProgram program_;
  ProgramPoints corners_, points_;
  EquationPoints signs_;
  std::vector<int> basis_;
  Eigen::VectorXd no_lambda_, nu_, solved_, violations_, entries_;
};

}  // namespace maxwrench
