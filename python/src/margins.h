#pragma once

#include <pybind11/pybind11.h>

namespace maxwrench::python {

/// Adds `Margin` and `margin` to the module.
void add_margins(pybind11::module_& m);

}  // namespace maxwrench::python
