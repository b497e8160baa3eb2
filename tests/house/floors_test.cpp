#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

#include "tests/support/support.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;

const std::vector<std::vector<std::string>> kFloors = {
    {"lib"},  {"verify"},        {"solvers", "problems"}, {"drawing", "benchmarks"},
    {"view"}, {"cli", "python"}, {"examples", "tests"}};

/// Public headers stand on the floor of their implementation.
const std::map<std::string, std::string> kImplementedIn = {{"strategies.h", "solvers"},
                                                           {"batch.h", "solvers"},
                                                           {"bound.h", "solvers"},
                                                           {"version.h", "solvers"},
                                                           {"solve.h", "solvers"},
                                                           {"load.h", "problems"},
                                                           {"certify.h", "solvers"},
                                                           {"verification.h", "verify"},
                                                           {"mps.h", "problems"},
                                                           {"held.h", "solvers"},
                                                           {"trajectory_proof.h", "solvers"},
                                                           {"task.h", "problems"},
                                                           {"figures.h", "drawing"},
                                                           {"evaluations.h", "solvers"},
                                                           {"wrench_set.h", "solvers"},
                                                           {"explain.h", "solvers"},
                                                           {"sensitivity.h", "solvers"},
                                                           {"map.h", "solvers"},
                                                           {"pareto.h", "solvers"},
                                                           {"margin.h", "solvers"},
                                                           {"motion_table.h", "problems"},
                                                           {"plan_bound.h", "solvers"}};

/// How deep a chain of our own includes may go.
constexpr int kMostIncludeDepth = 10;

int floor_of(const std::string& folder) {
  for (std::size_t i = 0; i < kFloors.size(); ++i) {
    if (std::count(kFloors[i].begin(), kFloors[i].end(), folder)) return static_cast<int>(i);
  }
  return -1;
}

/// The folder that a file, by its path from the root, belongs to.
std::string folder_of(const std::string& file) {
  static const std::string kPublic = "include/maxwrench/";
  if (!file.starts_with(kPublic)) return file.substr(0, file.find('/'));
  const auto found = kImplementedIn.find(file.substr(kPublic.size()));
  return found == kImplementedIn.end() ? "lib" : found->second;
}

/// What stands behind `start` at the beginning of a line, or nothing.
std::string included(const std::string& line, const std::string& start) {
  return line.starts_with(start) ? line.substr(start.size(), line.size() - start.size() - 1) : "";
}

/// A path from the root for the text of an include line.
std::string to_path(const std::string& text) {
  return text.starts_with("maxwrench/") ? "include/" + text : text;
}

bool of_solver_library(const std::string& header) {
  for (const char* prefix :
       {"Ip", "nlopt", "nvector", "cvode", "ida", "arkode", "sun", "Clp", "glpk", "pagmo"}) {
    if (header.starts_with(prefix)) return true;
  }
  return false;
}

struct Source {
  std::vector<std::string> own;     // files of ours that it includes, from the root
  std::vector<std::string> others;  // headers of libraries
};

/// Every header and source of ours.
const std::map<std::string, Source>& sources() {
  static const std::map<std::string, Source> kSources = [] {
    const fs::path root(MAXWRENCH_SOURCE_DIR);
    std::map<std::string, Source> all;
    std::vector<std::string> folders = {"include"};
    for (const auto& floor : kFloors) folders.insert(folders.end(), floor.begin(), floor.end());
    for (const std::string& folder : folders) {
      if (!fs::exists(root / folder)) continue;
      for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
        if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
        Source& source = all[fs::relative(entry.path(), root).string()];
        std::istringstream text(read_text(entry.path()));
        for (std::string line; std::getline(text, line);) {
          const std::string quoted = included(line, "#include \"");
          const std::string angled = included(line, "#include <");
          if (!quoted.empty()) source.own.push_back(to_path(quoted));
          if (!angled.empty()) source.others.push_back(angled);
        }
      }
    }
    return all;
  }();
  return kSources;
}

/// An include line shows its floor: a file may include its own folder and lower floors, never a
/// sibling; and libraries of solvers only stand in solvers.
TEST(Floors, IncludesGoDownwards) {
  for (const auto& [file, source] : sources()) {
    const std::string folder = folder_of(file);
    for (const std::string& header : source.own) {
      const std::string from = folder_of(header);
      const bool allowed = from == folder || floor_of(from) < floor_of(folder);
      EXPECT_TRUE(allowed && floor_of(from) >= 0) << file << ": " << header;
    }
    if (folder == "solvers" || folder == "tests") continue;
    for (const std::string& header : source.others) {
      EXPECT_FALSE(of_solver_library(header)) << file << ": " << header;
    }
  }
  EXPECT_GT(sources().size(), 200U);
}

/// A check of proofs shares plain data and the loader's answer with what makes them, and no code.
TEST(Floors, VerifyKnowsNoSolver) {
  for (const auto& [file, source] : sources()) {
    if (folder_of(file) != "verify") continue;
    for (const std::string& header : source.own) {
      const bool plain =
          header == "include/maxwrench/types.h" || header == "include/maxwrench/zonotope.h" ||
          header == "include/maxwrench/linear_program.h" ||
          header == "include/maxwrench/problem.h" || header == "include/maxwrench/interruption.h";
      EXPECT_TRUE(plain || folder_of(header) == "verify") << file << ": " << header;
    }
  }
}

/// Whether `name` is a word of the folder's `sources.cmake`.
bool is_listed(const std::string& folder, const std::string& name) {
  std::string text = read_text(fs::path(MAXWRENCH_SOURCE_DIR) / folder / "sources.cmake");
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == ')'; }, ' ');
  return text.find(" " + name + " ") != std::string::npos;
}

/// A source that its folder's list forgets would be built by nobody.
TEST(Floors, ListsNameEverySource) {
  const fs::path root(MAXWRENCH_SOURCE_DIR);
  for (const auto& [file, source] : sources()) {
    const std::string folder = file.substr(0, file.find('/'));
    const std::string name = fs::path(file).filename().string();
    if (!file.ends_with(".cpp") || !fs::exists(root / folder / "sources.cmake")) continue;
    if (name == "main.cpp" || name.ends_with("_bench.cpp")) continue;
    EXPECT_TRUE(is_listed(folder, file.substr(folder.size() + 1))) << file;
  }
  int modules = 0;
  for (const fs::directory_entry& each : fs::directory_iterator(root / "python/maxwrench")) {
    if (each.path().extension() != ".py") continue;
    ++modules;
    EXPECT_TRUE(is_listed("python", each.path().filename().string())) << each.path();
  }
  EXPECT_GT(modules, 10);
}

/// What is installed includes nothing that is not.
TEST(Floors, PublicHeadersIncludeNothingPrivate) {
  int headers = 0;
  for (const auto& [file, source] : sources()) {
    if (!file.starts_with("include/")) continue;
    ++headers;
    for (const std::string& header : source.own) {
      EXPECT_TRUE(header.starts_with("include/maxwrench/")) << file << ": " << header;
    }
    for (const std::string& header : source.others) {
      EXPECT_TRUE(header.find('/') == std::string::npos || header.starts_with("Eigen/"))
          << file << ": " << header;
    }
  }
  EXPECT_GE(headers, 20);
  EXPECT_LE(headers, 46);
}

int depth(const std::string& file, std::map<std::string, int>& known) {
  const auto found = known.find(file);
  if (found != known.end()) return found->second;
  known[file] = 1000;  // a circle
  int deepest = 0;
  const auto source = sources().find(file);
  if (source == sources().end()) ADD_FAILURE() << file << " is included and does not exist";
  if (source != sources().end()) {
    for (const std::string& header : source->second.own) {
      deepest = std::max(deepest, depth(header, known) + 1);
    }
  }
  return known[file] = deepest;
}

TEST(Floors, IncludeDepth) {
  std::map<std::string, int> known;
  for (const auto& [file, source] : sources()) {
    EXPECT_LE(depth(file, known), kMostIncludeDepth) << file;
  }
}

/// The constants that a file defines in lines that begin with `begin`.
std::vector<std::string> constants_of(const std::string& file, const std::string& begin) {
  std::vector<std::string> names;
  std::istringstream text(read_text(fs::path(MAXWRENCH_SOURCE_DIR) / file));
  for (std::string line; std::getline(text, line);) {
    if (!line.starts_with(begin)) continue;
    std::string name = line.substr(0, line.find_first_of("={["));
    name.erase(name.find_last_not_of(' ') + 1);
    names.push_back(name.substr(name.find_last_of(' ') + 1));
  }
  return names;
}

/// Two headers that define the same constant differently break the one-definition rule as soon as
/// one program includes both.
TEST(Floors, ConstantsOfHeadersAreDefinedOnce) {
  std::map<std::string, std::string> where;
  for (const auto& [file, source] : sources()) {
    if (!file.ends_with(".h")) continue;
    for (const std::string& name : constants_of(file, "inline constexpr")) {
      // The two sides of an #if are one file's business.
      EXPECT_EQ(where.emplace(name, file).first->second, file) << name;
    }
  }
  EXPECT_GT(where.size(), 10U);
}

/// A build may join all sources of a library into one.
TEST(Floors, ConstantsOfSourcesAreDefinedOnceInALibrary) {
  std::map<std::string, std::string> where;
  for (const auto& [file, source] : sources()) {
    const std::string folder = folder_of(file);
    const int floor = floor_of(folder);
    if (!file.ends_with(".cpp") || floor < 0 || floor > floor_of("solvers")) continue;
    for (const std::string& name : constants_of(file, "constexpr")) {
      EXPECT_EQ(where.emplace(folder + " " + name, file).first->second, file) << name;
    }
  }
  EXPECT_GT(where.size(), 100U);
}

}  // namespace
}  // namespace maxwrench
