#include "cli/task/held_option.h"

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

#include "cli/cli.h"
#include "cli/ctrl_c.h"
#include "cli/progress.h"

namespace maxwrench {

void HeldOption::add(CLI::App& app) {
  constexpr long kMostSimulations = 1'000'000;
  app.add_option("--worth", worth,
                 "what is maximised, of a task in time: the value of the plan, or the reading that "
                 "the virtual tank holds")
      ->capture_default_str()
      ->check(CLI::IsMember({"plan", "tank"}));
  app.add_option("--simulations", how.simulations, "largest number of experiments of --worth tank")
      ->capture_default_str()
      ->check(CLI::Range(1L, kMostSimulations))
      ->needs("--worth")
      ->each([this](const std::string&) { has_simulations = true; });
}

bool HeldOption::tank() const {
  if (worth == "tank") return true;
  if (has_simulations) {
    throw std::invalid_argument("--simulations: got " + std::to_string(how.simulations) +
                                ", expected no such option without --worth tank");
  }
  return false;
}

HeldTrajectory HeldOption::solve(const Problem& problem, Options options) const {
  if (!problem.motion) {
    throw std::invalid_argument("--worth: got tank for " + problem.name +
                                ", a static task, expected a task in time");
  }
  Progress progress("solve", static_cast<double>(how.simulations));
  CtrlC ctrl_c;
  options.progress = progress.counter();
  options.interrupted = ctrl_c.asked();
  HeldTrajectory held = solve_held(problem, options, how);
  progress.finish();
  return held;
}

int HeldOption::report(const HeldTrajectory& held, bool json) {
  fmt::print("{}", json ? to_json(held) + "\n" : summary(held));
  return held.status == Status::kBestFound ? kAnswered : kOtherStatus;
}

}  // namespace maxwrench
