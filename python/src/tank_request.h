#pragma once

#include <string>

#include "maxwrench/tank.h"
#include "python/src/parts.h"

namespace maxwrench::python {

/// An experiment, with the task of the answer that it carried out.
struct PyExperiment {
  TankRun run;
  PyTask task;
};

/// What an experiment is asked for.
struct Request {
  std::string integrator, interpolation;
  double planned = 0;
  TankOptions tank;
};

/// Reads the arguments of an experiment. Throws BadValue if the answer has no value, or for a value
/// out of its range.
Request read_request(const PyAnswer& given, const std::string& integrator,
                     const std::string& interpolation, double planned, const py::kwargs& options);

/// The answer of a static task at its posture, whose pose is fixed.
Answer held_answer(const Answer& answer);

ScriptOptions script_options(const Problem& task, const Request& request);

void add_tank_scenarios(py::module_& m);

}  // namespace maxwrench::python
