#include "benchmarks/table.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support.h"

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

TEST(Table, UnwritablePlaceIsNamed) {
  EXPECT_THROW(write_file("/proc/nowhere/t.csv", ""), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
