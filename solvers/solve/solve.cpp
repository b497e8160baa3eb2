#include "maxwrench/solve.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "lib/posture/given_posture.h"
#include "maxwrench/batch.h"
#include "maxwrench/measure.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"
#include "solvers/search/starts.h"
#include "solvers/solve/method.h"
#include "solvers/solve/one_instant.h"
#include "solvers/solve/solve_from.h"
#include "solvers/solve/too_weak.h"
#include "solvers/solve/why_none.h"

namespace maxwrench {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// An answer without a value yet.
Answer begin(std::shared_ptr<const Problem> task, const Method& method) {
  Answer answer;
  answer.task = std::move(task);
  answer.choice = method.choice;
  answer.unit = method.unit;
  return answer;
}

double beta_linf(const Problem& task, const Method& method, const Posture& posture) {
  WrenchProgram program = make_wrench_program(task, method.choice.wrench);
  set_posture(posture, program);
  Capability capability;
  method.make_beta_linf()->evaluate(posture, program, false, capability);
  return capability.status == Status::kOptimal ? capability.beta
                                               : std::numeric_limits<double>::quiet_NaN();
}

/// Fills the rest of an answer with a status, posture and capability.
void complete_posture(const Method& method, const Eigen::VectorXd& gradient,
                      Clock::time_point start, Answer& answer) {
  const Problem& task = *answer.task;
  answer.trajectory = one_instant(task, answer.posture, answer.capability, gradient);
  answer.wall_s = seconds_since(start);
  if (answer.posture.status == Status::kValid) {
    answer.beta_linf = beta_linf(task, method, answer.posture);
  }
}

void evaluate_at(const Method& method, const Eigen::VectorXd& theta_r, Answer& answer) {
  const auto start = Clock::now();
  const Problem& task = *answer.task;
  PostureEvaluator model(task, answer.collision);
  WrenchProgram program = make_wrench_program(task, method.choice.wrench);
  const auto measure = method.make_measure();
  answer.posture = evaluate_best(model, theta_r, *measure, true, program, answer.capability);
  answer.ik_solutions = answer.posture.ik_solutions;
  Eigen::VectorXd gradient;
  const bool solved =
      answer.posture.status == Status::kValid && answer.capability.status == Status::kOptimal;
  if (solved) {
    measure->differentiate(answer.posture, program, answer.capability);
    model.pull_back(theta_r, answer.capability, gradient);
  }
  static_cast<Verdict&>(answer) = verdict_of(task, answer.posture, answer.capability);
  complete_posture(method, gradient, start, answer);
}

void evaluate_trajectory(const Method& method, const Eigen::MatrixXd& knots, Answer& answer) {
  const auto start = Clock::now();
  TrajectoryEvaluator evaluator(*answer.task, method.choice.wrench, method.trajectory_solver->make,
                                answer.collision);
  const Trajectory& trajectory = evaluator.evaluate(knots);
  if (trajectory.status != Status::kInvalidPosture) {
    // All rows use the same check; using a solver that takes minutes for these instants would add
    // nothing.
    const auto checker = trajectory_solvers().front().make();
    evaluator.evaluate_between_knots(checker.get());
  }
  static_cast<Verdict&>(answer) = trajectory;
  answer.trajectory = trajectory;
  answer.clearance = evaluator.least_clearance();
  answer.program = evaluator.program();
  answer.wall_s = seconds_since(start);
}

Answer evaluate(std::shared_ptr<const Problem> task, const Method& method,
                const Eigen::MatrixXd& theta_r, bool check_collision) {
  Answer answer = begin(std::move(task), method);
  answer.collision = check_collision && answer.task->robot.collision != nullptr;
  answer.evaluations = 1;
  if (answer.task->motion) {
    const bool throughout = theta_r.size() == answer.task->redundancy();
    evaluate_trajectory(
        method, throughout ? constant_knots(*answer.task, stacked(theta_r)) : theta_r, answer);
  } else {
    evaluate_at(method, stacked(theta_r), answer);
  }
  return answer;
}

std::vector<CallCount> count_calls(const std::vector<Call>& calls) {
  std::vector<CallCount> counts;
  for (const Call& call : calls) {
    const auto same = std::find_if(counts.begin(), counts.end(), [&](const CallCount& count) {
      return count.method == call.method && count.status == call.status;
    });
    CallCount& count = same != counts.end()
                           ? *same
                           : counts.emplace_back(CallCount{call.method, call.status, 0, 0});
    ++count.calls;
    count.evaluations += call.evaluations;
  }
  return counts;
}

/// Turns the answer of a posture or trajectory into the answer of the search that found it: with
/// its effort and its status, because `optimal` is a status of the lower level.
void conclude_search(const SearchResult& result, Answer& answer) {
  answer.evaluations = result.evaluations;
  answer.calls = count_calls(result.calls);
  answer.stopped = result.interrupted                          ? "interrupted"
                   : !result.stopped.empty()                   ? result.stopped
                   : result.evaluations < answer.choice.budget ? "the method ended"
                                                               : kBudgetSpent;
  if (answer.status == Status::kOptimal) answer.conclude(Status::kBestFound);
  if (answer.status == Status::kInfeasible) {  // holds for what was found, not for the task
    answer.conclude(Status::kNoneFound, "of the best that was found: " + answer.reason.str());
  }
  if (result.interrupted && answer.status != Status::kNumericalError) {
    answer.conclude(Status::kBudgetExhausted, "interrupted");
  }
}

}  // namespace

bool satisfies_program(const Capability& capability) {
  return capability.residual.within(kAnswerTolerance * (1 + std::abs(capability.beta)));
}

Verdict verdict_of(const Problem& problem, const Posture& posture, const Capability& capability) {
  if (posture.status != Status::kValid) {
    Verdict verdict = posture;
    verdict.reason = describe_violation(problem, posture);
    return verdict;
  }
  Verdict verdict = capability;
  if (verdict.status == Status::kOptimal && !satisfies_program(capability)) {
    verdict.conclude(Status::kNumericalError, "the answer does not satisfy its program");
  }
  return verdict;
}

Trajectory one_instant(const Problem& task, const Posture& posture, const Capability& capability,
                       const Eigen::VectorXd& gradient) {
  Trajectory trajectory;
  static_cast<Verdict&>(trajectory) =
      posture.status == Status::kValid ? Verdict(capability) : Verdict(posture);
  trajectory.knots = posture.theta_r.transpose();
  trajectory.gradient = gradient.transpose();
  Instant instant;
  instant.end_effector = pose_at(task, posture.theta_r);
  instant.base = posture.base;
  instant.q = posture.q;
  instant.v = instant.v_dot = Eigen::VectorXd::Zero(posture.tau_d.size());
  instant.tau_d = posture.tau_d;
  instant.J = posture.J;
  instant.c << posture.turn * task.c.head<3>(), posture.turn * task.c.tail<3>();
  if (trajectory.status == Status::kOptimal) {
    trajectory.value = capability.beta;
    if (!task.scenarios.empty()) instant.c = capability.decides.c.stableNormalized();
    if (capability.w.size() > 0) instant.h = capability.h;
    instant.u = capability.u;
  }
  trajectory.instants.push_back(std::move(instant));
  return trajectory;
}

void require_joints(const Problem& task, const Eigen::VectorXd& q) {
  const auto reject = [&task](const std::string& got, const std::string& expected) {
    throw std::invalid_argument("joints: got " + got + ", expected " + expected + " (" + task.name +
                                ")");
  };
  if (task.motion) reject("a task in time", "a static task");
  if (task.contact) reject("a task with a second contact", "one without");
  const std::size_t joints = task.robot.joints.size();
  if (q.size() != static_cast<Eigen::Index>(joints)) {
    reject(std::to_string(q.size()) + " numbers", std::to_string(joints));
  }
  if (!q.allFinite()) reject("a value that is not a finite number", "finite numbers");
}

bool Answer::has_value() const {
  return answered() ||
         (status == Status::kBudgetExhausted && trajectory.status == Status::kOptimal);
}

bool Answer::answered() const {
  return status == Status::kOptimal || status == Status::kBestFound || status == Status::kReached;
}

const Residual& Answer::residual() const {
  return task && task->motion ? trajectory.solution.residual : capability.residual;
}

Answer evaluate(const Problem& task, const Eigen::MatrixXd& theta_r, const Options& options) {
  const auto kept = std::make_shared<const Problem>(task);
  Case c = options;
  c.search.clear();  // the posture or trajectory is given, not searched
  return evaluate(kept, resolve(*kept, c), theta_r, options.check_collision);
}

Answer evaluate_posture(const Problem& task, const Eigen::VectorXd& q, const Options& options) {
  const auto start = Clock::now();
  require_joints(task, q);
  const auto held = std::make_shared<const Problem>(held_at_joints(task, q));
  Case c = options;
  c.search.clear();
  const Method method = resolve(*held, c);
  Answer answer = begin(held, method);
  answer.collision = options.check_collision && held->robot.collision != nullptr;
  answer.given_joints = true;
  answer.evaluations = 1;
  answer.posture = given_posture(*held, q, answer.collision);
  if (answer.posture.status == Status::kValid) {
    WrenchProgram program = make_wrench_program(*held, method.choice.wrench);
    set_posture(answer.posture, program);
    const auto measure = method.make_measure();
    measure->evaluate(answer.posture, program, true, answer.capability);
    if (answer.capability.status == Status::kOptimal) {
      measure->differentiate(answer.posture, program, answer.capability);
    }
  }
  static_cast<Verdict&>(answer) = verdict_of(*held, answer.posture, answer.capability);
  complete_posture(method, {}, start, answer);
  return answer;
}

namespace {

/// Whether a case has the search and the budget that `solve` uses if it names none.
bool has_usual_search(const Problem& task, const Case& c) {
  Case usual = c;
  usual.search.clear();
  usual.budget = 0;
  usual = with_search(task, usual);
  const Case given = with_search(task, c);
  return given.search == usual.search && given.budget == usual.budget;
}

/// The answer for a robot that is far too weak for its own load, if no other search and no other
/// budget is asked for; nothing: it may not be.
std::optional<Answer> answer_of_too_weak(const Problem& task, const Options& options) {
  if (!has_usual_search(task, options)) return std::nullopt;
  const auto start = Clock::now();
  const Method method = resolve(task, with_search(task, options));
  const TooWeak found = find_too_weak(task, method);
  if (found.why.empty()) return std::nullopt;
  Answer answer = begin(std::make_shared<const Problem>(task), method);
  answer.conclude(Status::kNoneFound, found.why);
  answer.evaluations = found.evaluations;
  answer.ik_solutions = found.ik_solutions;
  answer.stopped = "the robot is far too weak";
  answer.wall_s = seconds_since(start);
  return answer;
}

}  // namespace

Answer solve(const Problem& task, const Options& options) {
  if (std::optional<Answer> none = answer_of_too_weak(task, options)) return *std::move(none);
  Answer answer = solve_from(std::make_shared<const Problem>(task), {}, options);
  if (answer.status == Status::kNoneFound && !answer.has_posture()) {
    // Not in `solve_from`: a map has many such cells.
    const Method method = resolve(*answer.task, with_search(*answer.task, options));
    const std::string why = why_none(*answer.task, method);
    if (!why.empty()) answer.reason = answer.reason.str() + ": " + why;
  }
  return answer;
}

Answer solve_from(std::shared_ptr<const Problem> task, const std::vector<Eigen::VectorXd>& near,
                  const Options& options) {
  const int threads = thread_count(options.threads);
  Method method = resolve(*task, with_search(*task, options));
  const auto start = Clock::now();
  const auto tally = std::make_shared<Tally>();
  const auto objective = make_objective(*task, method, tally);
  SearchOptions how;
  how.threads = threads;
  how.progress = options.progress;
  how.interrupted = options.interrupted;
  const Case choice = method.choice;
  how.starts = starts_among(near, *objective, method.choice.budget);
  const std::vector<Candidate> starts = how.starts;
  SearchResult result = run_search(*task, method, *objective, std::move(how));
  result.evaluations += choice.budget - method.choice.budget;
  include_starts(starts, result);
  const double search_s = seconds_since(start);
  method.choice = choice;
  Answer answer = begin(task, method);
  if (result.status == Status::kBestFound) {
    answer = evaluate(task, method, unstacked(result.theta_r, knots_of(*task)), true);
  } else {
    static_cast<Verdict&>(answer) = result;
  }
  conclude_search(result, answer);
  answer.undecided = tally->undecided();
  answer.ik_solutions = tally->sum();
  answer.wall_s += search_s;
  return answer;
}

}  // namespace maxwrench
