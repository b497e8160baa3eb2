#pragma once

#include <pybind11/pybind11.h>

#include "maxwrench/task.h"
#include "python/src/parts.h"

// The arguments of Static, Trajectory and Impulse: each function removes from `arguments` what it
// reads.

namespace maxwrench::python {

/// Takes an argument out of the dict, or its default.
py::object taken(py::dict& arguments, const char* name, py::object otherwise = py::none());
/// The arguments that all tasks have: robot, name, pose, wrench, theta_r.
TaskSpec begin_spec(const PyRobot& robot, py::dict& arguments, bool in_time);
/// Those of the efforts between knots.
void read_scheme(py::dict& arguments, MotionTask& motion);
/// Rejects arguments that nothing has read.
void require_empty(const py::dict& arguments, const char* function);

}  // namespace maxwrench::python
