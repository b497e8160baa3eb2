#include "benchmarks/tables/table.h"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "tests/support/support.h"
#include "tests/support/table.h"

namespace maxwrench {
namespace {

void put_row(Table table, const std::vector<std::string>& row) {
  table.put(row);
  table.write();
}

TEST(Table, ReplacesRowsByKeyAndKeepsTheRest) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "sub" / "t.csv";
  {
    Table table(file, {"a", "b", "value"}, 2);
    table.put({"1", "x", "first, with \"quotes\""});
    table.put({"2", "x", "second"});
    table.write();
  }
  put_row(Table(file, {"a", "b", "value"}, 2), {"2", "x", "third"});
  EXPECT_EQ(read_table(file), "a,b,value\n1,x,\"first, with \"\"quotes\"\"\"\n2,x,third\n");
}

/// What another version wrote as plain text is packed with the next write.
TEST(Table, IsOnePackedFile) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "t.csv";
  std::ofstream(file) << "a,value\n1,old\n";
  put_row(Table(file, {"a", "value"}, 1), {"2", "new"});
  EXPECT_FALSE(std::filesystem::exists(file));
  const std::string packed = read_text(folder.path() / "t.csv.gz");
  EXPECT_EQ(packed, packed_csv("a,value\n1,old\n2,new\n"));
  Table(file, {"a", "value"}, 1).write();
  EXPECT_EQ(read_text(folder.path() / "t.csv.gz"), packed);
  std::ofstream(folder.path() / "t.csv.gz") << packed.substr(0, packed.size() / 2);
  EXPECT_THROW(Table(file, {"a", "value"}, 1), std::invalid_argument);
}

TEST(Table, NewColumnsAreEmptyInOldRows) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "t.csv";
  put_row(Table(file, {"a", "b", "seconds"}, 2), {"1", "x", "0.5"});
  put_row(Table(file, {"a", "b", "threads", "seconds"}, 2), {"2", "x", "8", "0.1"});
  EXPECT_EQ(read_table(file), "a,b,threads,seconds\n1,x,,0.5\n2,x,8,0.1\n");
}

TEST(Table, LineBreaksBecomeBlanks) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "t.csv";
  put_row(Table(file, {"a", "value"}, 1), {"two\nlines", "1"});
  put_row(Table(file, {"a", "value"}, 1), {"other", "2"});
  EXPECT_EQ(read_table(file), "a,value\nother,2\ntwo lines,1\n");
}

TEST(Table, RowsAreInTheOrderOfTheirKeys) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "t.csv";
  Table table(file, {"a", "b", "value"}, 2);
  for (const char* a : {"x", "", "w"}) {
    for (const char* b : {"10", "9", "100"}) table.put({a, b, "v"});
  }
  table.write();
  EXPECT_EQ(read_table(file),
            "a,b,value\n,9,v\n,10,v\n,100,v\nw,9,v\nw,10,v\nw,100,v\nx,9,v\nx,10,v\nx,100,v\n");
}

TEST(Table, WhoIsKilledLeavesAJournal) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "t.csv";
  put_row(Table(file, {"a", "value"}, 1), {"1", "old"});
  { Table(file, {"a", "value"}, 1).put({"2", "new"}); }  // never written
  EXPECT_EQ(read_table(file), "a,value\n1,old\n");
  Table table(file, {"a", "value"}, 1);
  EXPECT_EQ(table.size(), 2U);
  EXPECT_EQ(table.find({"2"})->back(), "new");
  EXPECT_FALSE(table.find({"3"}));
  table.write();
  EXPECT_EQ(read_table(file), "a,value\n1,old\n2,new\n");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "t.csv.part"));
}

TEST(Table, BelongsToWhoHoldsIt) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "t.csv";
  Table early(file, {"a", "value"}, 1);
  {
    Table first(file, {"a", "value"}, 1);
    first.hold();
    EXPECT_THROW(early.hold(), std::invalid_argument);
    EXPECT_THROW(early.put({"0", "x"}), std::invalid_argument);
    first.put({"1", "x"});
    first.write();
  }
  early.hold();  // sees what was written since it was read
  early.put({"2", "y"});
  EXPECT_EQ(read_table(file), "a,value\n1,x\n");
  early.write();
  EXPECT_EQ(read_table(file), "a,value\n1,x\n2,y\n");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "t.csv.part"));
}

TEST(Table, MayBeHeldInVain) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "t.csv";
  { Table(file, {"a", "value"}, 1).hold(); }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  Table table(file, {"a", "value"}, 1);
  table.hold();
  table.write();
  EXPECT_EQ(read_table(file), "a,value\n");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "t.csv.part"));
}

TEST(Table, ForgetsWhatIsDropped) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "t.csv";
  Table table(file, {"a", "value"}, 1);
  for (const char* a : {"1", "2", "3"}) table.put({a, "x"});
  table.drop([](const std::vector<std::string>& row) { return row[0] == "2"; });
  table.write();
  EXPECT_EQ(read_table(file), "a,value\n1,x\n3,x\n");
}

/// Rows that are not understood would be lost with the next one. Of a journal they are what a
/// killed process left.
TEST(Table, RowsThatAreNotUnderstoodAreRejected) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "t.csv";
  for (const char* text : {"a,gone,value\n1,2,3\n", "b,a,value\n1,2,3\n", "a\n1\n",
                           "a,b,value\n1,2\n", "a,b,value\n1,2,3", "a,b,value\r\n1,2,3\r\n"}) {
    std::ofstream(file) << text;
    EXPECT_THROW(Table(file, {"a", "b", "value"}, 2), std::invalid_argument) << text;
  }
  std::filesystem::remove(file);
  std::ofstream(folder.path() / "t.csv.part") << "a,b,value\n1,2,3\n1,2\n2,2,torn";
  EXPECT_EQ(Table(file, {"a", "b", "value"}, 2).size(), 1U);
}

/// Taken for an empty table, it would be lost with the next row.
TEST(Table, WhatIsNoTableIsRejected) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "t.csv");
  EXPECT_THROW(Table(folder.path() / "t.csv", {"a"}, 1), std::invalid_argument);
  std::filesystem::create_symlink("circle", folder.path() / "circle");
  EXPECT_THROW(Table(folder.path() / "circle", {"a"}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
