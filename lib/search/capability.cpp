#include <limits>

#include "lib/posture/redundancy.h"
#include "lib/search/facet_program.h"
#include "maxwrench/measure.h"
#include "maxwrench/objective.h"
#include "maxwrench/posture.h"
#include "maxwrench/problem.h"
#include "maxwrench/wrench_program.h"

namespace maxwrench {
namespace {

class CapabilityObjective final : public FacetObjective {
 public:
  CapabilityObjective(const Problem& problem, Wrench wrench, MeasureMaker make, bool check,
                      std::shared_ptr<Tally> tally)
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
  const Verdict& verdict() const override { return *verdict_; }

  double evaluate(const Eigen::VectorXd& theta_r, Eigen::VectorXd* gradient) override {
    const Posture& posture =
        evaluate_best(model_, theta_r, *measure_, false, program_, capability_);
    posture_ = &posture;
    theta_r_ = theta_r;
    if (tally_) tally_->add(posture.ik_solutions);
    const bool valid = posture.status == Status::kValid;
    verdict_ = &capability_;
    if (!valid) verdict_ = &posture;
    if (tally_ && verdict_->status == Status::kNumericalError) tally_->add_undecided();
    if (verdict_->status != Status::kOptimal) {
      if (gradient) gradient->setConstant(theta_r.size(), std::numeric_limits<double>::quiet_NaN());
      return -kInfinity;
    }
    if (gradient) {
      measure_->differentiate(posture, program_, capability_);
      model_.pull_back(theta_r, capability_, *gradient);
    }
    return capability_.beta;
  }

  /// A_r'A_r of eq:redundantJacobian: |theta_dot|^2 as a quadratic form in theta_r_dot.
  void metric(const Eigen::VectorXd& theta_r, Eigen::MatrixXd& M) override {
    if (posture_ == nullptr || theta_r_ != theta_r) evaluate(theta_r, nullptr);
    null_motion(problem_, *posture_, A_r_);
    M.noalias() = A_r_.transpose() * A_r_;
  }

  std::unique_ptr<FacetProgram> make_facet_program() const override {
    if (!measure_->solves_program() || !has_facet_program(problem_, wrench_)) return nullptr;
    return std::make_unique<FacetProgram>(problem_, wrench_, make_, check_collision_);
  }

  std::unique_ptr<Objective> clone() const override {
    return make_capability_objective(problem_, wrench_, make_, check_collision_, tally_);
  }

 private:
  const Problem& problem_;
  Wrench wrench_;
  MeasureMaker make_;
  bool check_collision_;
  PostureEvaluator model_;
  WrenchProgram program_;
  std::unique_ptr<Measure> measure_;
  std::shared_ptr<Tally> tally_;
  Capability capability_;
  const Posture* posture_ = nullptr;  ///< of the last evaluation, at theta_r_
  Eigen::VectorXd theta_r_;
  Eigen::MatrixXd A_r_;
  const Verdict* verdict_ = &capability_;
};

}  // namespace

std::unique_ptr<Objective> make_capability_objective(const Problem& problem, Wrench wrench,
                                                     MeasureMaker make, bool check_collision,
                                                     std::shared_ptr<Tally> tally) {
  return std::make_unique<CapabilityObjective>(problem, wrench, std::move(make), check_collision,
                                               std::move(tally));
}

}  // namespace maxwrench
