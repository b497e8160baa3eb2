#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
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

/// An include line shows its floor: a file may include its own folder and lower floors, never a
/// sibling; and libraries of solvers only stand in solvers.
TEST(Floors, IncludesGoDownwards) {
  const std::filesystem::path root(MAXWRENCH_SOURCE_DIR);
  const std::regex own("#include \"([a-z_]+)/[^\"]*\"");
  const std::regex relative("#include \"[^/\"]*\"");
  const std::regex solver_library("#include <(Ip|nlopt|nvector|cvode|ida|arkode|Clp|glpk)");
  int files = 0;
  for (const auto& floor : kFloors) {
    for (const std::string& folder : floor) {
      for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
        if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
        ++files;
        std::istringstream text(read_text(entry.path()));
        for (std::string line; std::getline(text, line);) {
          std::smatch match;
          EXPECT_FALSE(std::regex_search(line, relative)) << entry.path() << ": " << line;
          if (folder != "solvers" && folder != "tests") {
            EXPECT_FALSE(std::regex_search(line, solver_library)) << entry.path() << ": " << line;
          }
          if (!std::regex_search(line, match, own)) continue;
          const bool allowed = match[1] == folder || floor_of(match[1]) < floor_of(folder);
          EXPECT_TRUE(allowed && floor_of(match[1]) >= 0) << entry.path() << ": " << line;
        }
      }
    }
  }
  EXPECT_GT(files, 50);
}

}  // namespace
}  // namespace maxwrench
