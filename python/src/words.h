#pragma once

#include <pybind11/pybind11.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "maxwrench/types.h"

// Words and numbers of Python's arguments.

namespace maxwrench::python {

namespace py = pybind11;

/// A list of names, or a text of them separated by commas.
std::vector<std::string> names_in(std::string_view key, const py::object& value);
/// The free axes of a base: names of kTwistAxes, as indices in increasing order.
std::vector<int> base_axes_in(std::string_view key, const py::object& value);
/// A direction [force; torque]: six numbers, or an axis such as "-z" or "rx".
Vector6d direction_in(std::string_view key, const py::object& value);
std::string text_in(std::string_view key, const py::object& value);
int integer_in(std::string_view key, const py::object& value);
double number_in(std::string_view key, const py::object& value);
bool flag_in(std::string_view key, const py::object& value);
/// A dict of numbers by name.
std::map<std::string, double> numbers_by_name(std::string_view key, const py::object& value);
/// A path, of any type that os.fspath takes.
std::string path_in(std::string_view key, const py::object& value);

}  // namespace maxwrench::python
