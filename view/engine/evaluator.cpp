#include "view/engine/evaluator.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "maxwrench/measure.h"
#include "maxwrench/posture.h"
#include "maxwrench/wrench_program.h"
#include "solvers/solve/format.h"
#include "solvers/solve/method.h"

namespace maxwrench {
namespace {

/// Writes a pose as a 3x4 matrix by rows.
void put_pose(const Pose<double>& pose, Eigen::Ref<Eigen::VectorXd> to) {
  Eigen::Map<Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> matrix(to.data());
  matrix << pose.R, pose.p;
}

/// The valid IK solution whose joints are nearest to `near`.
int nearest_solution(PostureEvaluator& model, const Eigen::VectorXd& near) {
  int best = 0;
  double least = kInfinity;
  for (int i = 0; i < model.ik_solutions(); ++i) {
    const double distance = (model.select(i).q - near).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    best = i;
  }
  return best;
}

void require_choice(const Problem& problem, const SolutionChoice& which) {
  const auto joints = static_cast<Eigen::Index>(problem.robot.joints.size());
  if (which.near.size() == 0 || (which.near.size() == joints && which.near.allFinite())) return;
  throw std::invalid_argument("near: got " + std::to_string(which.near.size()) +
                              " numbers, expected " + std::to_string(joints) + " finite ones");
}

}  // namespace

struct TaskEvaluator::Evaluator {
  Evaluator(const Problem& p, const EvaluationChoice& choice)
      : problem(p),
        lower([&] {
          Case c;
          c.measure = choice.measure;
          c.wrench = choice.wrench;
          return resolve_lower_level(p, c);
        }()),
        model(p, choice.collision),
        program(make_wrench_program(p, choice.wrench)),
        measure(lower.make_measure()) {}

  int chosen(const SolutionChoice& which) {
    if (which.number >= model.ik_solutions()) {
      throw std::invalid_argument("solution: got " + std::to_string(which.number) +
                                  ", expected 0 to " + std::to_string(model.ik_solutions() - 1));
    }
    return which.number >= 0 ? which.number : nearest_solution(model, which.near);
  }

  /// Evaluates the measure at the IK solution that is chosen, or at the best one. `model` stays on
  /// it.
  const Posture& evaluate_at(const Eigen::VectorXd& theta_r, const SolutionChoice& which,
                             Evaluation& result) {
    const bool best = which.number < 0 && which.near.size() == 0;
    const Posture& posture =
        best ? evaluate_best(model, theta_r, *measure, true, program, capability)
             : model.evaluate(theta_r);
    result.solutions = 0;
    result.solution = -1;
    if (posture.status != Status::kValid) return posture;
    result.solutions = model.ik_solutions();
    result.solution = best ? nearest_solution(model, Eigen::VectorXd(posture.q)) : chosen(which);
    model.select(result.solution);
    if (best) return posture;
    set_posture(posture, program);
    measure->evaluate(posture, program, true, capability);
    return posture;
  }

  void evaluate(const Eigen::VectorXd& theta_r, const SolutionChoice& which, Evaluation& result) {
    const Posture& posture = evaluate_at(theta_r, which, result);
    static_cast<Verdict&>(result) = verdict_of(problem, posture, capability);
    result.unit = lower.unit;
    show_posture(posture, result);
    if (result.status != Status::kOptimal) return;
    result.beta = capability.beta;
    result.u = capability.u;
    if (capability.w.size() > 0) {
      result.h = capability.h;
      if (problem.contact) result.h_2 = capability.h_2;
    }
    measure->differentiate(posture, program, capability);
    result.lambda = capability.lambda;
    model.pull_back(theta_r, capability, result.gradient);
  }

  /// Fills all that does not depend on the measure, and empties the rest.
  void show_posture(const Posture& posture, Evaluation& result) const {
    result.beta = std::numeric_limits<double>::quiet_NaN();
    for (Eigen::VectorXd* each :
         {&result.u, &result.h, &result.lambda, &result.gradient, &result.h_2, &result.contact}) {
      each->resize(0);
    }
    result.theta = posture.q;
    result.theta_r = posture.theta_r;
    result.tau_d = posture.tau_d;
    result.base.resize(6);
    result.base << posture.base.p, rpy(posture.base.R);
    result.links.resize(12 * static_cast<Eigen::Index>(posture.links.size()));
    for (std::size_t i = 0; i < posture.links.size(); ++i) {
      put_pose(posture.base * posture.links[i],
               result.links.segment<12>(12 * static_cast<Eigen::Index>(i)));
    }
    const EndEffector& tool =
        problem.robot.end_effectors[static_cast<std::size_t>(problem.end_effector)];
    result.end_effector.resize(12);
    put_pose(posture.base * posture.links[static_cast<std::size_t>(tool.link)] * tool.placement,
             result.end_effector);
    result.c.resize(6);
    result.c << posture.turn * problem.c.head<3>(), posture.turn * problem.c.tail<3>();
    if (!problem.contact) return;
    result.contact.resize(12);
    put_pose(posture.contact, result.contact);
  }

  const Problem& problem;
  LowerLevel lower;
  PostureEvaluator model;
  WrenchProgram program;
  std::unique_ptr<Measure> measure;
  Capability capability;
};

TaskEvaluator::TaskEvaluator(Problem problem) : problem_(std::move(problem)) {}
TaskEvaluator::~TaskEvaluator() = default;

TaskEvaluator::Evaluator& TaskEvaluator::evaluator_for(const EvaluationChoice& choice) {
  std::unique_ptr<Evaluator>& found =
      evaluators_[{choice.measure, choice.wrench, choice.collision}];
  if (!found) found = std::make_unique<Evaluator>(problem_, choice);
  return *found;
}

const Evaluation& TaskEvaluator::evaluate(const Eigen::VectorXd& theta_r,
                                          const EvaluationChoice& choice,
                                          const SolutionChoice& which) {
  require_choice(problem_, which);
  evaluator_for(choice).evaluate(theta_r, which, evaluation_);
  return evaluation_;
}

}  // namespace maxwrench
