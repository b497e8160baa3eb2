#include "cli/ctrl_c.h"

#include <atomic>
#include <csignal>

namespace maxwrench {
namespace {

std::atomic<bool> g_asked = false;
static_assert(std::atomic<bool>::is_always_lock_free);  // for use in a signal handler

void ask_to_end(int) { g_asked = true; }

}  // namespace

CtrlC::CtrlC() {
  g_asked = false;
  struct sigaction before {};
  if (sigaction(SIGINT, nullptr, &before) != 0 || before.sa_handler == SIG_IGN) return;
  struct sigaction handler {};
  handler.sa_handler = ask_to_end;
  handler.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &handler, nullptr);
}

CtrlC::~CtrlC() {
  struct sigaction now {};
  if (sigaction(SIGINT, nullptr, &now) == 0 && now.sa_handler == ask_to_end) {
    std::signal(SIGINT, SIG_DFL);
  }
}

std::function<bool()> CtrlC::asked() const {
  return [] { return g_asked.load(std::memory_order_relaxed); };
}

}  // namespace maxwrench
