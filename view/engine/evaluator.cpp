#include "view/engine/evaluator.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "maxwrench/measure.h"
#include "maxwrench/posture.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"
#include "maxwrench/wrench_program.h"
#include "solvers/solve/format.h"
#include "solvers/solve/method.h"
#include "solvers/solve/one_instant.h"

namespace maxwrench {
namespace {

/// Writes a pose as a 3x4 matrix by rows.
void put_pose(const Pose<double>& pose, Eigen::Ref<Eigen::VectorXd> to) {
  Eigen::Map<Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> matrix(to.data());
  matrix << pose.R, pose.p;
}

Case case_of(const Problem& problem, const EvaluationChoice& choice) {
  Case c;
  c.problem = problem.name;
  c.measure = choice.measure;
  c.wrench = choice.wrench;
  return c;
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
        collision(choice.collision && p.robot.collision != nullptr),
        case_(case_of(p, choice)),
        lower(resolve_lower_level(p, case_)),
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
    posture_ = &posture;
    static_cast<Verdict&>(result) = verdict_of(problem, posture, capability);
    result.unit = lower.unit;
    show_posture(posture, result);
    if (result.status != Status::kOptimal) return;
    result.beta = capability.beta;
    if (!problem.scenarios.empty()) result.c = capability.decides.c.stableNormalized();
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

  /// `result` is that of the last evaluation.
  Answer answer(std::shared_ptr<const Problem> task, const Evaluation& result) const {
    Answer answer;
    static_cast<Verdict&>(answer) = result;
    answer.task = std::move(task);
    answer.choice = case_;
    answer.choice.solver = lower.solver;
    answer.unit = lower.unit;
    answer.evaluations = 1;
    answer.collision = collision;
    answer.posture = *posture_;
    answer.capability = capability;
    answer.trajectory = one_instant(problem, *posture_, capability, result.gradient);
    return answer;
  }

  const Problem& problem;
  bool collision;
  Case case_;
  LowerLevel lower;
  PostureEvaluator model;
  WrenchProgram program;
  std::unique_ptr<Measure> measure;
  Capability capability;
  const Posture* posture_ = nullptr;
};

struct TaskEvaluator::KnotsEvaluator {
  KnotsEvaluator(const Problem& problem, const EvaluationChoice& choice)
      : case_(case_of(problem, choice)),
        unit(problem.unit()),
        evaluator(problem, choice.wrench, trajectory_solvers().front().make, choice.collision) {
    if (choice.measure != Case().measure) {
      throw std::invalid_argument("measure: got '" + choice.measure + "', expected " +
                                  Case().measure + ": a task in time supports no other measure");
    }
    case_.solver = trajectory_solvers().front().name;
    case_.scheme = to_string(problem.motion->scheme);
  }

  Answer answer(std::shared_ptr<const Problem> task) const {
    Answer answer;
    answer.task = std::move(task);
    answer.choice = case_;
    answer.unit = unit;
    answer.evaluations = 1;
    answer.trajectory = evaluator.trajectory();
    static_cast<Verdict&>(answer) = answer.trajectory;
    answer.program = evaluator.program();
    return answer;
  }

  Case case_;
  const char* unit;
  TrajectoryEvaluator evaluator;
};

TaskEvaluator::TaskEvaluator(Problem problem)
    : problem_(std::make_shared<const Problem>(std::move(problem))) {}
TaskEvaluator::~TaskEvaluator() = default;

const Evaluation& TaskEvaluator::evaluate(const Eigen::VectorXd& theta_r,
                                          const EvaluationChoice& choice,
                                          const SolutionChoice& which) {
  if (problem_->motion) {
    throw std::invalid_argument("theta_r: got a posture of a task in time, expected its knots");
  }
  require_choice(*problem_, which);
  last_ = {};
  std::unique_ptr<Evaluator>& found =
      evaluators_[{choice.measure, choice.wrench, choice.collision}];
  if (!found) found = std::make_unique<Evaluator>(*problem_, choice);
  found->evaluate(theta_r, which, evaluation_);
  last_ = [this, evaluator = found.get()] { return evaluator->answer(problem_, evaluation_); };
  return evaluation_;
}

void TaskEvaluator::evaluate_knots(const Eigen::MatrixXd& knots, const EvaluationChoice& choice) {
  if (!problem_->motion) {
    throw std::invalid_argument("theta_r: got knots of a static task, expected a posture");
  }
  last_ = {};
  std::unique_ptr<KnotsEvaluator>& found =
      knots_evaluators_[{choice.measure, choice.wrench, choice.collision}];
  if (!found) found = std::make_unique<KnotsEvaluator>(*problem_, choice);
  found->evaluator.evaluate(knots);
  last_ = [this, evaluator = found.get()] { return evaluator->answer(problem_); };
}

Answer TaskEvaluator::answer() const {
  if (!last_) throw std::invalid_argument("engine: got no evaluation, expected one before");
  return last_();
}

}  // namespace maxwrench
