#include "benchmarks/csv.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/support.h"

namespace maxwrench {
namespace {

class Csv : public testing::Test {
 protected:
  std::filesystem::path file(const std::string& text) {
    std::ofstream(folder_.path() / "t.csv") << text;
    return folder_.path() / "t.csv";
  }
  std::string complaint(const std::string& text) {
    try {
      const CsvFile csv = read_csv(file(text), {"a", "b"});
      for (std::size_t i = 0; i < csv.rows.size(); ++i) csv.number(i, "b");
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  }
  TemporaryFolder folder_;
};

TEST_F(Csv, FieldsComeBack) {
  const std::vector<std::string> fields = {"plain", "", "a,b", "say \"so\"", "1.5"};
  EXPECT_EQ(split_csv(join_csv(fields)), fields);
  EXPECT_EQ(join_csv({"two\nlines"}), "two lines");
}

TEST_F(Csv, NumbersAndNone) {
  const CsvFile csv = read_csv(file("a,c,b\nx,,-2.5e-3\ny,,\nz,1,-\n"), {"b"}, {"d", "a"});
  ASSERT_EQ(csv.rows.size(), 3U);
  EXPECT_EQ(csv.number(0, "b"), -2.5e-3);
  EXPECT_FALSE(csv.number(1, "b"));
  EXPECT_FALSE(csv.number(2, "b"));
  EXPECT_EQ(csv.text(2, "a"), "z");
  EXPECT_FALSE(csv.has("c"));  // nobody asked
  EXPECT_FALSE(csv.has("d"));
}

TEST_F(Csv, NamesWhatIsWrong) {
  const std::string name = (folder_.path() / "t.csv").string();
  EXPECT_EQ(complaint("a,c\n"), name + ": line 1: got no column 'b', expected one");
  EXPECT_EQ(complaint("a,b\n1,2\n1\n"), name + ": line 3: got 1 fields, expected 2");
  for (const char* bad : {"nan", "inf", "1.5x", "two", " 1"}) {
    EXPECT_EQ(complaint(std::string("a,b\n1,") + bad + "\n"),
              name + ": line 2: b: got '" + bad + "', expected a finite number or nothing");
  }
  EXPECT_NE(complaint("").find("got no table"), std::string::npos);
  EXPECT_THROW(read_csv(folder_.path(), {}), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
