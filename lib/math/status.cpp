#include "maxwrench/status.h"

#include <cmath>

namespace maxwrench {

const char* to_string(Status status) {
  switch (status) {
    case Status::kOptimal:
      return "optimal";
    case Status::kInfeasible:
      return "infeasible";
    case Status::kUnbounded:
      return "unbounded";
    case Status::kBudgetExhausted:
      return "budget_exhausted";
    case Status::kInvalidPosture:
      return "invalid_posture";
    case Status::kValid:
      return "valid";
    case Status::kBestFound:
      return "best_found";
    case Status::kNoneFound:
      return "none_found";
    case Status::kProven:
      return "proven";
    case Status::kBracket:
      return "bracket";
    case Status::kReached:
      return "reached";
    case Status::kNumericalError:
      break;
  }
  return "numerical_error";
}

bool Residual::within(double tolerance) const {
  if (!std::isfinite(tolerance)) return false;
  // Compared one by one, because std::max can lose NaN.
  return balance <= tolerance && bounds <= tolerance && dual <= tolerance && gap <= tolerance;
}

}  // namespace maxwrench
