#pragma once

#include <string>
#include <variant>
#include <vector>

namespace maxwrench {

/// A text, or a number, which is none if it is not finite.
using ReportCell = std::variant<std::string, double>;

/// A table that is printed, written as CSV and shown on a page. Columns are those of `dictionary`.
struct ReportTable {
  std::string name;  ///< of its file, without the ending
  std::string title, note;
  std::vector<std::string> columns;
  std::vector<std::vector<ReportCell>> rows;
};

/// Each line with its break, numbers with a few digits, at most `most` rows.
std::string text_of_table(const ReportTable& table, std::size_t most);
/// Numbers with all their digits; nothing for none.
std::string csv_of_table(const ReportTable& table);
/// A box with a filter, within which the table scrolls, with at most `most` rows.
std::string html_of_table(const ReportTable& table, std::size_t most);

std::string escaped_html(const std::string& text);

}  // namespace maxwrench
