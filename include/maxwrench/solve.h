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

namespace maxwrench {

/// The names and numbers that decide an answer. The tables of names are in strategies.h.
struct Case {
  std::string problem = "";  ///< the name of the task
  std::string measure = "linf_polytope";
  Wrench wrench = Wrench::kPure;
  /// Of the lower level. Empty: the first solver that serves the task and the wrench. "none": the
  /// measure is a closed form.
  std::string solver = "";
  /// A method alone, or stages joined by '+'. Empty: `default_search`, which a static task without
  /// a budget restarts until more is pointless; of a posture or trajectory that is given, none.
  std::string search = "";
  std::uint64_t seed = 1;
  /// Evaluations of the search, never exceeded. 0: `kUsualBudget`, of a restarted search
  /// `kMostOfRestarts`, which it seldom needs.
  long budget = 0;
  /// Of a task in time: how knots become motion. Empty: as the task says.
  std::string scheme = "";
  /// Of the virtual tank, which tries the default posture or trajectory. Empty: no experiment.
  std::string integrator = "";
};

/// Evaluations if nobody says how many.
inline constexpr long kUsualBudget = 20'000;
inline constexpr long kMostOfRestarts = 200'000;

/// The solver of a closed form.
inline constexpr const char* kNoSolver = "none";

/// An answer counts as solved only if its recomputed residual is below this, relative to 1 +
/// |beta|: what the least exact solver (an interior point) reaches with room to spare.
inline constexpr double kAnswerTolerance = 1e-6;

/// How `evaluate` and `solve` work.
struct Options : Case {
  int threads = 0;              ///< change the time, never the answer; 0: one for each core
  bool check_collision = true;  ///< `evaluate` only: a search always avoids collisions
  /// Is called now and then with the evaluations so far, from any thread.
  std::function<void(long evaluations)> progress = {};
  /// Is asked before each evaluation, from any thread. Once it says true, the search ends with the
  /// best so far and status kBudgetExhausted.
  std::function<bool()> interrupted = {};
};

/// How often a method of a search ended with the same word of its library.
struct CallCount {
  std::string method, status;
  long calls = 0, evaluations = 0;
};

/// What a posture or a trajectory is worth, with everything that is known there. A static task is a
/// task in time of one instant: its trajectory has one knot.
///
/// The status is kOptimal (of `evaluate`: the lower level is solved, and verified from the data of
/// the task), kBestFound (of `solve`), kBudgetExhausted (of an interrupted `solve`, which may have
/// a value), kReached (of an experiment), or says, with the reason, why there is no value.
struct Answer : Verdict {
  std::shared_ptr<const Problem> task;  ///< as it was solved
  Case choice;                          ///< complete: nothing is left to defaults
  std::string unit;                     ///< of the value
  bool collision = true;                ///< whether collisions were looked for
  /// Knots k×r, instants, value, gradient k×r. Of a static task the value is beta, and `solution`
  /// is empty.
  Trajectory trajectory;
  /// Of a static task: the posture, and what the measure says there with h, u, lambda.
  Posture posture;
  Capability capability;
  /// Of a static task: beta of linf_polytope at the posture with the same wrenches, which makes the
  /// postures of different measures comparable [N or N m]. Of an experiment: what was planned. NaN:
  /// none.
  double beta_linf = std::numeric_limits<double>::quiet_NaN();
  /// Of a task in time: the least distance of two bodies, between knots too, and the program whose
  /// optimum is the value. It refers to `task`.
  std::optional<Clearance> clearance;
  TrajectoryProgram program;
  /// Of an experiment: why the wrench was not held. Empty: it was.
  std::string missed;
  long evaluations = 0;
  std::vector<CallCount> calls;  ///< of the methods of the search
  std::string stopped;           ///< why the search ended
  /// Of a static task, over all evaluations but those of trajectory searches: how many ended
  /// without a verdict that the data confirm, and what became of the postures.
  long undecided = 0;
  IkCounts ik_solutions;
  double wall_s = 0;  ///< without the beta_linf

  bool has_posture() const { return trajectory.knots.rows() > 0; }
  /// An interrupted search may have one, too.
  bool has_value() const;
  /// Whether it is what was asked for: optimal, best found, or carried out.
  bool answered() const;
  double beta() const { return trajectory.value; }
  /// Recomputed from the data of the task.
  const Residual& residual() const;
};

/// The search that is best in general: of a task in time `slp`; of a static one that between facets
/// where it serves, going on by `cmaes` from where it has been (its ends may collide, and it is
/// blind to pairs of which only a test is known), else that of any measure, `general_search`.
std::string default_search(const Problem& task, const std::string& measure);

/// The case with the search and the budget that `solve` gives it if it names none.
Case with_search(const Problem& task, Case c);

/// The search of postures that is best in general for a measure about which nothing is known, of
/// those that are built in.
const char* general_search();

/// What `task` can do at theta_r: k×r knots, or r numbers, which a task in time holds throughout.
/// Throws std::invalid_argument, which names key, value and what was expected, if the table has
/// another size or is not finite, a name does not exist, or the choice has no meaning.
Answer evaluate(const Problem& task, const Eigen::MatrixXd& theta_r, const Options& options = {});

/// The best posture or trajectory that a search finds, evaluated anew. The same at any thread
/// count. Throws as `evaluate`.
Answer solve(const Problem& task, const Options& options = {});

/// The default posture or trajectory in the virtual tank, by `Case::integrator`: kReached with the
/// reading as value, whether or not the wrench was held; kNoneFound if the posture was lost. Throws
/// as `evaluate`.
Answer experiment(const Problem& task, const Options& options);

/// The answer for people, in lines.
std::string summary(const Answer& answer);

/// The answer as a JSON object on one line. What has no value is null.
std::string to_json(const Answer& answer);

}  // namespace maxwrench
