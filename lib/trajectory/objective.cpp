#include "maxwrench/objective.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "maxwrench/problem.h"
#include "maxwrench/trajectory.h"

namespace maxwrench {
namespace {

class ObjectiveOfPlans final : public PlanObjective {
 public:
  ObjectiveOfPlans(const Problem& problem, Wrench wrench, PlanSolverMaker make, bool check,
                   PlanValue counts)
      : problem_(problem),
        wrench_(wrench),
        make_(std::move(make)),
        check_(check),
        evaluator_(problem, wrench, make_, check),
        counts_(evaluator_.smooth() ? counts : PlanValue::kAtInstants),
        lower_(problem.theta_r_min.replicate(evaluator_.knots(), 1)),
        upper_(problem.theta_r_max.replicate(evaluator_.knots(), 1)) {}

  const Eigen::VectorXd& lower() const override { return lower_; }
  const Eigen::VectorXd& upper() const override { return upper_; }
  const Verdict& verdict() const override { return verdict_; }
  const KnotRows* rows() const override { return &evaluator_.rows(); }
  PlanEvaluator& plans() override { return evaluator_; }
  PlanValue counts() const override { return counts_; }

  double evaluate(const Eigen::VectorXd& x, Eigen::VectorXd* gradient) override {
    if (x.size() != lower_.size()) {
      throw std::invalid_argument("theta_r: got " + std::to_string(x.size()) +
                                  " numbers, expected " + std::to_string(lower_.size()) + " for " +
                                  problem_.name);
    }
    const double at_instants = evaluator_.evaluate_elastic(unstacked(x, evaluator_.knots()),
                                                           gradient ? &gradient_ : nullptr);
    verdict_ = evaluator_.plan();
    const bool enough = at_instants == -kInfinity || counts_ == PlanValue::kAtInstants;
    const double value = enough ? at_instants : evaluate_throughout(x, at_instants);
    if (!gradient) return value;
    if (value > -kInfinity && value == at_instants) {
      *gradient = stacked(gradient_);
    } else {
      gradient->setConstant(x.size(), std::numeric_limits<double>::quiet_NaN());
    }
    return value;
  }

  double evaluate_throughout(const Eigen::VectorXd& x, double at_instants) override {
    const Plan& plan = evaluator_.evaluate(unstacked(x, evaluator_.knots()));
    verdict_ = plan;
    if (plan.status != Status::kOptimal) return -kInfinity;
    evaluator_.evaluate_continuous();
    if (!std::isnan(plan.continuous)) return std::min(at_instants, plan.continuous);
    verdict_.conclude(Status::kInfeasible, plan.continuous_reason.c_str());
    return -kInfinity;
  }

  std::unique_ptr<PlanObjective> copy(PlanValue counts) const override {
    return make_plan_objective(problem_, wrench_, make_, check_, counts);
  }

 private:
  const Problem& problem_;
  Wrench wrench_;
  PlanSolverMaker make_;
  bool check_;
  PlanEvaluator evaluator_;
  PlanValue counts_;
  Eigen::VectorXd lower_, upper_;
  Eigen::MatrixXd gradient_;
  Verdict verdict_;
};

}  // namespace

Eigen::VectorXd theta_r_at(const Problem& problem, const Instant& instant) {
  return instant.q(problem.redundant);
}

int knots_of(const Problem& problem) { return problem.motion ? problem.motion->k : 1; }

Eigen::MatrixXd constant_knots(const Problem& problem, const Eigen::VectorXd& theta_r) {
  return theta_r.transpose().replicate(knots_of(problem), 1);
}

Eigen::MatrixXd unstacked(const Eigen::VectorXd& x, Eigen::Index knots) {
  return x.reshaped<Eigen::RowMajor>(knots, x.size() / knots);
}

Eigen::VectorXd stacked(const Eigen::MatrixXd& knots) { return knots.reshaped<Eigen::RowMajor>(); }

std::unique_ptr<PlanObjective> make_plan_objective(const Problem& problem, Wrench wrench,
                                                   const PlanSolverMaker& make,
                                                   bool check_collision, PlanValue counts) {
  return std::make_unique<ObjectiveOfPlans>(problem, wrench, make, check_collision, counts);
}

}  // namespace maxwrench
