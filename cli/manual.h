#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace maxwrench {

/// The manual page of a command line, in roff, from its subcommands and options.
std::string man_page(const CLI::App& app);

/// A completion script for bash: subcommands, options, the names of strategies and of shipped
/// problems.
std::string bash_completion(const CLI::App& app);

}  // namespace maxwrench
