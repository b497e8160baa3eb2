#pragma once

#include <fstream>
#include <string>

#include "maxwrench/load.h"
#include "tests/support/support.h"

namespace maxwrench {

/// A shipped task in time of the underwater vehicle, with this table [wrench] ("": that of the
/// task) and these further tables.
inline Problem task_in_time(const std::string& name, const std::string& wrench,
                            const std::string& tables) {
  const std::string folder = MAXWRENCH_SOURCE_DIR "/problems/uvms/";
  std::string text = read_text(folder + name + ".toml");
  const std::size_t from = text.find("[wrench]"), to = text.find("[theta_r]");
  if (!wrench.empty()) text.replace(from, to - from, "[wrench]\n" + wrench + "\n\n");
  const std::string robot = "bluerov2_alpha5.toml";
  text.replace(text.find(robot), robot.size(), folder + robot);
  const TemporaryFolder temporary;
  std::ofstream(temporary.path() / "task.toml") << text << "\n" << tables;
  return load_problem((temporary.path() / "task.toml").string());
}

}  // namespace maxwrench
