#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

/// @file
/// How a computation ended: status, reason and residual.

namespace maxwrench {

/// How a computation ended.
///
/// Only a lower level gives `kOptimal`, and only after verification from the data. A search gives
/// `kBestFound` or `kNoneFound`, which prove nothing.
enum class Status {
  kOptimal,          ///< of a lower level: verified
  kInfeasible,       ///< of a lower level: proved
  kUnbounded,        ///< of a lower level: proved
  kBudgetExhausted,  ///< evaluations, steps or iterations ran out first
  kInvalidPosture,   ///< the posture does not exist or violates something
  kNumericalError,   ///< no verdict that the data confirm
  kValid,            ///< of a posture: it exists and violates nothing
  kBestFound,        ///< of a search: the best of what was evaluated
  kNoneFound,        ///< of a search: nothing that it evaluated has a value
  kProven,           ///< of branch and bound: the bound is within the gap of the best value found
  kBracket,          ///< of branch and bound: the best value found, and a bound farther from it
  kReached           ///< of an integration: the last time, or a root
};

/// Returns the name of a status in files and on the command line, such as "invalid_posture".
const char* to_string(Status status);

/// A text of at most 159 characters that is copied without allocation. Longer texts are truncated.
class Reason {
 public:
  /// Makes an empty text.
  Reason() { text_[0] = 0; }
  /// Copies a text.
  Reason(const Reason& other) { *this = other; }
  /// Copies a text. Only the characters in use are copied, because most texts are empty and are
  /// copied in loops that run millions of times.
  Reason& operator=(const Reason& other) { return *this = std::string_view(other.c_str()); }
  /// Copies a text, truncated to 159 characters.
  Reason& operator=(std::string_view text) {
    const std::size_t size = std::min(text.size(), text_.size() - 1);
    text.copy(text_.data(), size);
    text_[size] = 0;
    return *this;
  }

  bool empty() const { return text_[0] == 0; }        ///< Returns whether the text is empty.
  const char* c_str() const { return text_.data(); }  ///< Returns the text, terminated by a zero.
  std::string str() const { return text_.data(); }    ///< Returns the text as a string.

 private:
  std::array<char, 160> text_;
};

/// How a computation ended and, if it did not give the requested result, why.
struct Verdict {
  Status status = Status::kNumericalError;  ///< how it ended
  Reason reason;                            ///< why; empty if the result is the requested one

  /// Sets status and reason.
  ///
  /// @param how  the status
  /// @param why  the reason
  /// @return the status
  Status conclude(Status how, std::string_view why = {}) {
    status = how;
    reason = why;
    return how;
  }
};

/// How well a result satisfies its program, recomputed from the data.
///
/// A number that cannot be computed is infinite or NaN.
struct Residual {
  double balance = 0;  ///< violation of the equations
  double bounds = 0;   ///< violation of the limits by the variables
  double dual = 0;     ///< violation of dual feasibility where no finite bound compensates it
  double gap = 0;      ///< dual objective less objective: the result is optimal to within this

  /// Returns whether all four numbers are at most `tolerance`; false if one is NaN.
  bool within(double tolerance) const;
};

}  // namespace maxwrench
