#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "maxwrench/held.h"

namespace maxwrench {

/// `solve --worth tank`: maximises what the virtual tank holds in place of what is planned.
struct HeldOption {
  std::string worth = "plan";
  HeldOptions how;

  void add(CLI::App& app);
  bool tank() const { return worth == "tank"; }
  /// Searches with progress on stderr until Ctrl-C.
  ///
  /// @throws std::invalid_argument for a static task
  HeldTrajectory solve(const Problem& problem, Options options) const;
  /// Prints the result; returns the exit status.
  static int report(const HeldTrajectory& held, bool json);
};

}  // namespace maxwrench
