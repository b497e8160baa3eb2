#include "benchmarks/tables/csv.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/support.h"
#include "verify/packed.h"

namespace maxwrench {
namespace {

class Csv : public testing::Test {
 protected:
  std::filesystem::path file(const std::string& text) {
    std::ofstream(folder_.path() / "t.csv", std::ios::binary) << text;
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

/// What is in a file counts, not its name.
TEST_F(Csv, MayBePackedByGzip) {
  const std::string text = "a,b\nx,1\ny,2\n";
  const std::string packed = packed_csv(text);
  EXPECT_EQ(packed.substr(0, 4), "\x1f\x8b\x08" + std::string(1, '\0'));  // deflate, no name
  EXPECT_EQ(packed.substr(4, 4), std::string(4, '\0'));                   // no time
  EXPECT_EQ(csv_text(file(packed)), text);
  EXPECT_EQ(complaint(packed), "");
  EXPECT_EQ(csv_text(file(text)), text);
  EXPECT_EQ(csv_text(file(packed_csv(""))), "");
  EXPECT_EQ(csv_text(folder_.path() / "none"), "");
}

/// Cut anywhere, with any one bit changed behind its header, or with something behind it.
TEST_F(Csv, DamagedGzipIsRejected) {
  const std::string packed = packed_csv("a,b\nx,1\ny,2\nz,3\n");
  const auto expect_damaged = [&](const std::string& text) {
    EXPECT_EQ(complaint(text).find((folder_.path() / "t.csv").string() + ": got a damaged file, "),
              0U)
        << complaint(text);
  };
  for (std::size_t size = 2; size < packed.size(); ++size) expect_damaged(packed.substr(0, size));
  for (std::size_t at = 10; at < packed.size(); ++at) {
    std::string changed = packed;
    changed[at] = static_cast<char>(changed[at] ^ 1);
    expect_damaged(changed);
  }
  expect_damaged(packed + "x");
}

/// A table of one letter packs a thousand times. We store it larger, and reject what would fill the
/// memory.
TEST_F(Csv, SmallFilesDoNotFillTheMemory) {
  const std::string text = "a,b\n" + std::string(10'000'000, 'x');
  EXPECT_GT(packed_csv(text).size(), text.size() / 256);
  EXPECT_EQ(csv_text(file(packed_csv(text))), text);
  const std::string bomb = pack(text, Wrapping::kGzip, 9, text.size());
  EXPECT_LT(bomb.size(), text.size() / 900);
  EXPECT_NE(complaint(bomb).find("at most 256 times smaller"), std::string::npos);
}

TEST_F(Csv, NamesWhatAnEditorLeft) {
  const std::string name = (folder_.path() / "t.csv").string();
  EXPECT_EQ(complaint("\xef\xbb\xbf"
                      "a,b\n1,2\n"),
            name + ": line 1: got a byte order mark, expected UTF-8 without one");
  EXPECT_EQ(complaint("a,b\n1,2\r\n"),
            name + ": line 2: got a carriage return, expected line breaks of Unix (LF, not CR LF)");
  EXPECT_NE(complaint(packed_csv("a,b\r\n1,2\r\n")).find("line 1: got a carriage return"),
            std::string::npos);
}

TEST_F(Csv, OneTableHasOneFile) {
  const std::filesystem::path plain = folder_.path() / "t.csv",
                              packed = folder_.path() / "t.csv.gz";
  EXPECT_EQ(table_file(plain), packed);
  file("a,b\n");
  EXPECT_EQ(table_file(plain), plain);
  std::ofstream(packed) << "a,b\n";
  EXPECT_THROW(table_file(plain), std::invalid_argument);
  std::filesystem::remove(plain);
  EXPECT_EQ(table_file(plain), packed);
}

/// The journal of a packed table is named after the table.
TEST_F(Csv, RowsThatAreNotInItYet) {
  const std::filesystem::path packed = folder_.path() / "t.csv.gz";
  std::ofstream(packed) << packed_csv("a,b\n1,2\n");
  EXPECT_EQ(read_csv(packed, {"a"}).rows.size(), 1U);
  std::ofstream(folder_.path() / "t.csv.part") << "a,b\n";
  EXPECT_THROW(read_csv(packed, {"a"}), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
