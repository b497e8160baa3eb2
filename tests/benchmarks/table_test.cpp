#include "benchmarks/table.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/support.h"

namespace maxwrench {
namespace {

TEST(Table, ReplacesRowsByKeyAndKeepsTheRest) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "sub" / "t.csv";
  {
    Table table(file, {"a", "b", "value"}, 2);
    table.put({"1", "x", "first, with \"quotes\""});
    table.put({"2", "x", "second"});
  }
  Table(file, {"a", "b", "value"}, 2).put({"2", "x", "third"});
  EXPECT_EQ(read_text(file), "a,b,value\n1,x,\"first, with \"\"quotes\"\"\"\n2,x,third\n");
  // Other columns: the old rows would mean something else, the file starts anew.
  Table(file, {"a", "value"}, 1).put({"9", "new"});
  EXPECT_EQ(read_text(file), "a,value\n9,new\n");
}

TEST(Table, NewColumnsAreEmptyInOldRows) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "t.csv";
  Table(file, {"a", "b", "seconds"}, 2).put({"1", "x", "0.5"});
  Table(file, {"a", "b", "threads", "seconds"}, 2).put({"2", "x", "8", "0.1"});
  EXPECT_EQ(read_text(file), "a,b,threads,seconds\n1,x,,0.5\n2,x,8,0.1\n");
}

TEST(Table, LineBreaksBecomeBlanks) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "t.csv";
  Table(file, {"a", "value"}, 1).put({"two\nlines", "1"});
  Table(file, {"a", "value"}, 1).put({"other", "2"});
  EXPECT_EQ(read_text(file), "a,value\ntwo lines,1\nother,2\n");
}

/// Taken for an empty table, it would be lost with the next row.
TEST(Table, WhatIsNoTableIsRefused) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "t.csv");
  EXPECT_THROW(Table(folder.path() / "t.csv", {"a"}, 1), std::invalid_argument);
  std::filesystem::create_symlink("circle", folder.path() / "circle");
  EXPECT_THROW(Table(folder.path() / "circle", {"a"}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
