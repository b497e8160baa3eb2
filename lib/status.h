#pragma once

namespace maxwrench {

/// How a computation ended. Everything but `kOptimal` comes with a reason beside it.
enum class Status {
  kOptimal,
  kInfeasible,
  kUnbounded,
  kBudgetExhausted,
  kInvalidPosture,
  kNumericalError
};

/// The name in files and on the command line, such as "optimal" or "invalid_posture".
const char* to_string(Status status);

}  // namespace maxwrench
