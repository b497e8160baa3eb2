#include "tests/fuzz/damage.h"

#include <iterator>

namespace maxwrench {
namespace {

const char* const kNumbers[] = {"0",      "-1",          "nan",  "inf",        "-inf",  "1e400",
                                "1e-320", "1e30",        "1e-9", "-0.0",       "0x1p3", "1e",
                                "7",      "99999999999", "3.14", "2147483648", "1_000"};

/// The number around or after a place gives way to another one.
void exchange_number(std::string& text, std::size_t at, Random& random) {
  static const char* const kDigits = "0123456789.eE+-";
  const std::size_t digit = text.find_first_of("0123456789", at);
  if (digit == std::string::npos) return;
  const std::size_t before = text.find_last_not_of(kDigits, digit);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  const std::size_t end = std::min(text.find_first_not_of(kDigits, digit), text.size());
  text.replace(begin, end - begin,
               kNumbers[whole(random, 0, static_cast<int>(std::size(kNumbers)) - 1)]);
}

}  // namespace

std::string damaged(std::string text, std::span<const char* const> words, Random& random) {
  for (int i = whole(random, 1, 6); i > 0; --i) {
    const auto at = static_cast<std::size_t>(whole(random, 0, static_cast<int>(text.size())));
    const int kind = whole(random, 0, 4);
    const auto length = [&](int most) { return static_cast<std::size_t>(whole(random, 1, most)); };
    if (kind == 0 && at < text.size()) text[at] = static_cast<char>(whole(random, 1, 255));
    if (kind == 1) text.erase(at, length(30));
    if (kind == 2) text.insert(at, words[length(static_cast<int>(words.size())) - 1]);
    if (kind == 3) text.insert(at, text.substr(at, length(60)));
    if (kind == 4) exchange_number(text, at, random);
    if (text.empty()) text = "\n";
  }
  return text;
}

}  // namespace maxwrench
