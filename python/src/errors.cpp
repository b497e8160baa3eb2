#include <exception>
#include <filesystem>

#include "problems/loader/bad_input.h"
#include "problems/make/bad_value.h"
#include "python/src/parts.h"

namespace maxwrench::python {
namespace {

/// The classes of errors. They live as long as the interpreter.
struct ErrorTypes {
  py::handle input, missing;
};
ErrorTypes& error_types() {
  static ErrorTypes types;
  return types;
}

/// A text whose bytes may be those of a path, which need not be UTF-8.
py::object text_of(const std::string& text) {
  return py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "surrogateescape"));
}

void raise(const py::handle& type, const char* line, const std::string& file,
           const std::string& key, const std::string& value, const std::string& expected) {
  py::object error = type(text_of(one_line(line)));
  const auto known = [](const std::string& text) -> py::object {
    return text.empty() ? py::object(py::none()) : text_of(text);
  };
  error.attr("file") = known(file);
  error.attr("key") = known(key);
  error.attr("value") = known(value);
  error.attr("expected") = known(expected);
  PyErr_SetObject(type.ptr(), error.ptr());
}

void translate(std::exception_ptr pointer) {
  if (!pointer) return;
  const ErrorTypes& types = error_types();
  try {
    std::rethrow_exception(pointer);
  } catch (const BadInput& error) {
    const BadValue& bad = error.value();
    std::error_code none;
    const bool missing = !std::filesystem::exists(error.file(), none);
    raise(missing ? types.missing : types.input, error.what(), error.file().string(), bad.key(),
          bad.got(), bad.expected());
  } catch (const BadValue& bad) {
    raise(types.input, bad.what(), "", bad.key(), bad.got(), bad.expected());
  } catch (const std::invalid_argument& error) {
    const std::string line = error.what();
    raise(types.input, line.c_str(), "", line.substr(0, std::min(line.find(": "), line.size())), "",
          "");
  }
}

}  // namespace

void add_errors(py::module_& m) {
  const py::module_ errors = py::module_::import("maxwrench._errors");
  for (const char* name : {"InputError", "MissingFileError"}) m.attr(name) = errors.attr(name);
  const auto kept = [&errors](const char* name) { return py::object(errors.attr(name)).release(); };
  error_types() = {kept("InputError"), kept("MissingFileError")};
  py::register_exception_translator(translate);
}

}  // namespace maxwrench::python
