#include "cli/report/report_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "benchmarks/tables/csv.h"
#include "benchmarks/tables/dictionary.h"
#include "drawing/svg.h"

namespace maxwrench {
namespace {

/// Above 2^53, not all whole numbers are doubles.
bool is_whole(double value) { return value == std::round(value) && std::abs(value) < 9e15; }

/// Whether a column holds values of tasks.
bool is_value(const std::string& column) {
  return column == "best" || column == "planned" || column == "reading" ||
         column.starts_with("beta");
}

/// A cell for readers: values of tasks with eight digits, other numbers with four; `none` for a
/// missing number.
std::string cell_text(const std::string& column, const ReportCell& cell, const char* none) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  const double value = std::get<double>(cell);
  if (!std::isfinite(value)) return none;
  if (is_whole(value)) return fmt::format("{:.0f}", value);
  return fmt::format("{:.{}g}", value, is_value(column) ? 8 : 4);
}

bool is_numeric(const ReportTable& table, std::size_t column) {
  return !table.rows.empty() && std::holds_alternative<double>(table.rows.front()[column]);
}

/// All cells as they are printed; the names of the columns come first.
std::vector<std::vector<std::string>> printed(const ReportTable& table, std::size_t most) {
  std::vector<std::vector<std::string>> lines = {table.columns};
  for (std::size_t i = 0; i < std::min(most, table.rows.size()); ++i) {
    std::vector<std::string>& line = lines.emplace_back();
    for (std::size_t j = 0; j < table.columns.size(); ++j) {
      line.push_back(cell_text(table.columns[j], table.rows[i][j], "-"));
    }
  }
  return lines;
}

std::string tooltip(const std::string& column) {
  const ColumnMeaning* entry = find_meaning(column);
  if (entry == nullptr) return "";
  const std::string unit(entry->unit);
  return escaped(unit.empty() ? entry->meaning : fmt::format("[{}] {}", unit, entry->meaning));
}

}  // namespace

std::string text_of_table(const ReportTable& table, std::size_t most) {
  std::string text = table.title + "\n";
  if (table.rows.empty()) return text + "none\n";
  const auto lines = printed(table, most);
  std::vector<std::size_t> widths(table.columns.size(), 0);
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  }
  for (const auto& line : lines) {
    std::string row;
    for (std::size_t i = 0; i < line.size(); ++i) {
      row += is_numeric(table, i) ? fmt::format("{:>{}}  ", line[i], widths[i])
                                  : fmt::format("{:<{}}  ", line[i], widths[i]);
    }
    row.erase(row.find_last_not_of(' ') + 1);
    text += row + "\n";
  }
  const std::size_t more = table.rows.size() - std::min(most, table.rows.size());
  return more == 0 ? text : text + fmt::format("and {} more\n", more);
}

std::string csv_of_table(const ReportTable& table) {
  std::string text = join_csv(table.columns) + "\n";
  for (const auto& row : table.rows) {
    std::vector<std::string> fields;
    for (const ReportCell& cell : row) {
      const auto* number = std::get_if<double>(&cell);
      if (number == nullptr) {
        fields.push_back(std::get<std::string>(cell));
      } else {
        fields.push_back(std::isfinite(*number) ? fmt::format("{}", *number) : "");
      }
    }
    text += join_csv(fields) + "\n";
  }
  return text;
}

std::string html_of_table(const ReportTable& table, std::size_t most) {
  const std::size_t count = std::min(most, table.rows.size());
  std::string text = fmt::format(
      "<div class=\"tools\"><input type=\"search\" placeholder=\"filter\" aria-label=\"filter "
      "{0}\">"
      "<output></output> <a href=\"{1}.csv\">{1}.csv</a></div>\n"
      "<div class=\"scroll\" tabindex=\"0\"><table id=\"t-{1}\">\n<thead><tr>",
      escaped(table.title), table.name);
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    text += fmt::format("<th{}><button title=\"{}\">{}</button></th>",
                        is_numeric(table, i) ? " class=\"n\"" : "", tooltip(table.columns[i]),
                        escaped(table.columns[i]));
  }
  text += "</tr></thead>\n<tbody>\n";
  for (std::size_t i = 0; i < count; ++i) {
    text += "<tr>";
    for (std::size_t j = 0; j < table.columns.size(); ++j) {
      text += is_numeric(table, j) ? "<td class=\"n\">" : "<td>";
      text += escaped(cell_text(table.columns[j], table.rows[i][j], "")) + "</td>";
    }
    text += "</tr>\n";
  }
  text += "</tbody></table></div>\n";
  if (count == table.rows.size()) return text;
  return text +
         fmt::format("<p class=\"note\">The first {} of {} rows; the rest is in {}.csv.</p>\n",
                     count, table.rows.size(), table.name);
}

}  // namespace maxwrench
