#include "maxwrench/objective.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include "lib/trajectory/instant_evaluator.h"
#include "lib/trajectory/task_of.h"
#include "lib/trajectory/window_evaluator.h"
#include "maxwrench/problem.h"
#include "maxwrench/trajectory.h"

namespace maxwrench {
namespace {

/// Knots and instants per interval of the coarser objective. Five knots or more are coarsened.
constexpr int kCoarseKnots = 4, kCoarseInstants = 2;

class ObjectiveOfTrajectories final : public TrajectoryObjective, public InstantSource {
 public:
  ObjectiveOfTrajectories(const Problem& problem, Wrench wrench, TrajectorySolverMaker make,
                          bool check, TrajectoryValue counts,
                          std::shared_ptr<const Problem> owned = nullptr)
      : owned_(std::move(owned)),
        problem_(problem),
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
  const Problem& problem() const { return problem_; }
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
    return std::make_unique<ObjectiveOfTrajectories>(problem_, wrench_, make_, check_, counts,
                                                     owned_);
  }

  std::unique_ptr<TrajectoryObjective> coarser() const override {
    const bool between = evaluator_.starts() || !problem_.motion || problem_.motion->transfer;
    if (between || !evaluator_.smooth() || problem_.motion->k <= kCoarseKnots) return nullptr;
    auto coarse = std::make_shared<Problem>(problem_);
    coarse->motion->k = kCoarseKnots;
    coarse->motion->instants_per_interval = kCoarseInstants;
    const Problem& task = *coarse;
    return std::make_unique<ObjectiveOfTrajectories>(
        task, wrench_, make_, check_, TrajectoryValue::kAtInstants, std::move(coarse));
  }
  std::unique_ptr<InstantEvaluator> make_instants(
      const InstantEvaluator::SolverMaker& make) const override {
    return std::make_unique<InstantEvaluator>(problem_, wrench_, make, check_);
  }
  std::unique_ptr<WindowEvaluator> make_window(SchemeMaps maps) const override {
    return std::make_unique<WindowEvaluator>(problem_, wrench_, make_, check_, std::move(maps));
  }

 private:
  std::shared_ptr<const Problem> owned_;  ///< the problem of a coarser objective; else null
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

const Problem& task_of(const TrajectoryObjective& objective) {
  const auto* made = dynamic_cast<const ObjectiveOfTrajectories*>(&objective);
  if (made) return made->problem();
  throw std::invalid_argument(
      "objective: got one of another kind, expected one of make_trajectory_objective");
}

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
