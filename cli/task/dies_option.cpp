#include "cli/task/dies_option.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "lib/robot/chain.h"
#include "maxwrench/robot.h"
#include "solvers/solve/format.h"
#include "solvers/solve/tank.h"

namespace maxwrench {
namespace {

ActuatorDeath read_death(const Robot& robot, const std::string& text) {
  const std::size_t equals = text.rfind('=');
  double t = 0;
  const bool read = equals != std::string::npos &&
                    CLI::detail::lexical_cast(text.substr(equals + 1), t) && t >= 0 &&
                    std::isfinite(t);
  if (!read) {
    throw std::invalid_argument("--dies: got '" + text +
                                "', expected NAME=TIME: an actuator and a time >= 0 s");
  }
  return death_of(robot, "--dies", text.substr(0, equals), t);
}

}  // namespace

void DiesOption::add(CLI::App& app, TankOptions& tank) {
  app.add_option("--dies", texts,
                 "NAME=TIME: the thruster or joint drive of this name exerts nothing from this "
                 "time on [s]; repeatable")
      ->type_name("NAME=TIME");
  app.add_option("--noticed-after", tank.noticed_after,
                 "time until the controller no longer counts on it [s]")
      ->capture_default_str()
      ->needs("--dies")
      ->check([](const std::string& text) -> std::string {
        double value = 0;
        if (CLI::detail::lexical_cast(text, value) && value >= 0 && std::isfinite(value)) return "";
        return fmt::format("got {}, expected a time >= 0 s", text);
      });
}

void DiesOption::read(const Robot& robot, TankOptions& tank) const {
  for (const std::string& text : texts) tank.deaths.push_back(read_death(robot, text));
}

void print_deaths(const Robot& robot, const TankOptions& tank) {
  for (const ActuatorDeath& death : tank.deaths) {
    fmt::print(
        "dies        {} at {:g} s{}\n", actuator_name(robot, death.actuator), death.t,
        tank.noticed_after > 0 ? fmt::format(", noticed after {:g} s", tank.noticed_after) : "");
  }
}

void print_after(const AfterDeaths& after) {
  const std::string mean = std::isfinite(after.mean) ? fmt::format("{:.5f}", after.mean) : "none";
  fmt::print(
      "afterwards  {} once settled, between {:.5f} and {:.5f}, at the end {:.5f}; posture off by "
      "{:.2g}\n",
      mean, after.low, after.high, after.last, after.configuration_error);
}

nlohmann::ordered_json deaths_object(const Robot& robot, const TankOptions& tank) {
  auto all = nlohmann::ordered_json::array();
  for (const ActuatorDeath& death : tank.deaths) {
    all.push_back({{"name", actuator_name(robot, death.actuator)},
                   {"t", death.t},
                   {"noticed_after", tank.noticed_after}});
  }
  return all;
}

nlohmann::ordered_json after_object(const AfterDeaths& after) {
  return {{"t", after.t},       {"mean", after.mean},
          {"low", after.low},   {"high", after.high},
          {"last", after.last}, {"configuration_error", after.configuration_error}};
}

}  // namespace maxwrench
