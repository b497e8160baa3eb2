#include "tests/support/bad_input.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "maxwrench/load.h"

namespace maxwrench {

namespace fs = std::filesystem;

void expect_rejected(const ChangedProblem& input, const std::string& problem) {
  std::string name = (fs::temp_directory_path() / "maxwrench_bad_XXXXXX").string();
  const fs::path folder = mkdtemp(name.data());
  const fs::path task = fs::path(MAXWRENCH_SOURCE_DIR) / "problems" / (problem + ".toml");
  for (const auto& entry : fs::directory_iterator(task.parent_path())) {
    std::ifstream stream(entry.path());
    std::string text(std::istreambuf_iterator<char>(stream), {});
    if (entry.path().filename() == input.file) {
      const std::size_t at = text.find(input.from);
      ASSERT_NE(at, std::string::npos) << "the shipped file has no " << input.from;
      text.replace(at, std::string(input.from).size(), input.to);
    }
    std::ofstream(folder / entry.path().filename()) << text;
  }
  testing::internal::CaptureStderr();
  try {
    load_problem((folder / task.filename()).string());
    ADD_FAILURE() << "was accepted";
  } catch (const std::invalid_argument& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find((folder / input.file).string() + ": "), 0u) << message;
    EXPECT_THAT(message, testing::HasSubstr("expected"));
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    for (const std::string& part : input.message) EXPECT_THAT(message, testing::HasSubstr(part));
    testing::Test::RecordProperty("message", message);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  fs::remove_all(folder);
}

}  // namespace maxwrench
