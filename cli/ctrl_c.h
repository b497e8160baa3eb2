#pragma once

#include <functional>

namespace maxwrench {

/// While one lives, the first Ctrl-C (SIGINT) asks to end early and the second ends the program at
/// once. One at a time. Where SIGINT is ignored (a job in the background) it stays ignored.
class CtrlC {
 public:
  CtrlC();
  ~CtrlC();
  CtrlC(const CtrlC&) = delete;
  CtrlC& operator=(const CtrlC&) = delete;

  /// Whether it was pressed since.
  std::function<bool()> asked() const;
};

}  // namespace maxwrench
