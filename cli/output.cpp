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
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "cli/cli.h"
#include "solvers/solve/format.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;

/// Whether writing both would write the same file. Devices and pipes do not collide.
bool collide(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  if (fs::exists(a, ignored) && !fs::is_regular_file(a, ignored)) return false;
  if (fs::equivalent(a, b, ignored)) return true;
  const fs::path first = fs::weakly_canonical(fs::absolute(a, ignored), ignored);
  const fs::path second = fs::weakly_canonical(fs::absolute(b, ignored), ignored);
  return !first.empty() && first == second;
}

std::vector<std::string>& kept_complaints() {
  static std::vector<std::string> texts;
  return texts;
}

bool is_robot_or_task(const fs::path& file) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return false;
  const fs::path extension = fs::weakly_canonical(file, ignored).extension();
  static const std::set<std::string> kExtensions = {".toml", ".urdf", ".srdf", ".xacro"};
  return kExtensions.contains(extension.string());
}

}  // namespace

void prepare_streams() {
  std::signal(SIGXFSZ, SIG_IGN);
  for (int descriptor = 0; descriptor <= 2; ++descriptor) {
    if (fcntl(descriptor, F_GETFD) >= 0) continue;
    // The system assigns the lowest free number, which is this one.
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

void complain_at_end(const std::string& text) { kept_complaints().push_back(text); }

void print_kept_complaints() {
  std::fflush(stdout);  // they come after the result
  for (const std::string& text : std::exchange(kept_complaints(), {})) complain(text);
}

int flush_output(int exit_status) {
  errno = 0;
  std::cout.flush();
  const bool arrived = std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout;
  if (arrived) return exit_status;
  complain(fmt::format("stdout: got '{}', expected a writable stream",
                       errno != 0 ? std::generic_category().message(errno) : "an error"));
  return kBadInput;
}

void print_json(const nlohmann::ordered_json& object) { fmt::print("{}\n", in_one_line(object)); }

void require_apart(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs) {
  std::vector<NamedFile> others = inputs;
  for (const NamedFile& output : outputs) {
    if (output.path.empty()) continue;
    for (const NamedFile& other : others) {
      if (other.path.empty() || !collide(output.path, other.path)) continue;
      throw std::invalid_argument(
          fmt::format("{}: got '{}', which is also the file of {}, expected a different file",
                      output.option, output.path, other.option));
    }
    if (is_robot_or_task(output.path)) {
      throw std::invalid_argument(
          fmt::format("{}: got '{}', an existing {} file, expected a file that is not "
                      "a robot or task",
                      output.option, output.path, fs::path(output.path).extension().string()));
    }
    others.push_back(output);
  }
}

}  // namespace maxwrench
