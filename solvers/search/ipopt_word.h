#pragma once

#include <IpReturnCodes.hpp>
#include <string>

namespace maxwrench {

/// How Ipopt ended, in one word for a row; that its user stopped it means that the budget was used.
std::string word_of(Ipopt::ApplicationReturnStatus status);

}  // namespace maxwrench
