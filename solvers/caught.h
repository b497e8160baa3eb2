#pragma once

#include <exception>
#include <utility>

namespace maxwrench {

/// Carries what a callback throws past the frames of a library, which no exception may cross: the
/// callback returns the library's own sign of failure, and whoever called the library throws again
/// what was kept.
class Caught {
 public:
  /// body(), or `failed` if that throws. After the first exception nothing is called any more.
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
