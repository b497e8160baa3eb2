#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace maxwrench {

/// A shipped problem with one passage changed.
struct ChangedProblem {
  const char* name;
  const char* file;  ///< the changed file, which the message must name
  const char* from;  ///< replaced once; empty: the file is removed
  const char* to;
  std::vector<std::string> message;  ///< texts that it must contain
};

inline void PrintTo(const ChangedProblem& input, std::ostream* out) { *out << input.name; }

/// The loader must reject it in one line that names file, key and value, and print nothing.
void expect_rejected(const ChangedProblem& input, const std::string& problem = "planar/force");

}  // namespace maxwrench
