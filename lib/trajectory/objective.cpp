#include "maxwrench/objective.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "lib/trajectory/instant_evaluator.h"
#include "maxwrench/problem.h"
#include "maxwrench/trajectory.h"

namespace maxwrench {
namespace {

class ObjectiveOfTrajectories final : public TrajectoryObjective, public InstantSource {
 public:
  ObjectiveOfTrajectories(const Problem& problem, Wrench wrench, TrajectorySolverMaker make,
                          bool check, TrajectoryValue counts)
      : problem_(problem),
        wrench_(wrench),
        make_(std::move(make)),
        check_(check),
        evaluator_(problem, wrench, make_, check),
        counts_(evaluator_.smooth() ? counts : TrajectoryValue::kAtInstants),
        lower_(problem.theta_r_min.replicate(evaluator_.knots(), 1)),
        upper_(problem.theta_r_max.replicate(evaluator_.knots(), 1)) {}

  const Eigen::VectorXd& lower() const override { return lower_; }
  const Eigen::VectorXd& upper() const override { return upper_; }
  const Verdict& verdict() const override { return verdict_; }
  const KnotRows* rows() const override { return &evaluator_.rows(); }
  TrajectoryEvaluator& trajectories() override { return evaluator_; }
  TrajectoryValue counts() const override { return counts_; }

  double evaluate(const Eigen::VectorXd& x, Eigen::VectorXd* gradient) override {
    if (x.size() != lower_.size()) {
      throw std::invalid_argument("theta_r: got " + std::to_string(x.size()) +
                                  " numbers, expected " + std::to_string(lower_.size()) + " for " +
                                  problem_.name);
    }
    const double at_instants = evaluator_.evaluate_elastic(unstacked(x, evaluator_.knots()),
                                                           gradient ? &gradient_ : nullptr);
    verdict_ = evaluator_.trajectory();
    const bool enough = at_instants == -kInfinity || counts_ == TrajectoryValue::kAtInstants;
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
    const Trajectory& trajectory = evaluator_.evaluate(unstacked(x, evaluator_.knots()));
    verdict_ = trajectory;
    if (trajectory.status != Status::kOptimal) return -kInfinity;
    evaluator_.evaluate_between_knots();
    if (!std::isnan(trajectory.value_between_knots))
      return std::min(at_instants, trajectory.value_between_knots);
    verdict_.conclude(Status::kInfeasible, trajectory.between_knots_reason.c_str());
    return -kInfinity;
  }

  std::unique_ptr<TrajectoryObjective> copy(TrajectoryValue counts) const override {
    return make_trajectory_objective(problem_, wrench_, make_, check_, counts);
  }
  std::unique_ptr<InstantEvaluator> make_instants(
      const InstantEvaluator::SolverMaker& make) const override {
    return std::make_unique<InstantEvaluator>(problem_, wrench_, make, check_);
  }

 private:
  const Problem& problem_;
  Wrench wrench_;
  TrajectorySolverMaker make_;
  bool check_;
  TrajectoryEvaluator evaluator_;
  TrajectoryValue counts_;
  Eigen::VectorXd lower_, upper_;
  Eigen::MatrixXd gradient_;
  Verdict verdict_;
};

}  // namespace

Eigen::VectorXd theta_r_at(const Problem& problem, const Instant& instant) {
  return instant.q(problem.redundant);
}

int knots_of(const Problem& problem) {
  if (!problem.motion) return 1;
  return problem.motion->k - (problem.motion->transfer ? 2 : 0);
}

Eigen::MatrixXd constant_knots(const Problem& problem, const Eigen::VectorXd& theta_r) {
  return theta_r.transpose().replicate(knots_of(problem), 1);
}

Eigen::MatrixXd default_knots(const Problem& problem) {
  if (!problem.motion || !problem.motion->transfer) {
    return constant_knots(problem, problem.theta_r_default);
  }
  const MotionTask& task = *problem.motion;
  Eigen::MatrixXd knots(knots_of(problem), problem.redundancy());
  for (Eigen::Index i = 0; i < knots.rows(); ++i) {
    const double s = static_cast<double>(i + 1) / (task.k - 1);
    knots.row(i) = task.theta_0 + s * s * (3 - 2 * s) * (task.theta_T - task.theta_0);
  }
  return knots;
}

Eigen::MatrixXd unstacked(const Eigen::VectorXd& x, Eigen::Index knots) {
  return x.reshaped<Eigen::RowMajor>(knots, x.size() / knots);
}

Eigen::VectorXd stacked(const Eigen::MatrixXd& knots) { return knots.reshaped<Eigen::RowMajor>(); }

std::unique_ptr<TrajectoryObjective> make_trajectory_objective(const Problem& problem,
                                                               Wrench wrench,
                                                               const TrajectorySolverMaker& make,
                                                               bool check_collision,
                                                               TrajectoryValue counts) {
  return std::make_unique<ObjectiveOfTrajectories>(problem, wrench, make, check_collision, counts);
}

}  // namespace maxwrench
