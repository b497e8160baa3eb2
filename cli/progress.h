#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <string>

namespace maxwrench {

/// A progress bar with the remaining time on stderr. It appears only if stderr is a terminal and
/// the work takes longer than a second.
class Progress {
 public:
  Progress(std::string what, double total);
  ~Progress() { finish(); }

  /// Shows the work done so far; call it from any thread.
  void show(double done);
  std::function<void(long)> counter() {
    return [this](long done) { show(static_cast<double>(done)); };
  }
  /// Removes the bar.
  void finish();

 private:
  std::string what_;
  double total_;
  bool enabled_;
  bool drawn_ = false;
  std::mutex mutex_;
  std::chrono::steady_clock::time_point start_, next_;
};

/// A line with a text and seconds instead, for an unknown amount of work. For one thread.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();
  void show(const std::string& text);

 private:
  bool enabled_, drawn_ = false;
  std::chrono::steady_clock::time_point start_, next_;
};

}  // namespace maxwrench
