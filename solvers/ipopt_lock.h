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

}  // namespace maxwrench
