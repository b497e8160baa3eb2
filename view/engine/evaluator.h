#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>

#include "maxwrench/problem.h"
#include "maxwrench/solve.h"

namespace maxwrench {

/// What is shown of a task at one theta_r and one IK solution. README.md lists the members.
struct Evaluation : Verdict {
  double beta = 0;        ///< NaN unless the status is kOptimal
  const char* unit = "";  ///< of beta
  Eigen::VectorXd theta, theta_r, base, u, h, lambda, tau_d, gradient, links, end_effector, c, h_2,
      contact;
  int solutions = 0;  ///< number of valid IK solutions
  int solution = -1;  ///< which of them this is; -1 if there is none
};

/// How postures are evaluated.
struct EvaluationChoice {
  std::string measure = Case().measure;
  Wrench wrench = Wrench::kPure;
  bool collision = true;
};

/// Which of the valid IK solutions at a theta_r is evaluated.
struct SolutionChoice {
  int number = -1;       ///< -1: the best one, or the nearest
  Eigen::VectorXd near;  ///< not empty: the one whose joints are nearest to these
};

/// Evaluates postures of a static task, or trajectories of a task in time, one after another, and
/// keeps for each choice what that needs.
class TaskEvaluator {
 public:
  explicit TaskEvaluator(Problem problem);
  TaskEvaluator(const TaskEvaluator&) = delete;
  TaskEvaluator& operator=(const TaskEvaluator&) = delete;
  ~TaskEvaluator();
  const Problem& problem() const { return *problem_; }

  /// Evaluates the task at theta_r, as `maxwrench::evaluate` does for the best IK solution.
  ///
  /// @return the result, valid until the next call
  /// @throws std::invalid_argument with one line if theta_r is not r finite numbers, the task does
  ///         not support the choice, there is no IK solution of this number among one or more, or
  ///         `near` is not one finite number for each joint.
  const Evaluation& evaluate(const Eigen::VectorXd& theta_r, const EvaluationChoice& choice,
                             const SolutionChoice& which = {});

  /// Evaluates a table of knots (k×r) of a task in time at the instants of its scheme, as
  /// `maxwrench::evaluate` does, but neither between the knots nor the clearance there.
  ///
  /// @throws std::invalid_argument with one line if the table is not k×r finite numbers, or the
  ///         task does not support the choice.
  void evaluate_knots(const Eigen::MatrixXd& knots, const EvaluationChoice& choice);

  /// The last evaluation as `maxwrench::evaluate` returns it, without `Answer::beta_linf` and what
  /// is between knots.
  ///
  /// @throws std::invalid_argument with one line if nothing was evaluated.
  Answer answer() const;

 private:
  struct Evaluator;
  struct KnotsEvaluator;
  using Key = std::tuple<std::string, Wrench, bool>;

  std::shared_ptr<const Problem> problem_;
  std::map<Key, std::unique_ptr<Evaluator>> evaluators_;
  std::map<Key, std::unique_ptr<KnotsEvaluator>> knots_evaluators_;
  std::function<Answer()> last_;
  Evaluation evaluation_;
};

}  // namespace maxwrench
