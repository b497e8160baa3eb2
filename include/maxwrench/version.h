#pragma once

#include <string>

namespace maxwrench {

/// "0.1.0" of a release; between two releases with the commit, "0.1.0+3f2a91c04b", and with
/// ".dirty" behind it if sources were changed after the commit.
const char* version();

/// What the commit held, whatever became of it: ten digits of the SHA1 of the list of its files,
/// results left out.
const char* sources_id();

/// The version, its sources, how the library was built and the libraries that it uses, one line
/// each.
std::string describe_build();

}  // namespace maxwrench
