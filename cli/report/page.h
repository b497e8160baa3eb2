#pragma once

#include <string>
#include <vector>

#include "cli/report/sections.h"

namespace maxwrench {

struct PageHead {
  std::string title;
  /// Names and what they are: folder, date, machine, and so on.
  std::vector<std::pair<std::string, std::string>> facts;
  /// Longer texts that open by a click: title, text.
  std::vector<std::pair<std::string, std::string>> texts;
};

/// One HTML file that needs nothing else: tables sort by a click on a column and filter by the
/// words in their box, figures stand within. No network.
std::string html_page(const PageHead& head, const std::vector<ReportSection>& sections);

}  // namespace maxwrench
