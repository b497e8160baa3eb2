#include "solvers/search/ipopt_run.h"

#include <stdexcept>

#include "solvers/ipopt_lock.h"
#include "solvers/search/local_search.h"

namespace maxwrench {

Ipopt::SmartPtr<Ipopt::IpoptApplication> make_ipopt_application(
    const char* search, int iterations,
    const std::function<void(Ipopt::OptionsList& options)>& more) {
  Ipopt::SmartPtr<Ipopt::IpoptApplication> application = new Ipopt::IpoptApplication(false);
  const auto options = application->Options();
  options->SetIntegerValue("print_level", 0);
  options->SetStringValue("sb", "yes");
  options->SetStringValue("hessian_approximation", "limited-memory");
  options->SetNumericValue("bound_relax_factor", 0);
  options->SetIntegerValue("max_iter", iterations);
  options->SetIntegerValue("mumps_pivot_order", kMumpsOrdering);
  if (more) more(*options);
  if (application->Initialize("") != Ipopt::Solve_Succeeded) {
    throw std::runtime_error(std::string(search) + ": Ipopt does not take its options");
  }
  return application;
}

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
