#pragma once

#include <string>
#include <variant>
#include <vector>

namespace maxwrench {

/// A text or a number; a number that is not finite counts as missing.
using ReportCell = std::variant<std::string, double>;

/// A table that is printed, written as CSV and shown on a page. Its columns are those of
/// `dictionary`.
struct ReportTable {
  std::string name;  ///< of its file, without the suffix
  std::string title, note;
  std::vector<std::string> columns;
  std::vector<std::vector<ReportCell>> rows;
};

/// Lines with line breaks, numbers with a few digits, at most `most` rows.
std::string text_of_table(const ReportTable& table, std::size_t most);
/// Numbers with all digits; empty cells for missing numbers.
std::string csv_of_table(const ReportTable& table);
/// A box with a filter, in which the table scrolls, with at most `most` rows.
std::string html_of_table(const ReportTable& table, std::size_t most);

}  // namespace maxwrench
