#include "python/src/words.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "problems/make/bad_value.h"
#include "python/src/arrays.h"

namespace maxwrench::python {
namespace {

std::string type_of(const py::object& value) {
  return py::str(py::type::of(value).attr("__name__"));
}

/// The value as C++, or an error with what was expected.
template <class T>
T cast(std::string_view key, const py::object& value, std::string_view expected) {
  try {
    return value.cast<T>();
  } catch (const py::cast_error&) {
    throw BadValue(key, "a " + type_of(value), expected);
  }
}

}  // namespace

std::vector<std::string> names_in(std::string_view key, const py::object& value) {
  if (!py::isinstance<py::str>(value)) {
    return cast<std::vector<std::string>>(key, value, "a list of names");
  }
  std::vector<std::string> names;
  std::istringstream words(value.cast<std::string>());
  for (std::string word; std::getline(words, word, ',');) {
    std::erase(word, ' ');
    names.push_back(word);
  }
  return names;
}

std::vector<int> base_axes_in(std::string_view key, const py::object& value) {
  std::vector<int> axes;
  const std::vector<std::string> names = names_in(key, value);
  for (const std::string& name : names) {
    const auto found = std::find(kTwistAxes.begin(), kTwistAxes.end(), name);
    if (found == kTwistAxes.end()) {
      throw BadValue(key, shown(names), "the free axes of the base, of x, y, z, roll, pitch, yaw");
    }
    axes.push_back(static_cast<int>(found - kTwistAxes.begin()));
  }
  std::sort(axes.begin(), axes.end());
  return axes;
}

Vector6d direction_in(std::string_view key, const py::object& value) {
  if (!py::isinstance<py::str>(value)) return vector(key, value, 6);
  static constexpr std::array<const char*, 6> kAxes = {"x", "y", "z", "rx", "ry", "rz"};
  const std::string text = value.cast<std::string>();
  const bool has_sign = text.starts_with('-') || text.starts_with('+');
  const auto found = std::find(kAxes.begin(), kAxes.end(), text.substr(has_sign ? 1 : 0));
  if (found == kAxes.end()) {
    throw BadValue(key, shown(text),
                   "x, y, z (a force) or rx, ry, rz (a torque), perhaps with a sign, or six "
                   "numbers [force; torque]");
  }
  return (text.starts_with('-') ? -1 : 1) * Vector6d::Unit(found - kAxes.begin());
}

std::string text_in(std::string_view key, const py::object& value) {
  return cast<std::string>(key, value, "a text");
}

int integer_in(std::string_view key, const py::object& value) {
  return cast<int>(key, value, "an integer");
}

double number_in(std::string_view key, const py::object& value) {
  return cast<double>(key, value, "a number");
}

bool flag_in(std::string_view key, const py::object& value) {
  return cast<bool>(key, value, "True or False");
}

std::map<std::string, double> numbers_by_name(std::string_view key, const py::object& value) {
  return cast<std::map<std::string, double>>(key, value, "a dict of numbers by name");
}

std::string path_in(std::string_view key, const py::object& value) {
  std::string path;
  try {
    path = py::bytes(py::module_::import("os").attr("fsencode")(value));
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_TypeError)) throw;
    throw BadValue(key, "a " + type_of(value), "a path");
  }
  if (path.find('\0') != std::string::npos) {
    throw BadValue(key, std::string(py::repr(value)), "a path without a NUL");
  }
  return path;
}

}  // namespace maxwrench::python
