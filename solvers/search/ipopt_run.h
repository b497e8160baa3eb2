#pragma once

#include <IpIpoptApplication.hpp>
#include <functional>
#include <string>

namespace maxwrench {

/// A silent Ipopt with a limited-memory Hessian that stays within the bounds. `more`, if given,
/// sets further options. Throws std::runtime_error, with the search's name, if Ipopt rejects an
/// option.
Ipopt::SmartPtr<Ipopt::IpoptApplication> make_ipopt_application(
    const char* search, int iterations,
    const std::function<void(Ipopt::OptionsList& options)>& more = {});

/// How Ipopt ended, in one word for a row. A stop by the user callback means that the budget was
/// used.
std::string word_of(Ipopt::ApplicationReturnStatus status);

}  // namespace maxwrench
