#pragma once

#include <filesystem>
#include <string>

namespace maxwrench {

/// Whether a file is in xacro's language: by its name, or by an element or attribute of xacro.
bool is_xacro(const std::filesystem::path& file, const std::string& text);

/// The URDF that the program `xacro` prints for the file. Rejects the file if that program is not
/// installed, fails, or prints nothing within a minute.
std::string expand_xacro(const std::filesystem::path& file);

}  // namespace maxwrench
