#pragma once

#include <string>
#include <vector>

#include "cli/report/sections.h"

namespace maxwrench {

struct PageHead {
  std::string title;
  /// Names and values: folder, date, machine, and so on.
  std::vector<std::pair<std::string, std::string>> facts;
  /// Longer texts that a click opens: title, text.
  std::vector<std::pair<std::string, std::string>> texts;
};

/// One HTML file that needs no other file and no network. Clicking a column sorts a table, the
/// words in its box filter it, and figures are embedded.
std::string html_page(const PageHead& head, const std::vector<ReportSection>& sections);

}  // namespace maxwrench
