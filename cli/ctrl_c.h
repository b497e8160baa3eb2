#pragma once

#include <functional>

namespace maxwrench {

/// While an object of this class exists, the first Ctrl-C (SIGINT) requests an early end and the
/// second ends the program at once. Only one object may exist at a time. If SIGINT is ignored (a
/// background job), it stays ignored.
class CtrlC {
 public:
  CtrlC();
  ~CtrlC();
  CtrlC(const CtrlC&) = delete;
  CtrlC& operator=(const CtrlC&) = delete;

  /// Whether Ctrl-C was pressed since the construction.
  std::function<bool()> asked() const;
};

}  // namespace maxwrench
