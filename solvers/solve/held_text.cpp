#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "maxwrench/held.h"
#include "solvers/solve/format.h"

namespace maxwrench {

std::string summary(const HeldTrajectory& held) {
  std::string text;
  if (held.answer.task) text += summary(held.answer);
  if (std::isfinite(held.reading)) {
    const TankSummary& tank = held.run.summary;
    text += fmt::format(
        "tank       reading {:.5f} {} of {:.5f} planned, {:.4f} of the value; error {:.2g}; {}\n",
        held.reading, held.answer.unit, tank.planned, held.share, tank.configuration_error,
        tank.held ? "held" : "not held: " + tank.missed);
    text += fmt::format("first      reading {:.5f} of the best trajectory that was planned\n",
                        held.first);
  }
  const bool why = !held.stopped.empty() && held.stopped != held.reason.c_str();
  text += fmt::format("{}{}{}: {} experiment{} in {:.3g} s{}{}\n", to_string(held.status),
                      held.reason.empty() ? "" : ", ", held.reason.c_str(), held.simulations,
                      held.simulations == 1 ? "" : "s", held.seconds, why ? "; " : "",
                      why ? held.stopped : "");
  return text;
}

std::string to_json(const HeldTrajectory& held) {
  nlohmann::ordered_json object = nlohmann::ordered_json::object();
  if (held.answer.task) object = nlohmann::ordered_json::parse(to_json(held.answer));
  object["status"] = to_string(held.status);
  object["reason"] = held.reason.str();
  const TankSummary& tank = held.run.summary;
  const bool ran = std::isfinite(held.reading);
  object["tank"] = {{"reading", known(ran, held.reading)},
                    {"first", known(ran, held.first)},
                    {"planned", known(ran, tank.planned)},
                    {"share", known(ran, held.share)},
                    {"configuration_error", known(ran, tank.configuration_error)},
                    {"held", tank.held},
                    {"missed", tank.missed},
                    {"simulations", held.simulations},
                    {"stopped", held.stopped},
                    {"wall_s", held.seconds}};
  return in_one_line(object);
}

}  // namespace maxwrench
