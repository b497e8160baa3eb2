#pragma once

#include <limits>
#include <memory>
#include <utility>

#include "maxwrench/objective.h"

// Objectives that differ from another one in a single thing.

namespace maxwrench {

/// The other one, with its plans and facets.
class Wrapped : public Objective {
 public:
  explicit Wrapped(std::unique_ptr<Objective> objective) : objective_(std::move(objective)) {}

  const Eigen::VectorXd& lower() const override { return objective_->lower(); }
  const Eigen::VectorXd& upper() const override { return objective_->upper(); }
  const Verdict& verdict() const override { return objective_->verdict(); }
  bool ended() const override { return objective_->ended(); }
  PlanEvaluator* plans() override { return objective_->plans(); }
  FacetProgram* facets() override { return objective_->facets(); }
  double evaluate(const Eigen::VectorXd& x, Eigen::VectorXd* gradient) override {
    return objective_->evaluate(x, gradient);
  }

 protected:
  std::unique_ptr<Objective> objective_;
};

/// Has no value any more after so many evaluations of all its clones together, as one that somebody
/// interrupts.
class Ending final : public Wrapped {
 public:
  Ending(std::unique_ptr<Objective> objective, std::shared_ptr<long> left)
      : Wrapped(std::move(objective)), left_(std::move(left)) {}

  bool ended() const override { return *left_ <= 0; }
  double evaluate(const Eigen::VectorXd& x, Eigen::VectorXd* gradient) override {
    if (--*left_ >= 0) return objective_->evaluate(x, gradient);
    if (gradient) gradient->setConstant(x.size(), std::numeric_limits<double>::quiet_NaN());
    return -kInfinity;
  }
  std::unique_ptr<Objective> clone() const override {
    return std::make_unique<Ending>(objective_->clone(), left_);
  }

 private:
  std::shared_ptr<long> left_;
};

/// Has other bounds.
class OtherBounds final : public Wrapped {
 public:
  OtherBounds(std::unique_ptr<Objective> objective, Eigen::VectorXd lower, Eigen::VectorXd upper)
      : Wrapped(std::move(objective)), lower_(std::move(lower)), upper_(std::move(upper)) {}

  const Eigen::VectorXd& lower() const override { return lower_; }
  const Eigen::VectorXd& upper() const override { return upper_; }
  std::unique_ptr<Objective> clone() const override {
    return std::make_unique<OtherBounds>(objective_->clone(), lower_, upper_);
  }

 private:
  Eigen::VectorXd lower_, upper_;
};

}  // namespace maxwrench
