#pragma once

#include <tinyxml2.h>

#include <filesystem>
#include <string>

namespace maxwrench {

/// Whether an element holds what xacro has to expand. Leftovers that expand nothing do not count.
bool is_xacro(const tinyxml2::XMLElement& robot);

/// The URDF that the program `xacro` prints for the file. Rejects the file if that program is not
/// installed, fails, or prints nothing within a minute.
std::string expand_xacro(const std::filesystem::path& file);

}  // namespace maxwrench
