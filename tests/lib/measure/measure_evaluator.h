#pragma once

#include <memory>
#include <string>

#include "maxwrench/measure.h"
#include "maxwrench/posture.h"
#include "maxwrench/wrench_program.h"
#include "solvers/solve/method.h"

namespace maxwrench {

/// One measure at many postures of one problem.
class MeasureEvaluator {
 public:
  MeasureEvaluator(const Problem& problem, const std::string& measure, Wrench wrench,
                   const std::string& lp = "")
      : model_(problem, false),
        program_(make_wrench_program(problem, wrench)),
        measure_(resolve(problem, {problem.name, measure, wrench, lp}).make_measure()) {}

  const Capability& operator()(const Eigen::VectorXd& theta_r, bool efforts = false) {
    const Posture& posture = model_.evaluate(theta_r);
    set_posture(posture, program_);
    measure_->evaluate(posture, program_, efforts, capability_);
    return capability_;
  }
  /// Of the last evaluation, which was at theta_r.
  Eigen::VectorXd gradient(const Eigen::VectorXd& theta_r) {
    Eigen::VectorXd gradient;
    model_.pull_back(theta_r, capability_, gradient);
    return gradient;
  }
  const WrenchProgram& program() const { return program_; }

 private:
  PostureEvaluator model_;
  WrenchProgram program_;
  std::unique_ptr<Measure> measure_;
  Capability capability_;
};

}  // namespace maxwrench
