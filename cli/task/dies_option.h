#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "cli/cli.h"
#include "maxwrench/tank.h"

namespace maxwrench {

/// Actuators that fail during an experiment: `--dies NAME=TIME` and `--noticed-after`.
struct DiesOption {
  std::vector<std::string> texts;

  void add(CLI::App& app, TankOptions& tank);
  /// Fills `TankOptions::deaths`. Throws std::invalid_argument, in one line with the option, unless
  /// each text is the name of an actuator and a time.
  void read(const Robot& robot, TankOptions& tank) const;
};

void print_deaths(const Robot& robot, const TankOptions& tank);
void print_after(const AfterDeaths& after);
nlohmann::ordered_json deaths_object(const Robot& robot, const TankOptions& tank);
nlohmann::ordered_json after_object(const AfterDeaths& after);

}  // namespace maxwrench
