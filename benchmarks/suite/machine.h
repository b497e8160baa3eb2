#pragma once

#include <string>

namespace maxwrench {

/// The processor's model, for a column of a table.
std::string processor_name();

/// How the library was built, and the libraries that it uses, in one line.
std::string build_line();

/// The build (`describe_build`), processor, cores and system, which accompany every measured time.
std::string describe_machine();

}  // namespace maxwrench
