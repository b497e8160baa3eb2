#include "benchmarks/journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "benchmarks/write_file.h"

namespace maxwrench {
Journal::Journal(std::filesystem::path file) : file_(std::move(file)) {
  std::error_code error;
  if (file_.has_parent_path()) std::filesystem::create_directories(file_.parent_path(), error);
  if (error) refuse_output(file_, error.value());
  descriptor_ = open(file_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) refuse_output(file_, errno);
  if (flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  close(descriptor_);
  refuse_output(file_, EBUSY);
}

void Journal::begin(const std::string& line) {
  if (ftruncate(descriptor_, 0) != 0) refuse_output(file_, errno);
  add(line);
}

Journal::~Journal() { close(descriptor_); }

void Journal::add(const std::string& line) {
  const int error = write_all(descriptor_, line + '\n');
  if (error != 0) refuse_output(file_, error);
}

void Journal::remove() {
  std::error_code gone;
  std::filesystem::remove(file_, gone);
}

}  // namespace maxwrench
