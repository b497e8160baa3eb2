#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace maxwrench {
namespace {

constexpr std::chrono::seconds kPatience(1);
constexpr std::chrono::milliseconds kInterval(100);
constexpr int kCharacters = 40;

}  // namespace

Progress::Progress(std::string what, double total)
    : what_(std::move(what)),
      total_(std::max(total, 1e-9)),
      enabled_(isatty(fileno(stderr)) != 0),
      start_(std::chrono::steady_clock::now()),
      next_(start_ + kPatience) {}

void Progress::show(double done) {
  if (!enabled_) return;
  const std::lock_guard<std::mutex> guard(mutex_);
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return;
  next_ = now + kInterval;
  drawn_ = true;
  const double share = std::min(1.0, done / total_);
  const int filled = static_cast<int>(share * kCharacters);
  // Not fmt::print, which throws if the terminal is closed: the caller may be a C library.
  const double spent = std::chrono::duration<double>(now - start_).count();
  const std::string left =
      share > 0 ? fmt::format(", {:.0f} s left", spent / share - spent) : std::string();
  std::fputs(fmt::format("\r{} [{:=<{}}{:<{}}] {:3.0f} %  {:.0f} s{}\x1b[K", what_, "", filled, "",
                         kCharacters - filled, 100 * share, spent, left)
                 .c_str(),
             stderr);
  std::fflush(stderr);
}

void Progress::finish() {
  if (drawn_) std::fputs("\r\x1b[K", stderr);
  drawn_ = false;
}

ProgressLine::ProgressLine()
    : enabled_(isatty(fileno(stderr)) != 0),
      start_(std::chrono::steady_clock::now()),
      next_(start_ + kPatience) {}

void ProgressLine::show(const std::string& text) {
  const auto now = std::chrono::steady_clock::now();
  if (!enabled_ || now < next_) return;
  next_ = now + kInterval;
  drawn_ = true;
  std::fputs(
      fmt::format("\r{}  {:.0f} s\x1b[K", text, std::chrono::duration<double>(now - start_).count())
          .c_str(),
      stderr);
  std::fflush(stderr);
}

ProgressLine::~ProgressLine() {
  if (drawn_) std::fputs("\r\x1b[K", stderr);
}

}  // namespace maxwrench
