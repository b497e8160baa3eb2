#pragma once

#include <string>
#include <vector>

#include "maxwrench/solve.h"

// An answer as one line of CSV.

namespace maxwrench {

/// The columns that select a case, `problem measure wrench solver search seed budget scheme
/// integrator`, as text.
const std::vector<std::string>& case_columns();
std::vector<std::string> case_values(const Case& c);

/// The case comes first, then values. Times are not values and have a table of their own. For a
/// task in time, beta is the value and theta_r the table row by row. For an experiment, beta is the
/// reading and beta_linf the planned c'h. `task_digest` is the digest of the task's files.
std::vector<std::string> value_columns();
std::vector<std::string> values(const Answer& answer);
std::vector<std::string> time_columns();
std::vector<std::string> times(const Answer& answer);

/// Calls and evaluations: "slsqp xtol_reached 12 340; slsqp failure 1 20".
std::string describe(const std::vector<CallCount>& counts);

/// Numbers with all digits, separated by blanks.
std::string exact_text(double value);
std::string exact_text(const Eigen::VectorXd& v);

}  // namespace maxwrench
