#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace maxwrench {

struct Answer;

/// The options of what binds.
struct ExplainOption {
  bool explain = false;
  std::optional<double> share;

  void add(CLI::App& app);
  /// With --explain, takes the share from `--at SHARE`, which is a pose otherwise.
  void take_share(std::optional<std::string>& at);
  /// Prints an answer as `report` does, with what binds if that is asked for; returns its exit
  /// status.
  int report(const Answer& answer, bool json) const;
};

}  // namespace maxwrench
