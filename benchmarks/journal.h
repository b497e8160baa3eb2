#pragma once

#include <filesystem>
#include <string>

namespace maxwrench {

/// A file that grows by whole lines and belongs to one process at a time. A line that was added
/// outlives a killed process; at most the last one is torn, without its line break.
class Journal {
 public:
  /// Takes hold of a file and leaves what is in it. Throws std::invalid_argument on one that cannot
  /// be written, or that another process holds.
  explicit Journal(std::filesystem::path file);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Removes all lines but this first one.
  void begin(const std::string& line);
  /// The line comes without its break.
  void add(const std::string& line);
  /// Removes the file.
  void remove();

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace maxwrench
