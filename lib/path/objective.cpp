#include "maxwrench/objective.h"

#include <stdexcept>
#include <string>

#include "maxwrench/plan.h"
#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

class PlanObjective : public Objective {
 public:
  PlanObjective(const Problem& problem, Wrench wrench, PlanSolverMaker make, bool check)
      : problem_(problem),
        wrench_(wrench),
        make_(std::move(make)),
        check_(check),
        evaluator_(problem, wrench, make_, check),
        lower_(problem.theta_r_min.replicate(evaluator_.knots(), 1)),
        upper_(problem.theta_r_max.replicate(evaluator_.knots(), 1)) {}

  const Eigen::VectorXd& lower() const override { return lower_; }
  const Eigen::VectorXd& upper() const override { return upper_; }
  const Verdict& verdict() const override { return evaluator_.plan(); }
  PlanEvaluator* plans() override { return &evaluator_; }

  double evaluate(const Eigen::VectorXd& x, Eigen::VectorXd* gradient) override {
    if (x.size() != lower_.size()) {
      throw std::invalid_argument("theta_r: got " + std::to_string(x.size()) +
                                  " numbers, expected " + std::to_string(lower_.size()) + " for " +
                                  problem_.name);
    }
    const double value = evaluator_.evaluate_elastic(unstacked(x, evaluator_.knots()),
                                                     gradient ? &gradient_ : nullptr);
    if (gradient) {
      if (value == -kInfinity) {
        gradient->setConstant(x.size(), std::numeric_limits<double>::quiet_NaN());
      } else {
        *gradient = stacked(gradient_);
      }
    }
    return value;
  }

  std::unique_ptr<Objective> clone() const override {
    return make_plan_objective(problem_, wrench_, make_, check_);
  }

 private:
  const Problem& problem_;
  Wrench wrench_;
  PlanSolverMaker make_;
  bool check_;
  PlanEvaluator evaluator_;
  Eigen::VectorXd lower_, upper_;
  Eigen::MatrixXd gradient_;
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

std::unique_ptr<Objective> make_plan_objective(const Problem& problem, Wrench wrench,
                                               const PlanSolverMaker& make, bool check_collision) {
  return std::make_unique<PlanObjective>(problem, wrench, make, check_collision);
}

}  // namespace maxwrench
