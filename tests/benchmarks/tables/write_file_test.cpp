#include "benchmarks/tables/write_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <fstream>
#include <future>
#include <set>
#include <stdexcept>
#include <string>

#include "tests/support/support.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;

class WriteFile : public testing::Test {
 protected:
  void expect_rejected(const fs::path& file, const std::string& reason) {
    try {
      write_file(file, "new");
      ADD_FAILURE() << file << " was written";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos) << error.what();
    }
  }
  /// Nothing but these names is in the folder.
  void expect_only(const std::set<std::string>& names) {
    std::set<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder_.path()))
      found.insert(entry.path().filename().string());
    EXPECT_EQ(found, names);
  }
  fs::path in(const std::string& name) const { return folder_.path() / name; }
  TemporaryFolder folder_;
};

TEST_F(WriteFile, MakesTheFolderAndLeavesNothingElse) {
  write_file(in("a/b/c.txt"), "text");
  EXPECT_EQ(read_text(in("a/b/c.txt")), "text");
  write_file(in("a/b/c.txt"), "shorter");
  EXPECT_EQ(read_text(in("a/b/c.txt")), "shorter");
  EXPECT_EQ(std::distance(fs::directory_iterator(in("a/b")), fs::directory_iterator()), 1);
}

/// A name may have 255 letters; a longer name for the time of writing would not fit.
TEST_F(WriteFile, TakesTheLongestName) {
  write_file(in(std::string(255, 'n')), "text");
  EXPECT_EQ(read_text(in(std::string(255, 'n'))), "text");
  expect_rejected(in(std::string(256, 'n')), "File name too long");
}

TEST_F(WriteFile, FollowsLinks) {
  std::ofstream(in("real")) << "old";
  fs::create_directory(in("sub"));
  fs::create_symlink("../real", in("sub/one"));
  fs::create_symlink("sub/one", in("two"));
  write_file(in("two"), "new");
  EXPECT_TRUE(fs::is_symlink(in("two")));
  EXPECT_TRUE(fs::is_symlink(in("sub/one")));
  EXPECT_EQ(read_text(in("real")), "new");
  fs::create_symlink("not_yet", in("dangling"));
  write_file(in("dangling"), "new");
  EXPECT_TRUE(fs::is_symlink(in("dangling")));
  EXPECT_EQ(read_text(in("not_yet")), "new");
  fs::create_symlink("circle", in("circle"));
  expect_rejected(in("circle"), "Too many levels");
  expect_only({"real", "sub", "two", "dangling", "not_yet", "circle"});
}

TEST_F(WriteFile, KeepsThePermissionsOfAnOldFile) {
  std::ofstream(in("private")) << "old";
  fs::permissions(in("private"), fs::perms::owner_read | fs::perms::owner_write);
  write_file(in("private"), "new");
  EXPECT_EQ(fs::status(in("private")).permissions(),
            fs::perms::owner_read | fs::perms::owner_write);
  if (geteuid() == 0) GTEST_SKIP() << "root may write to what is read-only";
  fs::permissions(in("private"), fs::perms::owner_read);
  expect_rejected(in("private"), "Permission denied");
  EXPECT_EQ(read_text(in("private")), "new");
}

TEST_F(WriteFile, PipesAreWrittenToAndStay) {
  ASSERT_EQ(mkfifo(in("pipe").c_str(), 0600), 0);
  std::future<std::string> reader =
      std::async(std::launch::async, [&] { return read_text(in("pipe")); });
  write_file(in("pipe"), "through the pipe");
  EXPECT_TRUE(fs::is_fifo(in("pipe")));
  if (!fs::is_fifo(in("pipe"))) std::ofstream(in("pipe")).flush();
  EXPECT_EQ(reader.get(), "through the pipe");
}

/// A node like /dev/full, of our own: whoever replaces it harms nobody.
TEST_F(WriteFile, DevicesAreWrittenToAndTheirReasonIsNamed) {
  if (mknod(in("full").c_str(), S_IFCHR | 0600, makedev(1, 7)) != 0) {
    GTEST_SKIP() << "only root makes devices";
  }
  const int descriptor = open(in("full").c_str(), O_WRONLY);
  if (descriptor < 0) GTEST_SKIP() << "devices of one's own do not work here";
  close(descriptor);
  expect_rejected(in("full"), "No space left on device");
  EXPECT_TRUE(fs::is_character_file(in("full")));
  expect_only({"full"});
}

TEST_F(WriteFile, FoldersAreNamed) {
  expect_rejected(folder_.path(), "Is a directory");
  std::ofstream(in("file")) << "old";
  expect_rejected(in("file/x"), "Not a directory");
  expect_rejected(in("file/x/y"), "Not a directory");
  expect_rejected("/proc/nowhere/t.csv", "No such file");
  EXPECT_EQ(read_text(in("file")), "old");
}

}  // namespace
}  // namespace maxwrench
