#include <gtest/gtest.h>

#include "maxwrench/load.h"
#include "maxwrench/plan.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"

namespace maxwrench {
namespace {

/// An objective that has no value any more after so many evaluations of all its clones together, as
/// one that somebody interrupts.
class Ending final : public Objective {
 public:
  Ending(std::unique_ptr<Objective> objective, std::shared_ptr<long> left)
      : objective_(std::move(objective)), left_(std::move(left)) {}

  const Eigen::VectorXd& lower() const override { return objective_->lower(); }
  const Eigen::VectorXd& upper() const override { return objective_->upper(); }
  const Verdict& verdict() const override { return objective_->verdict(); }
  bool ended() const override { return *left_ <= 0; }
  PlanEvaluator* plans() override { return objective_->plans(); }
  double evaluate(const Eigen::VectorXd& x, Eigen::VectorXd* gradient) override {
    if (--*left_ >= 0) return objective_->evaluate(x, gradient);
    if (gradient) gradient->setConstant(x.size(), std::numeric_limits<double>::quiet_NaN());
    return -kInfinity;
  }
  std::unique_ptr<Objective> clone() const override {
    return std::make_unique<Ending>(objective_->clone(), left_);
  }

 private:
  std::unique_ptr<Objective> objective_;
  std::shared_ptr<long> left_;
};

TEST(PlanInterruption, EndsASearchSoonWithWhatItHas) {
  const Problem problem = load_problem("planar/trajectory");
  for (const char* name : {"slp", "joint_nlp", "multistart"}) {
    for (const long evaluations : {0, 1, 2, 5, 19, 20, 21, 25, 40, 80, 150}) {
      const auto left = std::make_shared<long>(evaluations);
      Ending objective(
          make_plan_objective(problem, Wrench::kPure, find_plan_solver("structured").make), left);
      SearchOptions options;
      options.budget = 200;
      options.start = problem.theta_r_default.replicate(problem.motion->k, 1);
      const SearchResult result = find_plan_search(name).make()->maximize(objective, options);
      EXPECT_EQ(result.status, evaluations == 0 ? Status::kNoneFound : Status::kBestFound)
          << name << ' ' << evaluations;
      EXPECT_LE(result.evaluations, options.budget);
      EXPECT_GT(*left, -100) << name << ' ' << evaluations;
    }
  }
}

TEST(PlanInterruption, NothingIsLinearisedBeforeAnEvaluation) {
  const Problem problem = load_problem("planar/trajectory");
  PlanEvaluator plans(problem, Wrench::kPure, find_plan_solver("structured").make);
  EXPECT_THROW(plans.linearize(), std::logic_error);
}

}  // namespace
}  // namespace maxwrench
