#include "benchmarks/tables/write_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

namespace maxwrench {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLinks = 40;  // like the kernel
constexpr mode_t kNewFile = 0666;

/// The standard stream that already writes to this file, or -1. Opening the file a second time
/// would overwrite what the stream has printed.
int stream_to(const struct stat& file) {
  for (std::FILE* stream : {stdout, stderr}) {
    struct stat own {};
    const int descriptor = fileno(stream);
    if (fstat(descriptor, &own) != 0 || own.st_dev != file.st_dev || own.st_ino != file.st_ino)
      continue;
    if ((fcntl(descriptor, F_GETFL) & O_ACCMODE) == O_RDONLY) continue;
    std::fflush(stream);
    return descriptor;
  }
  return -1;
}

void write_stream(const fs::path& file, const struct stat& found, const std::string& text) {
  const int own = stream_to(found);
  const int descriptor = own >= 0 ? own : open(file.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
  if (descriptor < 0) throw_output_error(file, errno);
  int error = write_all(descriptor, text);
  if (own < 0 && close(descriptor) != 0 && error == 0) error = errno;
  if (error != 0) throw_output_error(file, error);
}

/// The end of a chain of symbolic links, which need not exist.
fs::path follow_links(const fs::path& file) {
  fs::path target = file;
  std::error_code error;
  for (int links = 0; fs::is_symlink(fs::symlink_status(target, error)); ++links) {
    if (links == kMostLinks) throw_output_error(file, ELOOP);
    target = target.parent_path() / fs::read_symlink(target, error);
    if (error) throw_output_error(file, error.value());
  }
  return target;
}

/// Creates a new file in the folder of `target`, with a short name that is valid wherever that of
/// `target` is.
int open_beside(const fs::path& target, fs::path& temporary) {
  static std::atomic<int> count = 0;
  int descriptor = -1;
  do {
    temporary = target.parent_path() / fmt::format(".maxwrench-{}-{}.part", getpid(), count++);
    descriptor = open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kNewFile);
  } while (descriptor < 0 && errno == EEXIST);
  return descriptor;
}

/// `found` describes the previous `target`, if it exists.
void replace(const fs::path& file, const fs::path& target, const struct stat* found,
             const std::string& text) {
  if (found != nullptr && access(target.c_str(), W_OK) != 0) throw_output_error(file, errno);
  fs::path temporary;
  const int descriptor = open_beside(target, temporary);
  if (descriptor < 0) throw_output_error(file, errno);
  int error = 0;
  if (found != nullptr && fchmod(descriptor, found->st_mode & 07777) != 0) error = errno;
  if (error == 0) error = write_all(descriptor, text);
  if (close(descriptor) != 0 && error == 0) error = errno;
  if (error == 0 && std::rename(temporary.c_str(), target.c_str()) != 0) error = errno;
  if (error == 0) return;
  unlink(temporary.c_str());
  throw_output_error(file, error);
}

}  // namespace

void throw_output_error(const fs::path& file, int error) {
  throw std::invalid_argument(fmt::format("{}: got '{}', expected a writable file", file.string(),
                                          std::generic_category().message(error)));
}

int write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

void write_file(const fs::path& file, const std::string& text) {
  struct stat found {};
  const bool exists = stat(file.c_str(), &found) == 0;
  if (!exists && errno != ENOENT) throw_output_error(file, errno);
  if (exists && S_ISDIR(found.st_mode)) throw_output_error(file, EISDIR);
  if (exists && (!S_ISREG(found.st_mode) || stream_to(found) >= 0)) {
    return write_stream(file, found, text);
  }
  const fs::path target = follow_links(file);
  std::error_code error;
  if (target.has_parent_path()) fs::create_directories(target.parent_path(), error);
  if (error) throw_output_error(file, error.value());
  replace(file, target, exists ? &found : nullptr, text);
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace maxwrench
