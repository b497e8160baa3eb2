#include "problems/loader/xacro.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <string>
#include <string_view>
#include <utility>

#include "problems/loader/bad_input.h"

extern char** environ;

namespace maxwrench {
namespace {

constexpr std::size_t kMostText = 100'000'000;

/// What a program writes.
struct Pipe {
  std::array<int, 2> ends = {-1, -1};
  Pipe() {
    if (pipe2(ends.data(), O_CLOEXEC) != 0) ends = {-1, -1};
  }
  ~Pipe() {
    for (const int end : ends) {
      if (end >= 0) close(end);
    }
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
};

/// Reads to the end; false if the text is too long or the time is over.
bool read_all(int from, std::string& text) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::minutes(1);
  std::array<char, 65536> buffer{};
  while (text.size() < kMostText) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
    pollfd ready = {from, POLLIN, 0};
    if (left.count() <= 0 || poll(&ready, 1, static_cast<int>(left.count())) == 0) return false;
    const ssize_t count = ::read(from, buffer.data(), buffer.size());
    if (count == 0) return true;
    if (count > 0) {
      text.append(buffer.data(), static_cast<std::size_t>(count));
    } else if (errno != EINTR) {
      return false;
    }
  }
  return false;
}

}  // namespace

bool is_xacro(const tinyxml2::XMLElement& robot) {
  const auto has_mark = [](const tinyxml2::XMLElement& element) {
    for (const auto* each = element.FirstAttribute(); each != nullptr; each = each->Next()) {
      const std::string_view value = each->Value();
      if (value.find("${") != value.npos || value.find("$(") != value.npos) return true;
    }
    return false;
  };
  for (const auto* each = robot.FirstChildElement(); each != nullptr;
       each = each->NextSiblingElement()) {
    const std::string_view name = each->Name();
    if (name == "xacro:include" || name == "xacro:macro") return true;
    if (name == "gazebo" || name == "transmission" || name.starts_with("xacro:")) continue;
    if (has_mark(*each) || is_xacro(*each)) return true;
  }
  return false;
}

std::string expand_xacro(const std::filesystem::path& file) {
  const auto reject = [&file](const std::string& got) {
    throw_bad_input(file, "xacro", got,
                    fmt::format("a URDF: 'xacro {} > robot.urdf' writes one, where ROS's program "
                                "xacro and the packages it needs are installed",
                                file.filename().string()));
  };
  Pipe output;
  const std::string path = file.string();
  std::array<char*, 3> arguments = {const_cast<char*>("xacro"), const_cast<char*>(path.c_str()),
                                    nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, output.ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t program = 0;
  const int failed =
      posix_spawnp(&program, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) reject("a file in xacro's language, and xacro is not installed");
  close(std::exchange(output.ends[1], -1));
  std::string text;
  const bool whole = read_all(output.ends[0], text);
  if (!whole) kill(program, SIGKILL);
  int status = 0;
  while (waitpid(program, &status, 0) < 0 && errno == EINTR) {
  }
  if (!whole || !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    reject(whole ? "a file that xacro does not expand" : "no end of xacro's output in a minute");
  }
  return text;
}

}  // namespace maxwrench
