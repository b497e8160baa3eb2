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
  /// Lets go of the file, and removes it if nothing is in it.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Removes all lines but this first one.
  void begin(const std::string& line);
  /// The line comes without its break. What cannot be written whole is taken back.
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
