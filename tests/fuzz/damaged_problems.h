#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lib/math/random.h"
#include "tests/support/support.h"

namespace maxwrench {

/// Copies of the shipped robots, tasks and states, one file of which is damaged at a time.
class DamagedProblems {
 public:
  DamagedProblems();

  /// Damages a file, reads the problem that it belongs to and evaluates its default posture, as the
  /// command would: what came of it. Throws std::logic_error if that is neither an answer nor one
  /// line of rejection.
  std::string step(Random& random);

 private:
  struct Target {
    std::filesystem::path file;  ///< what is damaged
    std::filesystem::path task;  ///< what is then read
    std::string text;            ///< of the file, unharmed
  };
  static std::string read(const Target& target);

  TemporaryFolder folder_;
  std::vector<Target> targets_;
};

}  // namespace maxwrench
