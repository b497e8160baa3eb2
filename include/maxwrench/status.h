#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace maxwrench {

/// How a computation ended. Only a lower level says `kOptimal`, and only what was verified from the
/// data; a search says `kBestFound` or `kNoneFound`, which prove nothing.
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
  kProven,           ///< of branch and bound: nothing exceeds the best that was found by more
  kBracket,          ///< of branch and bound: the best that was found and a bound apart from it
  kReached           ///< of an integration: the last time, or a root
};

/// The name in files and on the command line, such as "optimal" or "invalid_posture".
const char* to_string(Status status);

/// A short text that is copied without allocation; what does not fit is cut.
class Reason {
 public:
  Reason() { text_[0] = 0; }
  Reason(const Reason& other) { *this = other; }
  /// No more is copied than is there: most are empty, in loops that run millions of times.
  Reason& operator=(const Reason& other) { return *this = std::string_view(other.c_str()); }
  Reason& operator=(std::string_view text) {
    const std::size_t size = std::min(text.size(), text_.size() - 1);
    text.copy(text_.data(), size);
    text_[size] = 0;
    return *this;
  }

  bool empty() const { return text_[0] == 0; }
  const char* c_str() const { return text_.data(); }
  std::string str() const { return text_.data(); }

 private:
  std::array<char, 160> text_;
};

/// How a computation ended, and if it is not what was asked for, why.
struct Verdict {
  Status status = Status::kNumericalError;
  Reason reason;

  /// Sets both and returns the status.
  Status conclude(Status how, std::string_view why = {}) {
    status = how;
    reason = why;
    return how;
  }
};

/// How well an answer satisfies its program, recomputed from the data. What cannot be computed is
/// infinite or NaN.
struct Residual {
  double balance = 0;  ///< of the equations
  double bounds = 0;   ///< how far variables leave their limits
  double dual = 0;     ///< how far multipliers are from dual feasible, where no bound pays for it
  double gap = 0;      ///< dual objective less objective: optimal to within this

  /// Whether all are at most `tolerance`; NaN never is.
  bool within(double tolerance) const;
};

}  // namespace maxwrench
