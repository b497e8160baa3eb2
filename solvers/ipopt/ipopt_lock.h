#pragma once

#include <mutex>

namespace maxwrench {

/// Whoever runs Ipopt, makes its application or ends it holds this lock: the MUMPS under Debian's
/// Ipopt 3.11.9 is not thread-safe. Recursive, for a search by Ipopt may evaluate an objective that
/// solves by Ipopt.
inline std::recursive_mutex& ipopt_lock() {
  static std::recursive_mutex lock;
  return lock;
}

/// `mumps_pivot_order` of whoever runs Ipopt: approximate minimum fill, which MUMPS takes for small
/// matrices by itself. For large ones it would take Scotch, whose random numbers go on from one
/// call to the next, so that the last digits would depend on what the process solved before.
inline constexpr int kMumpsOrdering = 2;

}  // namespace maxwrench
