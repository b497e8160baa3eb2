#pragma once

#include <fstream>
#include <string>

#include "maxwrench/load.h"
#include "tests/support/support.h"

namespace maxwrench {

/// A task of the underwater vehicle, with this table [wrench] and these further tables.
inline Problem scenario_task(const std::string& wrench, const std::string& tables) {
  const std::string folder = MAXWRENCH_SOURCE_DIR "/problems/uvms/";
  std::string text = read_text(folder + "lift.toml");
  const std::size_t from = text.find("[wrench]"), to = text.find("[theta_r]");
  text.replace(from, to - from, wrench.empty() ? "" : "[wrench]\n" + wrench + "\n\n");
  const std::string robot = "bluerov2_alpha5.toml";
  text.replace(text.find(robot), robot.size(), folder + robot);
  const TemporaryFolder temporary;
  std::ofstream(temporary.path() / "task.toml") << text << "\n" << tables;
  return load_problem((temporary.path() / "task.toml").string());
}

/// A shipped task with a second contact, by its file in problems/dual_arm, with this table [wrench]
/// (empty: none) and these further tables.
inline Problem second_contact_task(const std::string& file, const std::string& wrench,
                                   const std::string& tables) {
  const std::string folder = MAXWRENCH_SOURCE_DIR "/problems/dual_arm/";
  std::string text = read_text(folder + file);
  const std::string given = "[wrench]\nc = [0, 0, 0, 0, 0, 1]\n", robot = "robot = \"";
  text.replace(text.find(given), given.size(), wrench.empty() ? "" : "[wrench]\n" + wrench + "\n");
  text.insert(text.find(robot) + robot.size(), folder);
  const TemporaryFolder temporary;
  std::ofstream(temporary.path() / "task.toml") << text << "\n" << tables;
  return load_problem((temporary.path() / "task.toml").string());
}

inline constexpr const char* kTurn = "c = [0, 0, 0, 0, 0, 1]";
inline constexpr const char* kLift = "c = [0, 0, 1, 0, 0, 0]";

/// The uncertain parameters of the reference values: 64 corners.
inline constexpr const char* kParameters = R"(
[uncertainty]
trim = 0.2
cob.vehicle = [0.005, 0, 0.005]
mass.link_2 = 0.038
com.link_2 = [0.01, 0, 0]
mass.link_4 = 0.1
)";

}  // namespace maxwrench
