#pragma once

#include <cstdint>
#include <string>

#include "maxwrench/solve.h"

/// @file
/// The value of a posture for models that are drawn at random from the uncertainty of its task.

namespace maxwrench {

/// Values of drawn models. A model without a value counts as -infinity.
struct ScenarioSample {
  long drawn = 0,                    ///< number of models
      infeasible = 0;                ///< number of models without a value
  double least = 0,                  ///< least value [unit]
      q01 = 0, q05 = 0, median = 0;  ///< quantiles 1 %, 5 % and 50 % [unit]
  long below = 0;                    ///< number of models below `guaranteed`
  double guaranteed = 0;             ///< the value of the list at the posture, if it has one
  std::string unit = "";  ///< of the values
};

/// Draws models at the posture of an answer.
///
/// Every width is uniform and independent: masses, volumes, centres, trim, payload, the strength of
/// each actuator. One of the currents and one of the losses is drawn. The wrenches are those of the
/// task. A sample proves nothing; that no value is below the guaranteed one is a check of it.
///
/// @param answer  of a static task with a list of scenarios, with a valid posture
/// @param draws   number of models, at least 1
/// @param seed    seed of the random numbers
/// @return the values; the same for the same seed
/// @throws std::invalid_argument if the task has no list, there is no valid posture, or draws < 1.
ScenarioSample sample_scenarios(const Answer& answer, long draws, std::uint64_t seed);

/// Returns the sample as one line of text.
std::string summary(const ScenarioSample& sample);
/// Returns an answer as a JSON object on one line, with the sample of its task.
std::string to_json(const Answer& answer, const ScenarioSample& sample);

}  // namespace maxwrench
