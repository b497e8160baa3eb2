#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace maxwrench {

/// Replaces closed standard streams by a placeholder that rejects every write. Otherwise a file
/// that is opened later would get their number and receive their output. Also, a file that exceeds
/// the limit of the process (ulimit -f) causes an error instead of a fatal signal.
void prepare_streams();

/// Prints "maxwrench: <text>" to stderr as one line, whatever the text holds. Never throws.
void complain(const std::string& text);

/// Keeps a text for `print_kept_complaints`: bad input that is found later has one line alone.
void complain_at_end(const std::string& text);

/// Prints the texts kept so far as `complain` does.
void print_kept_complaints();

/// Prints a remark to stderr as one line. Never throws.
void remark(const std::string& text);

/// Flushes stdout. Returns the exit status, or that of bad input, with a complaint, if stdout
/// rejected the output.
int flush_output(int exit_status);

/// Prints one object on one line, see `in_one_line`.
void print_json(const nlohmann::ordered_json& object);

/// A file that an option or argument of the command names; empty if none.
struct NamedFile {
  const char* option;
  std::string path;
};

/// Throws std::invalid_argument, before any computation, if an output would replace an input,
/// another output or any robot or task (.toml, .urdf, .srdf, .xacro). An output that is not a
/// regular file, such as a device, replaces nothing.
void require_apart(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs);

}  // namespace maxwrench
