#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

// Measures and searches that are written in Python. The library calls them from its own threads, so
// each call takes the interpreter's lock. What they throw passes through the library to the caller
// of solve.

namespace maxwrench::python {

namespace py = pybind11;

/// An object of Python that C++ threads may keep and drop without the lock.
using Shared = std::shared_ptr<const py::object>;
Shared share(const py::object& object);

/// An attribute as text, or `otherwise` if it is missing or None.
std::string attribute_of(const py::object& object, const char* name, const std::string& otherwise);
/// An attribute that is a flag; False if it is missing.
bool flag_of(const py::object& object, const char* name);

}  // namespace maxwrench::python
