#include "problems/loader/number_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>

#include "problems/loader/bad_input.h"

namespace maxwrench {
namespace {

using Columns = std::vector<std::string>;

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";  // spreadsheets write it first

std::string trimmed(const std::string& text) {
  constexpr const char* kSpace = " \t\r";
  const std::size_t begin = text.find_first_not_of(kSpace);
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(kSpace) + 1 - begin);
}

Columns cells_of(const std::string& line) {
  Columns cells;
  std::size_t begin = 0;
  for (std::size_t comma = 0; comma != std::string::npos; begin = comma + 1) {
    comma = line.find(',', begin);
    cells.push_back(
        trimmed(line.substr(begin, comma == std::string::npos ? comma : comma - begin)));
  }
  return cells;
}

/// A number; nan and inf are allowed.
std::optional<double> as_number(const std::string& cell) {
  const char* begin = cell.data() + (cell.starts_with('+') ? 1 : 0);
  const char* end = cell.data() + cell.size();
  double value = 0;
  const auto [rest, error] = std::from_chars(begin, end, value);
  if (begin == end || rest != end || error != std::errc()) return std::nullopt;
  return value;
}

std::string shown_columns(const std::vector<Columns>& choices) {
  std::vector<std::string> texts;
  for (const Columns& columns : choices) {
    texts.push_back(fmt::format("{} ({})", columns.size(), fmt::join(columns, ",")));
  }
  return fmt::format("{}", fmt::join(texts, " or "));
}

bool is_header(const Columns& cells) {
  return !std::all_of(cells.begin(), cells.end(),
                      [](const std::string& cell) { return as_number(cell).has_value(); });
}

/// The numbers of a row; empty if a cell is not a finite number.
std::optional<std::vector<double>> as_row(const Columns& cells) {
  std::vector<double> row;
  for (const std::string& cell : cells) {
    const std::optional<double> value = as_number(cell);
    if (!value || !std::isfinite(*value)) return std::nullopt;
    row.push_back(*value);
  }
  return row;
}

/// Reads the rows. `columns_for` chooses the columns by the first line that is not blank.
template <class ColumnsFor>
NumberTable read_rows(const std::filesystem::path& file, const ColumnsFor& columns_for) {
  std::ifstream stream = open_file(file, "a CSV file");
  NumberTable table{{}, {}, {}, file};
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (number == 1 && line.starts_with(kByteOrderMark)) line.erase(0, kByteOrderMark.size());
    if (trimmed(line).empty()) continue;
    const Columns cells = cells_of(line);
    const std::string where = fmt::format("line {}", number), got = fmt::format("'{}'", line);
    if (table.columns.empty()) {
      table.columns = columns_for(cells, where, got);
      if (is_header(cells)) continue;
    }
    const auto row = as_row(cells);
    if (!row || row->size() != table.columns.size()) {
      throw_bad_input(file, where, got,
                      fmt::format("{} finite numbers", shown_columns({table.columns})));
    }
    table.rows.push_back(*row);
    table.lines.push_back(number);
  }
  return table;
}

}  // namespace

void NumberTable::throw_bad_row(std::size_t row, const std::string& expected) const {
  throw_bad_input(file, fmt::format("line {}", lines[row]),
                  fmt::format("'{}'", fmt::join(rows[row], ",")), expected);
}

NumberTable read_numbers(const std::filesystem::path& file, const std::vector<Columns>& choices) {
  return read_rows(file, [&](const Columns& cells, const std::string& where,
                             const std::string& got) {
    const auto chosen = std::find_if(choices.begin(), choices.end(), [&](const Columns& columns) {
      return is_header(cells) ? columns == cells : columns.size() == cells.size();
    });
    if (chosen == choices.end()) {
      throw_bad_input(
          file, where, got,
          fmt::format("{} columns, with or without this header", shown_columns(choices)));
    }
    return *chosen;
  });
}

NumberTable read_named_numbers(const std::filesystem::path& file) {
  return read_rows(
      file, [&](const Columns& cells, const std::string& where, const std::string& got) {
        const bool named = std::none_of(cells.begin(), cells.end(), [](const std::string& cell) {
          return cell.empty() || as_number(cell).has_value();
        });
        if (!named)
          throw_bad_input(file, where, got, "a header line with the names of the columns");
        return cells;
      });
}

}  // namespace maxwrench
