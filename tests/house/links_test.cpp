#include <gtest/gtest.h>

#include <cctype>
#include <regex>
#include <set>
#include <sstream>

#include "tests/house/documents.h"

// The links of the documents lead somewhere; the paths that they name exist.

namespace maxwrench {
namespace {

/// As GitHub makes them of headings: lower case, hyphens for blanks, letters and digits only.
std::set<std::string> anchors(const fs::path& file) {
  std::set<std::string> found;
  std::istringstream text(read_text(file));
  for (std::string line; std::getline(text, line);) {
    if (!line.starts_with("#")) continue;
    std::string anchor;
    for (const char c : line.substr(line.find_first_not_of("# "))) {
      if (c == ' ') anchor += '-';
      if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_') {
        anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      }
    }
    found.insert(anchor);
  }
  return found;
}

TEST(DocsLinks, LeadSomewhere) {
  static const std::regex kLink("\\]\\(([^)# ]*)(#[^) ]*)?\\)");
  std::vector<std::string> files = documents();
  files.emplace_back("CONTRIBUTING.md");
  for (const auto& entry : fs::directory_iterator(kRoot / "problems")) {
    if (fs::exists(entry.path() / "README.md"))
      files.push_back(fs::relative(entry.path() / "README.md", kRoot));
  }
  int links = 0;
  for (const std::string& file : files) {
    const std::string text = read_text(kRoot / file);
    for (std::sregex_iterator link(text.begin(), text.end(), kLink), end; link != end; ++link) {
      const std::string path = (*link)[1];
      if (path.find("://") != std::string::npos) continue;
      ++links;
      const fs::path target = path.empty() ? kRoot / file : (kRoot / file).parent_path() / path;
      EXPECT_TRUE(fs::exists(target)) << file << ": " << path;
      if (!fs::exists(target)) continue;
      const std::string anchor = (*link)[2];
      if (anchor.empty()) continue;
      EXPECT_TRUE(anchors(target).contains(anchor.substr(1))) << file << ": " << path << anchor;
    }
  }
  EXPECT_GT(links, 30);
}

/// Files that are named by their path from the root; what is in capitals stands for a name.
TEST(DocsPaths, Exist) {
  static const std::regex kFile(
      "`((include|lib|solvers|problems|drawing|benchmarks|view|cli|examples|tests|results|docs|"
      "paper)/"
      "[a-z0-9_/.]*)`");
  std::vector<std::string> files = documents();
  files.emplace_back("CONTRIBUTING.md");
  int paths = 0;
  for (const std::string& file : files) {
    const std::string text = read_text(kRoot / file);
    for (std::sregex_iterator path(text.begin(), text.end(), kFile), end; path != end; ++path) {
      ++paths;
      EXPECT_TRUE(fs::exists(kRoot / (*path)[1].str())) << file << ": " << (*path)[1];
    }
  }
  EXPECT_GT(paths, 40);
}

}  // namespace
}  // namespace maxwrench
