#include "problems/mps/fields.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>
#include <system_error>

namespace maxwrench {

std::optional<double> mps_number(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == 'd' || c == 'D'; }, 'e');
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* end = text.data() + text.size();
  double value = 0;
  const auto [rest, error] = std::from_chars(begin, end, value);
  if (begin == end || rest != end || error != std::errc() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

MpsFields mps_words(const std::string& line) {
  std::istringstream stream(line);
  MpsFields fields;
  for (std::string field; stream >> field;) fields.push_back(field);
  return fields;
}

std::string mps_name(const MpsFields& words, std::size_t first) {
  std::string name;
  for (std::size_t k = first; k < words.size(); ++k) {
    if (k > first) name += '_';
    name += words[k];
  }
  return name;
}

MpsFields mps_columns(const std::string& line) {
  constexpr std::array<std::array<std::size_t, 2>, 6> kColumns{
      {{1, 2}, {4, 8}, {14, 8}, {24, 12}, {39, 8}, {49, 12}}};
  MpsFields fields;
  for (const auto& [begin, length] : kColumns) {
    fields.push_back(begin < line.size() ? mps_name(mps_words(line.substr(begin, length))) : "");
  }
  while (!fields.empty() && fields.back().empty()) fields.pop_back();
  return fields;
}

}  // namespace maxwrench
