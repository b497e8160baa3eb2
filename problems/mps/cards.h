#pragma once

#include <set>
#include <string>
#include <vector>

namespace maxwrench::mps {

using Fields = std::vector<std::string>;

/// Brings a file into the one form that CoinMpsIO reads without slips. As the file stands, that
/// reader ignores OBJSENSE, needs an RHS section, loses the first card after a second RHS set,
/// writes outside its arrays for a range on a second N row, merges names that are indented by four
/// blanks but not aligned, and aborts the process on SOS markers.
class Cards {
 public:
  explicit Cards(const std::string& path) : path_(path) { read(); }
  /// The same program in free format, one pair on each card.
  std::string text() const;

  std::string name;
  bool minimize = true;

 private:
  [[noreturn]] void fail(const std::string& expected) const;
  void read();
  void begin_section(const Fields& fields);
  void read_card(const std::string& line);
  void read_sense(const std::string& word);
  void read_row(const Fields& fields);
  Fields pairs(const std::string& line, bool may_lack_name) const;
  void read_column(const std::string& line);
  void read_set(const std::string& line);
  void read_bound(const std::string& line);
  bool try_bound(Fields fields);

  std::string path_, section_, objective_, column_;
  int number_ = 0;
  bool ended_ = false;
  std::set<std::string> seen_, rows_, columns_, free_rows_;
  std::string set_name_;
  bool set_started_ = false;
  std::string rows_text_, columns_text_, rhs_text_, ranges_text_, bounds_text_;
};

}  // namespace maxwrench::mps
