#pragma once

#include <string>

/// @file
/// The version of the library.

namespace maxwrench {

/// Returns the version.
///
/// It is "0.1.0" for a release. Between two releases the commit follows, as in "0.1.0+3f2a91c04b".
/// If sources were changed after the commit, ".dirty" follows.
const char* version();

/// Returns the identifier of the contents of the commit, which does not depend on its history.
///
/// It consists of the first ten digits of the SHA1 of the list of files, without results.
const char* sources_id();

/// Returns the version, its sources, how the library was built and the libraries that it uses, one
/// line each.
std::string describe_build();

}  // namespace maxwrench
