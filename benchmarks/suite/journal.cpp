#include "benchmarks/suite/journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

#include "benchmarks/tables/write_file.h"

namespace maxwrench {
namespace {

bool was_removed(int descriptor) {
  struct stat status {};
  return fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && status.st_nlink == 0;
}

}  // namespace

Journal::Journal(std::filesystem::path file) : file_(std::move(file)) {
  std::error_code error;
  if (file_.has_parent_path()) std::filesystem::create_directories(file_.parent_path(), error);
  if (error) throw_output_error(file_, error.value());
  do {
    if (descriptor_ >= 0) close(descriptor_);
    descriptor_ = open(file_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (descriptor_ < 0) throw_output_error(file_, errno);
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      close(descriptor_);
      throw std::invalid_argument(file_.string() +
                                  ": got a file that is being written, expected one run at a time");
    }
  } while (was_removed(descriptor_));  // by the process that held it until now
}

void Journal::begin(const std::string& line) {
  if (ftruncate(descriptor_, 0) != 0) throw_output_error(file_, errno);
  add(line);
}

Journal::~Journal() {
  struct stat status {};
  if (fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode) && status.st_size == 0) remove();
  close(descriptor_);
}

void Journal::add(const std::string& line) {
  const off_t before = lseek(descriptor_, 0, SEEK_END);
  const int error = write_all(descriptor_, line + '\n');
  if (error == 0) return;
  const bool taken_back = before >= 0 && ftruncate(descriptor_, before) == 0;
  if (!taken_back) static_cast<void>(write_all(descriptor_, "\n"));  // keeps the torn line separate
  throw_output_error(file_, error);
}

bool Journal::is_held(const std::filesystem::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool held = flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  close(descriptor);
  return held;
}

void Journal::remove() {
  std::error_code gone;
  std::filesystem::remove(file_, gone);
}

}  // namespace maxwrench
