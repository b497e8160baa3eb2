#pragma once

#include <mutex>

namespace maxwrench {

/// Hold this lock while you make, run or destroy an Ipopt application: the MUMPS under Debian's
/// Ipopt 3.11.9 is not thread-safe. The lock is recursive, because a search by Ipopt may evaluate
/// an objective that solves by Ipopt.
inline std::recursive_mutex& ipopt_lock() {
  static std::recursive_mutex lock;
  return lock;
}

/// `mumps_pivot_order` for every use of Ipopt: approximate minimum fill, which MUMPS chooses itself
/// for small matrices. For large ones MUMPS would choose Scotch, whose random numbers continue from
/// call to call. The last digits would then depend on what the process solved before.
inline constexpr int kMumpsOrdering = 2;

}  // namespace maxwrench
