#pragma once

#include <filesystem>
#include <string>

namespace maxwrench {

/// A file that grows by whole lines and belongs to one process at a time. An added line remains if
/// the process is killed; at most the last line is torn, without its line break.
class Journal {
 public:
  /// Locks a file and keeps its contents. Throws std::invalid_argument if it cannot be written or
  /// another process holds it.
  explicit Journal(std::filesystem::path file);
  /// Unlocks the file, and removes it if it is empty.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Removes all lines and writes this first one.
  void begin(const std::string& line);
  /// Adds a line, given without its break. A line that cannot be written completely is removed
  /// again.
  void add(const std::string& line);
  /// Removes the file.
  void remove();

  /// Whether another process holds such a file.
  static bool is_held(const std::filesystem::path& file);

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace maxwrench
