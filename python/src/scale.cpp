#include "maxwrench/capability.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"
#include "python/src/arrays.h"
#include "python/src/capabilities.h"
#include "python/src/parts.h"

// How far actuators reach along a demanded generalised force.

namespace maxwrench::python {
namespace {

/// The program max s subject to B u = tau_d + s w, as a wrench program with one column.
Capabilities scale(const py::object& B, const py::object& lower, const py::object& upper,
                   const py::object& tau_given, const py::object& w_given) {
  const Eigen::VectorXd tau_d = vector("tau_d", tau_given);
  const Eigen::VectorXd w = vector("w", w_given, tau_d.size());
  require_all_finite("tau_d", tau_d);
  require_all_finite("w", w);
  const SharedZonotope actuation = actuators_in(B, lower, upper, tau_d.size());
  WrenchProgram program;
  program.actuation = actuation.get();
  program.W = Matrix6Xd::Zero(6, 1);
  program.C_2.resize(6, 0);
  program.c_w = Eigen::VectorXd::Ones(1);
  program.w_min = Eigen::VectorXd::Constant(1, -kInfinity);
  program.w_max = Eigen::VectorXd::Constant(1, kInfinity);
  program.JtW = w;
  program.tau_d = tau_d;
  Capability capability;
  find_wrench_solver(actuation->has_facets ? "facets" : "condensed")
      .make()
      ->solve(program, true, capability);
  Capabilities result({}, actuation->actuators(), tau_d.size());
  if (capability.status == Status::kOptimal) {
    capability.residual = recheck(program, capability.u, capability.w, capability.lambda);
    capability.w.resize(0);  // there is no wrench
  }
  result.store(0, capability);
  return result;
}

constexpr const char* kScale =
    R"(Finds the largest factor of a demanded generalised force that actuators reach.

    max s  subject to  B u = tau_d + s w,  lower <= u <= upper

The force keeps its direction: a thruster allocation that saturates does not bend it. The facets of
{B u} of the last eight B and limits are kept, so that a call takes microseconds.

Args:
    B: efforts to generalised forces (n×m); None: one direct drive for each coordinate.
    lower, upper: limits of the efforts (m).
    tau_d: generalised force that is needed in any case (n).
    w: demanded generalised force (n).

Returns:
    Capability: beta is the factor; u (m), lambda_ (n), status.

Raises:
    InputError: shapes do not fit, a number is not finite, or limits cross.

>>> maxwrench.scale([[1, 1]], [-1, -1], [1, 1], [0], [4]).beta
0.5
)";

}  // namespace

void add_scale(py::module_& m) {
  m.def("scale", &scale, py::arg("B"), py::arg("lower"), py::arg("upper"), py::arg("tau_d"),
        py::arg("w"), kScale);
}

}  // namespace maxwrench::python
