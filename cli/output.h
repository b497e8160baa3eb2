#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace maxwrench {

/// Closed standard streams get a place holder that rejects every write, so that no file that is
/// opened later takes their number and receives what was meant for them. A file that grows beyond
/// the limit of the process (ulimit -f) becomes an error instead of a deadly signal.
void prepare_streams();

/// Prints "maxwrench: <text>" to stderr as one line, whatever the text holds. Never throws.
void complain(const std::string& text);

/// Prints a remark to stderr as one line. Never throws.
void remark(const std::string& text);

/// What a command printed must have arrived: the exit status, or that of bad input with a complaint
/// if stdout rejected it.
int flush_output(int exit_status);

/// One object on one line, see `in_one_line`.
void print_json(const nlohmann::ordered_json& object);

/// A file that an option or argument of the command names; empty: none.
struct NamedFile {
  const char* option;
  std::string path;
};

/// Throws std::invalid_argument, before anything is computed, if an output would replace an input,
/// another output or any robot or task (.toml, .urdf). What is no regular file is never replaced.
void require_apart(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs);

}  // namespace maxwrench
