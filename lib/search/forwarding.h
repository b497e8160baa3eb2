#pragma once

#include <memory>
#include <utility>

#include "maxwrench/objective.h"

namespace maxwrench {

/// Forwards to another objective. Derived classes override what they change.
class ForwardingObjective : public Objective {
 public:
  explicit ForwardingObjective(std::unique_ptr<Objective> objective)
      : objective_(std::move(objective)) {}

  const Eigen::VectorXd& lower() const override { return objective_->lower(); }
  const Eigen::VectorXd& upper() const override { return objective_->upper(); }
  double evaluate(const Eigen::VectorXd& theta_r, Eigen::VectorXd* gradient) override {
    return objective_->evaluate(theta_r, gradient);
  }
  const KnotRows* rows() const override { return objective_->rows(); }
  void metric(const Eigen::VectorXd& theta_r, Eigen::MatrixXd& M) override {
    objective_->metric(theta_r, M);
  }
  const Verdict& verdict() const override { return objective_->verdict(); }

 protected:
  std::unique_ptr<Objective> objective_;
};

}  // namespace maxwrench
