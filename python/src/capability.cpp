#include "maxwrench/capability.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "maxwrench/batch.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"
#include "problems/make/bad_value.h"
#include "python/src/arrays.h"
#include "python/src/background.h"
#include "python/src/capabilities.h"
#include "python/src/parts.h"
#include "python/src/words.h"
#include "solvers/solve/method.h"

// Capabilities of arrays: J, tau_d and limits of whatever model the user has.

namespace maxwrench::python {
namespace {

/// A task with nothing but actuators and directions: what measures need beside J and tau_d.
Problem task_of_arrays(const Zonotope& actuation, const Vector6d& c, const py::object& free) {
  Problem task;
  task.name = "arrays";
  task.robot.actuation = actuation;
  task.robot.joints.resize(std::size_t(actuation.dimension()));
  require_all_finite("c", c);
  if (!(c.norm() > 0)) throw BadValue("c", "a vector of zeros", "a direction of nonzero length");
  task.c = c.normalized();
  task.W_any = Matrix6Xd::Identity(6, 6);
  if (!free.is_none()) {
    const RowMatrix others = matrix("free", free, 6, -1);
    require_all_finite("free", others);
    Matrix6Xd all(6, 1 + others.cols());
    all << task.c, others;
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(all);
    task.W_any = qr.householderQ() * Eigen::MatrixXd::Identity(6, qr.rank());
  }
  return task;
}

/// The leading axes of J and tau_d by NumPy's rules. Whichever lacks some of them is repeated.
std::vector<py::ssize_t> broadcast(Array& J, Array& tau_d) {
  const auto front = [](const Array& array, py::ssize_t last) {
    return std::vector<py::ssize_t>(array.shape(), array.shape() + array.ndim() - last);
  };
  if (J.ndim() < 2 || J.shape(J.ndim() - 2) != 6) {
    throw BadValue("J", "shape " + shape_of(J), "an array of shape (..., 6, n)");
  }
  const py::ssize_t n = J.shape(J.ndim() - 1);
  const auto expected = fmt::format(
      "an array of shape (..., {}) whose leading axes fit those of J, {}", n, shape_of(J));
  if (tau_d.ndim() < 1 || tau_d.shape(tau_d.ndim() - 1) != n) {
    throw BadValue("tau_d", "shape " + shape_of(tau_d), expected);
  }
  std::vector<py::ssize_t> axes = front(J, 2);
  if (axes == front(tau_d, 1)) return axes;
  const py::module_ numpy = py::module_::import("numpy");
  try {
    axes = numpy
               .attr("broadcast_shapes")(py::tuple(py::cast(axes)),
                                         py::tuple(py::cast(front(tau_d, 1))))
               .cast<std::vector<py::ssize_t>>();
  } catch (const py::error_already_set& error) {
    if (!error.matches(PyExc_ValueError)) throw;
    throw BadValue("tau_d", "shape " + shape_of(tau_d), expected);
  }
  const auto repeat = [&](Array& array, std::initializer_list<py::ssize_t> last) {
    std::vector<py::ssize_t> shape = axes;
    shape.insert(shape.end(), last);
    array = Array(numpy.attr("broadcast_to")(array, py::tuple(py::cast(shape))));
  };
  repeat(J, {6, n});
  repeat(tau_d, {n});
  return axes;
}

void evaluate_arrays(const Problem& task, const Method& method, const Array& J, const Array& tau_d,
                     int threads, Watch& watch, Capabilities& result) {
  constexpr Eigen::Index kChunk = 64;
  const Eigen::Index n = task.robot.actuation.dimension(), count = result.beta.size();
  const double *const J_data = J.data(), *const tau_data = tau_d.data();
  parallel_for(threads, (count + kChunk - 1) / kChunk, [&](long chunk) {
    const auto measure = method.make_measure();
    WrenchProgram program = make_wrench_program(task, method.choice.wrench);
    Posture posture;
    posture.status = Status::kValid;
    Capability capability;
    const Eigen::Index end = std::min(count, (chunk + 1) * kChunk);
    for (Eigen::Index i = chunk * kChunk; i < end && !watch.stop; ++i) {
      posture.J = Eigen::Map<const RowMatrix>(J_data + i * 6 * n, 6, n);
      posture.tau_d = Eigen::Map<const Eigen::VectorXd>(tau_data + i * n, n);
      if (set_posture(posture, program)) {
        measure->evaluate(posture, program, true, capability);
      } else {
        capability.conclude(Status::kNumericalError, "J or tau_d is not finite");
      }
      result.store(i, capability);
    }
  });
}

Capabilities capability_of(const py::object& J_given, const py::object& tau_given,
                           const py::object& lower, const py::object& upper, const py::object& c,
                           const py::object& B, const py::object& free, const std::string& measure,
                           const std::string& solver, int threads) {
  Array J = numbers("J", J_given), tau_d = numbers("tau_d", tau_given);
  Capabilities result(broadcast(J, tau_d), 0, 0);
  const py::ssize_t n = J.shape(J.ndim() - 1);
  const SharedZonotope actuation = actuators_in(B, lower, upper, n);
  const Problem task = task_of_arrays(*actuation, direction_in("c", c), free);
  Case choice;
  choice.measure = measure;
  choice.solver = solver;
  choice.wrench = free.is_none() ? Wrench::kPure : Wrench::kAny;
  if (!free.is_none() && !find_measure(measure).supports_any) {
    throw BadValue("free", "other wrenches", "None for measure " + measure);
  }
  if (find_measure(measure).acceleration) {
    throw BadValue("measure", shown(measure), "one of J and tau_d alone: this one needs masses");
  }
  const Method method = resolve(task, choice);
  const int wanted = thread_count(threads);
  result = Capabilities(result.shape, actuation->actuators(), n);
  if (result.beta.size() == 1) {
    Watch alone;
    evaluate_arrays(task, method, J, tau_d, 1, alone, result);
  } else {
    run_in_background(py::none(), [&](Watch& watch) {
      evaluate_arrays(task, method, J, tau_d, wanted, watch, result);
    });
  }
  return result;
}

constexpr const char* kCapability = R"(Finds the capability of arrays: of whatever model a user has.

    max c'h  subject to  B u - J'h = tau_d,  lower <= u <= upper,  h = c x + free w

J, tau_d and the limits may come from Pinocchio, MuJoCo, Drake or any other model; ``from_pinocchio``
and ``from_drake`` reorder wrenches. Leading axes of J and tau_d, broadcast as NumPy does, are
evaluated side by side.

Args:
    J: Jacobian (..., 6, n): velocities to the twist [linear; angular] of the end effector.
    tau_d: forces that the efforts must exert without contact, such as gravity (..., n).
    lower, upper: limits of the efforts (m).
    c: direction [force; torque] (6), of any length, or "x", "-z", "rx" ...
    B: efforts to generalised forces (n×m); None: one direct drive for each joint.
    free: other wrenches that may occur (6×k); None: none.
    measure, solver: as of ``evaluate``. Measures of all axes take those of ``free`` and c, or all
        six without it.
    threads: number of threads; 0: one per core.

Returns:
    Capability: beta, h, u, lambda_ and status, each with the leading axes.

Raises:
    InputError: shapes do not fit, or limits cross.

>>> import numpy as np
>>> J = np.zeros((6, 1)); J[0, 0] = 0.5                  # one joint, lever 0.5 m
>>> maxwrench.capability(J, [0.0], [-2.0], [2.0], "x").beta
4.0
)";

}  // namespace

void add_capability(py::module_& m) {
  m.def("capability", &capability_of, py::arg("J"), py::arg("tau_d"), py::arg("lower"),
        py::arg("upper"), py::arg("c"), py::arg("B") = py::none(), py::kw_only(),
        py::arg("free") = py::none(), py::arg("measure") = Case().measure, py::arg("solver") = "",
        py::arg("threads") = 0, kCapability);
}

}  // namespace maxwrench::python
