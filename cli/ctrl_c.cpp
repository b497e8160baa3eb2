#include "cli/ctrl_c.h"

#include <cassert>
#include <csignal>

namespace maxwrench {
namespace {

std::atomic<Interruption*> g_interrupted = nullptr;
static_assert(std::atomic<Interruption*>::is_always_lock_free &&
              std::atomic<bool>::is_always_lock_free);  // for use in a signal handler

void ask_to_end(int) {
  if (Interruption* interruption = g_interrupted) interruption->asked = true;
}

}  // namespace

CtrlC::CtrlC() {
  assert(g_interrupted == nullptr);
  g_interrupted = &interruption;
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
  g_interrupted = nullptr;
}

}  // namespace maxwrench
