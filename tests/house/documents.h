#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/support.h"

// The documents that the tests of this folder read.

namespace maxwrench {

namespace fs = std::filesystem;

inline const fs::path kRoot(MAXWRENCH_SOURCE_DIR);

/// README.md and the pages of docs/ and its folders, by their paths from the root.
inline std::vector<std::string> documents() {
  std::vector<std::string> files = {"README.md"};
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "docs")) {
    if (entry.path().extension() == ".md") files.push_back(fs::relative(entry.path(), kRoot));
  }
  std::sort(files.begin() + 1, files.end());
  return files;
}

/// What stands between two fences of a document.
struct DocumentBlock {
  std::string kind;  ///< such as console
  std::vector<std::string> lines;
};

inline std::vector<DocumentBlock> document_blocks(const std::string& file) {
  std::vector<DocumentBlock> found;
  bool inside = false;
  std::istringstream text(read_text(kRoot / file));
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("```")) {
      inside = !inside;
      if (inside) found.push_back({line.substr(3), {}});
    } else if (inside) {
      found.back().lines.push_back(line);
    }
  }
  EXPECT_FALSE(inside) << file << ": a block without an end";
  return found;
}

inline const std::string kPrompt = "$ build/maxwrench ";

inline std::vector<std::string> documents_with_commands() {
  std::vector<std::string> files;
  for (const std::string& file : documents()) {
    if (read_text(kRoot / file).find("\n" + kPrompt) != std::string::npos) files.push_back(file);
  }
  return files;
}

/// Whether a line is the one shown, whose end may be left out: "beta ...".
inline bool is_shown(const std::string& line, const std::string& shown) {
  if (!shown.ends_with("...")) return line == shown;
  return line.starts_with(shown.substr(0, shown.size() - 3));
}

}  // namespace maxwrench
