#include "solvers/solve/interruption.h"

#include <limits>

namespace maxwrench {
namespace {

class Interruptible final : public Objective {
 public:
  Interruptible(std::unique_ptr<Objective> objective, Interruption& interruption)
      : objective_(std::move(objective)), interruption_(interruption) {
    end_.conclude(Status::kBudgetExhausted, "interrupted");
  }

  const Eigen::VectorXd& lower() const override { return objective_->lower(); }
  const Eigen::VectorXd& upper() const override { return objective_->upper(); }
  const Verdict& verdict() const override { return skipped_ ? end_ : objective_->verdict(); }
  bool ended() const override {
    const bool asked = interruption_.asked();
    if (asked) interruption_.noticed = true;
    return asked;
  }
  void spend(long evaluations) override { objective_->spend(evaluations); }
  PlanEvaluator* plans() override { return objective_->plans(); }
  FacetProgram* facets() override { return objective_->facets(); }
  void metric(const Eigen::VectorXd& theta_r, Eigen::MatrixXd& M) override {
    objective_->metric(theta_r, M);
  }
  double evaluate(const Eigen::VectorXd& theta_r, Eigen::VectorXd* gradient) override {
    skipped_ = interruption_.asked();
    if (!skipped_) return objective_->evaluate(theta_r, gradient);
    interruption_.noticed = true;
    ++interruption_.skipped;
    if (gradient) gradient->setConstant(theta_r.size(), std::numeric_limits<double>::quiet_NaN());
    return -kInfinity;
  }
  std::unique_ptr<Objective> clone() const override {
    return std::make_unique<Interruptible>(objective_->clone(), interruption_);
  }

 private:
  std::unique_ptr<Objective> objective_;
  Interruption& interruption_;
  Verdict end_;
  bool skipped_ = false;  ///< the last evaluation
};

}  // namespace

std::unique_ptr<Objective> make_interruptible(std::unique_ptr<Objective> objective,
                                              Interruption& interruption) {
  if (!interruption.asked) return objective;
  return std::make_unique<Interruptible>(std::move(objective), interruption);
}

}  // namespace maxwrench
