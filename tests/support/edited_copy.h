#pragma once

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/support.h"

namespace maxwrench {

/// A copy of the planar problems whose files may be edited.
class EditedCopy {
 public:
  EditedCopy() {
    std::filesystem::copy(std::filesystem::path(MAXWRENCH_SOURCE_DIR) / "problems" / "planar",
                          folder_.path());
  }
  void replace(const std::string& file, const std::string& from, const std::string& to) {
    std::string text = read_text(folder_.path() / file);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << "'" << from << "' is not in " << file;
    std::ofstream(folder_.path() / file) << text.replace(at, from.size(), to);
  }
  const std::filesystem::path& path() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
};

}  // namespace maxwrench
