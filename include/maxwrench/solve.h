#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "maxwrench/capability.h"
#include "maxwrench/posture.h"
#include "maxwrench/problem.h"
#include "maxwrench/trajectory.h"

/// @file
/// Evaluates, solves and simulates a task: the entry points of the library.

namespace maxwrench {

/// The names and numbers that determine an answer.
///
/// The tables of names are in strategies.h.
struct Case {
  std::string problem = "";               ///< the name of the task
  std::string measure = "linf_polytope";  ///< the name of the measure
  Wrench wrench = Wrench::kPure;          ///< the allowed wrenches
  /// The solver of the lower level. Empty: the first one that supports the task and the wrench.
  /// "none": the measure is a closed form.
  std::string solver = "";
  /// A single method, or stages joined by '+'. Empty: `default_search`, which is restarted for a
  /// static task without a budget until another optimum is unlikely. An evaluation of a given
  /// posture or trajectory uses no search.
  std::string search = "";
  std::uint64_t seed = 1;  ///< of the random numbers
  /// Largest number of evaluations of the search, never exceeded. 0: `kUsualBudget`, or for a
  /// restarted search `kMostOfRestarts`, which it seldom uses up.
  long budget = 0;
  /// For a task in time: how knots become a motion. Empty: the scheme of the task.
  std::string scheme = "";
  /// The integrator of the virtual tank, which tests the default posture or trajectory. Empty: no
  /// experiment.
  std::string integrator = "";
};

/// The evaluation budget if none is given.
inline constexpr long kUsualBudget = 20'000;
/// The evaluation budget of a restarted search if none is given.
inline constexpr long kMostOfRestarts = 200'000;

/// The name of the solver of a measure that is a closed form.
inline constexpr const char* kNoSolver = "none";

/// The largest recomputed residual of an answer that counts as solved, relative to 1 + |beta|.
///
/// The least exact solver (an interior point) stays well below it.
inline constexpr double kAnswerTolerance = 1e-6;

/// The options of `evaluate`, `solve` and `experiment`.
struct Options : Case {
  int threads = 0;  ///< number of threads; it changes the time, never the answer; 0: one per core
  bool check_collision = true;  ///< `evaluate` only: a search always avoids collisions
  /// Called from time to time with the number of evaluations so far, from any thread.
  std::function<void(long evaluations)> progress = {};
  /// Called before each evaluation, from any thread. Once it returns true, the search ends with the
  /// best result so far and status kBudgetExhausted.
  std::function<bool()> interrupted = {};
};

/// The number of runs of a method that ended with the same status of its library.
struct CallCount {
  std::string method,   ///< the name of the method
      status;           ///< the status that the library reports
  long calls = 0,       ///< number of runs
      evaluations = 0;  ///< number of evaluations of these runs
};

/// The value of a posture or a trajectory, with everything that is known about it.
///
/// A static task is a task in time of one instant: its trajectory has one knot. The status is
///
/// * kOptimal, from `evaluate`: the lower level is solved, and verified from the data of the task;
/// * kBestFound, from `solve`;
/// * kBudgetExhausted, from an interrupted `solve`, which may have a value;
/// * kReached, from `experiment`;
/// * another one, with a reason, if there is no value.
struct Answer : Verdict {
  std::shared_ptr<const Problem> task;  ///< the task as it was solved
  Case choice;                          ///< the case, with all defaults filled in
  std::string unit;                     ///< unit of the value
  bool collision = true;                ///< whether collisions were checked
  bool given_joints = false;            ///< whether all joints were given, by `evaluate_posture`
  /// Knots k×r, instants, value and gradient k×r. For a static task the value is beta, and
  /// `solution` is empty.
  Trajectory trajectory;
  /// For a static task: the posture.
  Posture posture;
  /// For a static task: the result of the measure at the posture, with h, u and lambda.
  Capability capability;
  /// For a static task: beta of linf_polytope at the posture with the same wrenches [N or N m],
  /// which makes the postures of different measures comparable. For an experiment: the planned
  /// value. NaN: none.
  double beta_linf = std::numeric_limits<double>::quiet_NaN();
  /// For a task in time: the least distance of two bodies, including between knots.
  std::optional<Clearance> clearance;
  /// For a task in time: the program whose optimum is the value. It refers to `task`.
  TrajectoryProgram program;
  /// For an experiment: why the wrench was not held. Empty: it was held.
  std::string missed;
  long evaluations = 0;          ///< number of evaluations
  std::vector<CallCount> calls;  ///< runs of the methods of the search
  std::string stopped;           ///< why the search ended
  /// For a static task, except with trajectory searches: number of evaluations that ended without a
  /// verdict that the data confirm.
  long undecided = 0;
  /// For a static task, except with trajectory searches: counts of the postures of all evaluations.
  IkCounts ik_solutions;
  double wall_s = 0;  ///< wall time, without that of `beta_linf` [s]

  /// Returns whether there is a posture or trajectory.
  bool has_posture() const { return trajectory.knots.rows() > 0; }
  /// Returns whether there is a value. An interrupted search may have one too.
  bool has_value() const;
  /// Returns whether the answer is the requested one: optimal, best found, or reached.
  bool answered() const;
  /// Returns the value [unit].
  double beta() const { return trajectory.value; }
  /// Returns the residual, recomputed from the data of the task.
  const Residual& residual() const;
};

/// Returns the name of the search that is best in general.
///
/// For a task in time it is `slp`. For a static task, also with a list of scenarios, it is the
/// search between facets where that is supported, followed by `cmaes` from the points that it
/// found. The second stage is needed because these points may collide, and because the first one
/// ignores pairs of bodies that have a test for collision only. Otherwise it is `general_search`.
///
/// @param task     the task
/// @param measure  the name of the measure
/// @param wrench   the allowed wrenches
std::string default_search(const Problem& task, const std::string& measure,
                           Wrench wrench = Wrench::kPure);

/// Returns the case with the search and the budget that `solve` uses if it names none.
Case with_search(const Problem& task, Case c);

/// Returns the name of the search of postures that is best in general for any measure.
///
/// It is one of the searches that this build contains.
const char* general_search();

/// Evaluates a task at theta_r.
///
/// @param task     the task
/// @param theta_r  knots (k×r), or r numbers, which a task in time keeps throughout
/// @param options  measure, wrench, solver and others
/// @return the value and what is known about it
/// @throws std::invalid_argument, which names key, value and what was expected, if the table has
///         the wrong size or is not finite, a name does not exist, or the combination of choices is
///         not supported.
Answer evaluate(const Problem& task, const Eigen::MatrixXd& theta_r, const Options& options = {});

/// Evaluates a static task in one posture that is given by all joints.
///
/// The base is at its mount, and the end effector where the joints put it, instead of the pose of
/// the task. Wrenches in axes of the end effector turn with it. There is no inverse kinematics, so
/// the posture may be singular. The answer has no gradient. Its task is the given one with the pose
/// of the posture, all of it fixed.
///
/// @param task     a static task with one contact
/// @param q        positions of all joints [rad or m]
/// @param options  measure, wrench, solver and others
/// @return the value and what is known about it
/// @throws std::invalid_argument as `evaluate`.
Answer evaluate_posture(const Problem& task, const Eigen::VectorXd& q, const Options& options = {});

/// Searches for the best posture or trajectory.
///
/// @param task     the task
/// @param options  measure, wrench, solver, search, budget and others
/// @return the best one that the search finds, evaluated again; the same at any number of threads
/// @throws std::invalid_argument as `evaluate`.
Answer solve(const Problem& task, const Options& options = {});

/// Runs an experiment with the default posture or trajectory in the virtual tank.
///
/// @param task     the task
/// @param options  the case, with `Case::integrator`
/// @return kReached, with the reading as value, whether or not the wrench was held; kNoneFound if
///         the posture was lost, or if the default posture exerts nothing along c
/// @throws std::invalid_argument as `evaluate`.
Answer experiment(const Problem& task, const Options& options);

/// Returns the answer as text of several lines.
std::string summary(const Answer& answer);

/// Returns the answer as a JSON object on one line. A key without a value is null.
std::string to_json(const Answer& answer);

}  // namespace maxwrench
