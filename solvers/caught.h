#pragma once

#include <exception>
#include <utility>

namespace maxwrench {

/// Carries an exception that a callback throws past the stack frames of a library, which no
/// exception may cross. The callback returns the library's own failure code, and the caller of the
/// library rethrows the stored exception.
class Caught {
 public:
  /// Returns body(), or `failed` if it throws. After the first exception, `body` is not called any
  /// more.
  template <class Result, class Body>
  Result run(Result failed, Body&& body) noexcept {
    if (thrown_) return failed;
    try {
      return std::forward<Body>(body)();
    } catch (...) {
      thrown_ = std::current_exception();
      return failed;
    }
  }

  bool any() const { return thrown_ != nullptr; }

  void rethrow() {
    if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
  }

 private:
  std::exception_ptr thrown_;
};

}  // namespace maxwrench
