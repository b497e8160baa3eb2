#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "tests/support.h"

namespace maxwrench {
namespace {

const std::vector<std::vector<std::string>> kFloors = {
    {"lib"}, {"solvers", "problems"}, {"benchmarks"}, {"cli"}, {"tests"}};

int floor_of(const std::string& folder) {
  for (std::size_t i = 0; i < kFloors.size(); ++i) {
    if (std::count(kFloors[i].begin(), kFloors[i].end(), folder)) return static_cast<int>(i);
  }
  return -1;
}

/// What stands behind `start` at the beginning of a line, or nothing.
std::string included(const std::string& line, const std::string& start) {
  return line.starts_with(start) ? line.substr(start.size()) : "";
}

bool of_solver_library(const std::string& header) {
  for (const char* prefix :
       {"Ip", "nlopt", "nvector", "cvode", "ida", "arkode", "sun", "Clp", "glpk"}) {
    if (header.starts_with(prefix)) return true;
  }
  return false;
}

/// An include line shows its floor: a file may include its own folder and lower floors, never a
/// sibling; and libraries of solvers only stand in solvers.
TEST(Floors, IncludesGoDownwards) {
  const std::filesystem::path root(MAXWRENCH_SOURCE_DIR);
  int files = 0;
  for (const auto& floor : kFloors) {
    for (const std::string& folder : floor) {
      for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
        if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
        ++files;
        std::istringstream text(read_text(entry.path()));
        for (std::string line; std::getline(text, line);) {
          const std::string quoted = included(line, "#include \"");
          const std::string angled = included(line, "#include <");
          if (folder != "solvers" && folder != "tests") {
            EXPECT_FALSE(of_solver_library(angled)) << entry.path() << ": " << line;
          }
          if (quoted.empty()) continue;
          const std::string from = quoted.substr(0, quoted.find('/'));
          const bool allowed = from == folder || floor_of(from) < floor_of(folder);
          EXPECT_TRUE(allowed && floor_of(from) >= 0) << entry.path() << ": " << line;
        }
      }
    }
  }
  EXPECT_GT(files, 50);
}

}  // namespace
}  // namespace maxwrench
