#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "maxwrench/held.h"

namespace maxwrench {

/// `solve --worth tank`: maximises what the virtual tank holds in place of what is planned.
struct HeldOption {
  std::string worth = "plan";
  HeldOptions how;
  bool has_simulations = false;

  void add(CLI::App& app);
  /// Whether the tank counts.
  ///
  /// @throws std::invalid_argument if --simulations is given although the plan counts
  bool tank() const;
  /// Searches with progress on stderr until Ctrl-C.
  ///
  /// @throws std::invalid_argument for a static task
  HeldTrajectory solve(const Problem& problem, Options options) const;
  /// Prints the result; returns the exit status.
  static int report(const HeldTrajectory& held, bool json);
};

}  // namespace maxwrench
