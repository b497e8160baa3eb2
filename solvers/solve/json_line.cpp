#include <nlohmann/json.hpp>

#include "solvers/solve/format.h"

namespace maxwrench {
namespace {

using nlohmann::ordered_json;

/// How many bytes follow this first byte of a UTF-8 character; negative if it is not a first byte.
int following(unsigned char first) {
  if (first < 0x80) return 0;
  if (first < 0xC2 || first > 0xF4) return -1;
  return first < 0xE0 ? 1 : first < 0xF0 ? 2 : 3;
}

bool is_utf8(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto first = static_cast<unsigned char>(text[i]);
    const int more = following(first);
    if (more < 0 || i + static_cast<std::size_t>(more) >= text.size()) return false;
    for (int k = 1; k <= more; ++k) {
      const auto next = static_cast<unsigned char>(text[i + static_cast<std::size_t>(k)]);
      // The second byte excludes overlong forms, surrogates and code points beyond 10FFFF.
      const int low = k > 1 ? 0x80 : first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
      const int high = k > 1 ? 0xBF : first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
      if (next < low || next > high) return false;
    }
    i += static_cast<std::size_t>(more);
  }
  return true;
}

std::string from_latin1(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80) result += static_cast<char>(0xC0 | (byte >> 6));
    result += static_cast<char>(byte < 0x80 ? byte : 0x80 | (byte & 0x3F));
  }
  return result;
}

ordered_json in_utf8(const ordered_json& value) {
  if (value.is_string()) {
    const std::string& text = value.get_ref<const std::string&>();
    return is_utf8(text) ? text : from_latin1(text);
  }
  if (!value.is_structured()) return value;
  ordered_json result = value.is_array() ? ordered_json::array() : ordered_json::object();
  bool keys_in_utf8 = true;  // all or none, so that two different names do not become equal
  for (const auto& [key, inner] : value.items()) keys_in_utf8 = keys_in_utf8 && is_utf8(key);
  for (const auto& [key, inner] : value.items()) {
    if (value.is_array()) {
      result.push_back(in_utf8(inner));
    } else {
      result[keys_in_utf8 ? key : from_latin1(key)] = in_utf8(inner);
    }
  }
  return result;
}

}  // namespace

std::string in_one_line(const ordered_json& object) {
  try {
    return object.dump();
  } catch (const ordered_json::type_error&) {
    return in_utf8(object).dump();
  }
}

}  // namespace maxwrench
