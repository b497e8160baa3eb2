#include "cli/output.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>

#include "cli/cli.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// How many bytes follow this first one of a character in UTF-8; negative: it is none.
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
      // The second byte excludes longer forms than needed, surrogates and what is beyond 10FFFF.
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
  bool keys_in_utf8 = true;  // all or none, lest two names become one
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

/// Whether writing both would write one file; devices and pipes take both.
bool collide(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  if (fs::exists(a, ignored) && !fs::is_regular_file(a, ignored)) return false;
  if (fs::equivalent(a, b, ignored)) return true;
  const fs::path first = fs::weakly_canonical(fs::absolute(a, ignored), ignored);
  const fs::path second = fs::weakly_canonical(fs::absolute(b, ignored), ignored);
  return !first.empty() && first == second;
}

bool is_robot_or_task(const fs::path& file) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return false;
  const fs::path extension = fs::weakly_canonical(file, ignored).extension();
  return extension == ".toml" || extension == ".urdf";
}

}  // namespace

void prepare_streams() {
  std::signal(SIGXFSZ, SIG_IGN);
  for (int descriptor = 0; descriptor <= 2; ++descriptor) {
    if (fcntl(descriptor, F_GETFD) >= 0) continue;
    // The lowest free number is taken: this one.
    if (open("/dev/null", descriptor == 0 ? O_WRONLY : O_RDONLY) != descriptor) return;
  }
}

void remark(const std::string& text) {
  std::string line = text;
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < ' ' || c == 0x7F; }, ' ');
  line += '\n';
  std::fputs(line.c_str(), stderr);
}

void complain(const std::string& text) { remark("maxwrench: " + text); }

int flush_output(int exit_status) {
  errno = 0;
  std::cout.flush();
  const bool arrived = std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout;
  if (arrived) return exit_status;
  complain(fmt::format("stdout: got '{}', expected a stream that takes the answer",
                       errno != 0 ? std::generic_category().message(errno) : "an error"));
  return kBadInput;
}

void print_json(const ordered_json& object) {
  std::string text;
  try {
    text = object.dump();
  } catch (const ordered_json::type_error&) {
    text = in_utf8(object).dump();
  }
  fmt::print("{}\n", text);
}

void require_apart(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs) {
  std::vector<NamedFile> others = inputs;
  for (const NamedFile& output : outputs) {
    if (output.path.empty()) continue;
    for (const NamedFile& other : others) {
      if (other.path.empty() || !collide(output.path, other.path)) continue;
      throw std::invalid_argument(
          fmt::format("{}: got '{}', which is the file of {}, expected "
                      "another one",
                      output.option, output.path, other.option));
    }
    if (is_robot_or_task(output.path)) {
      throw std::invalid_argument(
          fmt::format("{}: got '{}', an existing .toml or .urdf file, expected one that holds no "
                      "robot or task",
                      output.option, output.path));
    }
    others.push_back(output);
  }
}

}  // namespace maxwrench
