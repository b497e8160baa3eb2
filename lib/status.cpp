#include "lib/status.h"

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
    case Status::kNumericalError:
      break;
  }
  return "numerical_error";
}

}  // namespace maxwrench
