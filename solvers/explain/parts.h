#pragma once

#include "maxwrench/explain.h"
#include "maxwrench/solve.h"
#include "maxwrench/wrench_program.h"

// The parts of an explanation. Each fills its own members, or says why there is nothing.

namespace maxwrench {

/// "contact force 1" and its unit: column i of the basis of the second contact.
std::string contact_force_name(Eigen::Index i);
const char* contact_force_unit(const Problem& task, Eigen::Index i);

/// The limits that bind at a posture with their ranges, and the budget. `program` is that of the
/// posture.
void explain_limits(const Answer& answer, const WrenchProgram& program, Explanation& explanation);

/// Fills the loads of the budget, the parts of lambda'tau_d.
void split_loads(const Answer& answer, const Eigen::VectorXd& lambda, ValueBudget& budget);

void explain_best_posture(const Answer& answer, BestPostureRates& best);

void explain_efforts(const Answer& answer, const WrenchProgram& program, LeastEfforts& efforts);

void explain_instants(const Answer& answer, Explanation& explanation);

/// What binds at a posture in words, a line for each sentence: the limits, whether there is a kink,
/// and what 10 % more of the first limit gives.
std::string binding_words(const Explanation& explanation);

/// "a and b are at their lower limits, c is at its upper limit"
std::string where_limits_are(const std::vector<LimitRate>& limits);

}  // namespace maxwrench
