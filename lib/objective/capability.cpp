#include <limits>

#include "lib/best_branch.h"
#include "lib/objective.h"
#include "lib/posture.h"
#include "lib/redundancy.h"
#include "lib/wrench_program.h"

namespace maxwrench {
namespace {

class CapabilityObjective : public Objective {
 public:
  CapabilityObjective(const Problem& problem, Wrench wrench, MeasureMaker make, bool check,
                      std::shared_ptr<BranchTally> tally)
      : problem_(problem),
        wrench_(wrench),
        make_(std::move(make)),
        check_collision_(check),
        model_(problem, check),
        program_(make_wrench_program(problem, wrench)),
        measure_(make_()),
        tally_(std::move(tally)) {}

  const Eigen::VectorXd& lower() const override { return problem_.theta_r_min; }
  const Eigen::VectorXd& upper() const override { return problem_.theta_r_max; }
  Status status() const override { return status_; }
  const char* reason() const override { return reason_; }

  double evaluate(const Eigen::VectorXd& theta_r, Eigen::VectorXd* gradient) override {
    const Posture& posture =
        evaluate_best(model_, theta_r, *measure_, false, program_, capability_);
    if (tally_) tally_->add(posture.branches);
    status_ = posture.status;
    reason_ = posture.reason;
    if (status_ == Status::kOptimal) {
      status_ = capability_.status;
      reason_ = capability_.reason;
    }
    if (status_ != Status::kOptimal) {
      if (gradient) gradient->setConstant(theta_r.size(), std::numeric_limits<double>::quiet_NaN());
      return -kInfinity;
    }
    if (gradient) model_.pull_back(theta_r, capability_, *gradient);
    return capability_.beta;
  }

  /// A_r'A_r of eq:redundantJacobian: |theta_dot|^2 of the motion that theta_r_dot makes.
  void metric(const Eigen::VectorXd& theta_r, Eigen::MatrixXd& M) override {
    const Posture& posture =
        evaluate_best(model_, theta_r, *measure_, false, program_, capability_);
    null_motion(problem_, posture, A_r_);
    M.noalias() = A_r_.transpose() * A_r_;
  }

  std::unique_ptr<Objective> clone() const override {
    return make_capability_objective(problem_, wrench_, make_, check_collision_, tally_);
  }

 private:
  const Problem& problem_;
  Wrench wrench_;
  MeasureMaker make_;
  bool check_collision_;
  PostureModel model_;
  WrenchProgram program_;
  std::unique_ptr<Measure> measure_;
  std::shared_ptr<BranchTally> tally_;
  Capability capability_;
  Eigen::MatrixXd A_r_;
  Status status_ = Status::kNumericalError;
  const char* reason_ = "";
};

}  // namespace

void BranchTally::add(const BranchCounts& counts) {
  unreachable_ += counts.unreachable;
  found_ += counts.found;
  beyond_limit_ += counts.beyond_limit;
  singular_ += counts.singular;
  collision_ += counts.collision;
}

BranchCounts BranchTally::sum() const {
  return {unreachable_, found_, beyond_limit_, singular_, collision_};
}

std::unique_ptr<Objective> make_capability_objective(const Problem& problem, Wrench wrench,
                                                     MeasureMaker make, bool check_collision,
                                                     std::shared_ptr<BranchTally> tally) {
  return std::make_unique<CapabilityObjective>(problem, wrench, std::move(make), check_collision,
                                               std::move(tally));
}

}  // namespace maxwrench
