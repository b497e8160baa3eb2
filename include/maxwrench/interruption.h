#pragma once

#include <atomic>
#include <exception>

/// @file
/// Ends computations that have no partial result, such as a linear program.
///
/// A search returns the best so far once `Options::interrupted` says so, and does not use this.

namespace maxwrench {

/// Thrown by a computation that was ended. There is no result.
class Interrupted : public std::exception {
 public:
  /// Returns "interrupted".
  const char* what() const noexcept override { return "interrupted"; }
};

/// While it lives, what this thread computes ends once a flag is set.
///
/// A computation hands the flag over to the threads that it starts.
class Interruption {
 public:
  /// @param flag  set by another thread; null: nothing ends the computation
  explicit Interruption(const std::atomic<bool>* flag) : before_(flag_) { flag_ = flag; }
  ~Interruption() { flag_ = before_; }
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Returns the flag of this thread; null: none.
  static const std::atomic<bool>* flag() { return flag_; }

 private:
  static inline thread_local const std::atomic<bool>* flag_ = nullptr;
  const std::atomic<bool>* before_;
};

/// Returns whether the computation in this thread is to end.
inline bool is_interrupted() {
  return Interruption::flag() != nullptr && Interruption::flag()->load(std::memory_order_relaxed);
}

/// Ends the computation in this thread if it is to end.
///
/// @throws Interrupted if so
inline void end_if_interrupted() {
  if (is_interrupted()) throw Interrupted();
}

}  // namespace maxwrench
