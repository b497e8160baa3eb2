#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "maxwrench/scenario.h"
#include "maxwrench/solve.h"

/// @file
/// What lost actuators and uncertain data cost a static task.

namespace maxwrench {

/// The interval of one scenario at a posture.
struct ScenarioEnds {
  std::string name;   ///< as `describe` tells
  double low = 0,     ///< lo_s; -infinity: none
      high = 0;       ///< hi_s; infinity: none
  bool held = false;  ///< false: I_s is empty
};

/// Computes the interval of each scenario at the posture of an answer.
///
/// With a ball the scenarios are those of the list, each with all wrenches of the ball. In time
/// each scenario is solved alone at the same knots; `low` is then -infinity, or 0 for a payload.
///
/// @param answer  of a task with a list of scenarios, with a valid posture or trajectory
/// @return the intervals in the order of wrenches, limits and cases, the last load first
/// @throws std::invalid_argument if the task has no list or there is no valid posture.
std::vector<ScenarioEnds> scenario_ends(const Answer& answer);

/// Returns a scenario as a JSON object on one line: `wrench` (null: there is one), `c`, `deltas` by
/// key, `current` (null: none), the names of actuators that are `dead`, `limp` and `locked`, and
/// by name the shares by which others are `weaker`.
std::string to_json(const ScenarioData& data);

/// Returns the intervals as text of several lines.
std::string summary(const std::vector<ScenarioEnds>& ends);
/// Returns an answer as a JSON object on one line, with the intervals of its scenarios.
std::string to_json(const Answer& answer, const std::vector<ScenarioEnds>& ends);

/// Values of drawn models. A model without a value counts as -infinity.
struct ScenarioSample {
  long drawn = 0,         ///< number of models
      infeasible = 0;     ///< number of models without a value
  double least = 0,       ///< least value [unit]
      q01 = 0,            ///< quantile 1 % [unit]
      q05 = 0,            ///< quantile 5 % [unit]
      median = 0;         ///< quantile 50 % [unit]
  long below = 0;         ///< number of models below `guaranteed`
  double guaranteed = 0;  ///< what models are compared with [unit]
  std::string unit = "";  ///< of the values
  /// The value of each model, in the order of their numbers; -infinity: none.
  std::vector<double> values;
};

/// Draws models at the posture of an answer.
///
/// Every width is uniform and independent: masses, volumes, centres, trim, payload, the strength of
/// each actuator. One of the currents and one of the losses is drawn. The wrenches are those of the
/// task. A sample proves nothing; that no value is below the guaranteed one is a check of it.
///
/// @param answer  of a static task with a list of scenarios, with a valid posture
/// @param draws   number of models, at least 1
/// @param seed    seed of the random numbers; model i of a seed is the same in any posture
/// @param guaranteed  what models are compared with [unit], such as the guaranteed value of another
///                    posture; none: the value of the list at this posture, if it has one
/// @return the values; the same for the same seed
/// @throws std::invalid_argument if the task has no list, there is no valid posture, draws < 1, or
///         the guaranteed value is not finite.
ScenarioSample sample_scenarios(const Answer& answer, long draws, std::uint64_t seed,
                                std::optional<double> guaranteed = {});

/// Returns the models as CSV: number, value; empty if there is none.
std::string sample_csv(const ScenarioSample& sample);

/// Returns the sample as one line of text.
std::string summary(const ScenarioSample& sample);
/// Returns an answer as a JSON object on one line, with the sample of its task.
std::string to_json(const Answer& answer, const ScenarioSample& sample);

/// A task with some actuators lost.
struct LossEffect {
  std::string name;   ///< as `ScenarioLimits::name`; empty: nothing is lost
  Answer at_posture,  ///< the value at the given posture
      best;           ///< the best posture that a search finds for this loss
};

/// The losses of a task, compared.
struct Sensitivity {
  std::vector<LossEffect> effects;  ///< in the order of the limits
  /// One posture for all of them: at the given posture, and the best that a search finds. The value
  /// is the least over all limits.
  LossEffect all;
};

/// Computes what a task is worth with each of several limits of its actuators.
///
/// Each search begins on its own. Where the best posture of other limits has a larger value than
/// its own, it continues from there. So limits that allow more, such as those of the intact robot,
/// have no smaller value than others, and no loss has a smaller one than all losses together.
///
/// @param task     a static task with one contact
/// @param theta_r  the given posture (r)
/// @param limits   the limits to compare, such as those of the intact robot and of each loss
/// @param options  measure linf_polytope, wrench, solver, search, budget and others, of each search
/// @return the values; searches after an interruption have none
/// @throws std::invalid_argument as `evaluate`, and for a task in time or with a second contact.
Sensitivity sensitivity(const Problem& task, const Eigen::VectorXd& theta_r,
                        const std::vector<ScenarioLimits>& limits, const Options& options = {});

/// Returns the comparison as a table. Effects stand in the order of their best values.
std::string summary(const Sensitivity& sensitivity);

/// Returns the comparison as a JSON object on one line.
std::string to_json(const Sensitivity& sensitivity);

}  // namespace maxwrench
