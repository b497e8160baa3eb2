#include "solvers/search/ipopt_word.h"

#include "solvers/search/climbs.h"

namespace maxwrench {

std::string word_of(Ipopt::ApplicationReturnStatus status) {
  switch (status) {
    case Ipopt::Solve_Succeeded:
      return "solved";
    case Ipopt::Solved_To_Acceptable_Level:
      return "acceptable";
    case Ipopt::Search_Direction_Becomes_Too_Small:
      return "small_direction";
    case Ipopt::Maximum_Iterations_Exceeded:
      return "iterations";
    case Ipopt::Restoration_Failed:
      return "restoration_failed";
    case Ipopt::Error_In_Step_Computation:
      return "step_failed";
    case Ipopt::Infeasible_Problem_Detected:
      return "infeasible";
    case Ipopt::User_Requested_Stop:
      return kBudgetUsed;
    default:
      return "error_" + std::to_string(static_cast<int>(status));
  }
}

}  // namespace maxwrench
