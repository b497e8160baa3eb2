#include "maxwrench/capability.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <mutex>
#include <numeric>

#include "maxwrench/batch.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"
#include "problems/make/bad_value.h"
#include "python/src/arrays.h"
#include "python/src/background.h"
#include "python/src/fields.h"
#include "python/src/parts.h"
#include "python/src/words.h"
#include "solvers/solve/method.h"

// Capabilities of arrays: J, tau_d and limits of whatever model the user has.

namespace maxwrench::python {
namespace {

/// B and the limits of u, with their facets.
using SharedZonotope = std::shared_ptr<const Zonotope>;

/// The zonotopes of the last calls. Facets take milliseconds, a program microseconds.
SharedZonotope zonotope_of(const RowMatrix& B, const Eigen::VectorXd& u_min,
                           const Eigen::VectorXd& u_max) {
  constexpr std::size_t kKept = 8;
  static std::mutex mutex;
  static std::vector<SharedZonotope> kept;
  const std::lock_guard lock(mutex);
  for (const SharedZonotope& known : kept) {
    if (known->B.rows() == B.rows() && known->B.cols() == B.cols() && known->B == B &&
        known->u_min == u_min && known->u_max == u_max) {
      return known;
    }
  }
  if (kept.size() == kKept) kept.erase(kept.begin());
  return kept.emplace_back(std::make_shared<const Zonotope>(make_zonotope(B, u_min, u_max)));
}

/// B of an argument; None: one direct drive for each of n joints.
SharedZonotope actuators_in(const py::object& B, const py::object& lower, const py::object& upper,
                            Eigen::Index n) {
  const RowMatrix matrix_B =
      B.is_none() ? RowMatrix(RowMatrix::Identity(n, n)) : matrix("B", B, n, -1);
  require_all_finite("B", matrix_B);
  const Eigen::VectorXd u_min = vector("lower", lower, matrix_B.cols());
  const Eigen::VectorXd u_max = vector("upper", upper, matrix_B.cols());
  require_bounds("lower", u_min, "upper", u_max, 0);
  return zonotope_of(matrix_B, u_min, u_max);
}

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

/// The results of many programs, with the shape of the leading axes.
struct Capabilities {
  std::vector<py::ssize_t> shape;
  std::vector<Status> status;
  std::vector<std::string> reason;
  Eigen::VectorXd beta;
  RowMatrix h, u, lambda;

  Capabilities() = default;
  Capabilities(std::vector<py::ssize_t> leading, Eigen::Index m, Eigen::Index n)
      : shape(std::move(leading)) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    const Eigen::Index count =
        std::accumulate(shape.begin(), shape.end(), Eigen::Index(1), std::multiplies<>());
    status.assign(std::size_t(count), Status::kBudgetExhausted);
    reason.resize(std::size_t(count));
    beta = Eigen::VectorXd::Constant(count, none);
    h.setConstant(count, 6, none);
    u.setConstant(count, m, none);
    lambda.setConstant(count, n, none);
  }
  void store(Eigen::Index i, const Capability& capability) {
    Status& how = status[std::size_t(i)] = capability.status;
    reason[std::size_t(i)] = capability.reason.str();
    if (how != Status::kOptimal) return;
    if (!satisfies_program(capability)) {
      how = Status::kNumericalError;
      reason[std::size_t(i)] = "the answer does not satisfy its program";
      return;
    }
    beta[i] = capability.beta;
    if (capability.w.size() > 0) h.row(i) = capability.h;
    if (capability.u.size() > 0) u.row(i) = capability.u;
    if (capability.lambda.size() > 0) lambda.row(i) = capability.lambda;
  }
};

template <class Archive>
void fields(Archive& archive, Capabilities& c) {
  archive(c.shape, c.status, c.reason, c.beta, c.h, c.u, c.lambda);
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

/// An array with the leading axes, and one more of `last` numbers.
py::object shaped(const py::object& self, const RowMatrix& rows) {
  std::vector<py::ssize_t> shape = self.cast<const Capabilities&>().shape;
  shape.push_back(rows.cols());
  return view(rows.data(), shape, self);
}

/// A value of each program: that itself if there is one program without leading axes.
template <class Value>
py::object each(const Capabilities& results, Value value) {
  if (results.shape.empty()) return py::cast(value(0));
  py::list list;
  for (std::size_t i = 0; i < results.status.size(); ++i) list.append(value(i));
  return py::module_::import("numpy")
      .attr("array")(list, py::arg("dtype") = "str")
      .attr("reshape")(results.shape);
}

std::string repr_of_capability(const Capabilities& self) {
  if (self.shape.empty()) {
    return fmt::format("<Capability: {}, {:.6g}>", to_string(self.status.front()), self.beta[0]);
  }
  const auto count = std::count(self.status.begin(), self.status.end(), Status::kOptimal);
  return fmt::format("<Capability of {} programs, {} with a value>", self.status.size(), count);
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

void add_capability(py::module_& m) {
  py::class_<Capabilities>(m, "Capability", R"(The result of ``capability`` or ``scale``.

Arrays are read-only and NaN where there is no value.

>>> J, tau_d = numpy.full((3, 6, 2), 0.5), numpy.zeros((3, 2))
>>> result = maxwrench.capability(J, tau_d, [-2, -2], [2, 2], "x")
>>> result.beta.shape, result.u.shape, result.status[0]
((3,), (3, 2), 'optimal')
)")
      .def_property_readonly(
          "beta",
          [](const py::object& self) -> py::object {
            const auto& results = self.cast<const Capabilities&>();
            if (results.shape.empty()) return py::float_(results.beta[0]);
            return view(results.beta.data(), results.shape, self);
          },
          "The values (...); a number without leading axes.")
      .def_property_readonly(
          "h",
          [](const py::object& self) { return shaped(self, self.cast<const Capabilities&>().h); },
          "Wrenches [force; torque] that the robot exerts (..., 6).")
      .def_property_readonly(
          "u",
          [](const py::object& self) { return shaped(self, self.cast<const Capabilities&>().u); },
          "Efforts (..., m).")
      .def_property_readonly(
          "lambda_",
          [](const py::object& self) {
            return shaped(self, self.cast<const Capabilities&>().lambda);
          },
          "Multipliers: derivatives of the values by tau_d (..., n).")
      .def_property_readonly(
          "status",
          [](const Capabilities& c) {
            return each(c, [&c](std::size_t i) { return to_string(c.status[i]); });
          },
          "The status of each program: optimal, infeasible, unbounded or numerical_error.")
      .def_property_readonly(
          "reason",
          [](const Capabilities& c) {
            return each(c, [&c](std::size_t i) { return c.reason[i]; });
          },
          "Why there is no value; empty if there is one.")
      .def("__repr__", &repr_of_capability)
      .def(py::pickle(&pack<Capabilities>, &unpack<Capabilities>));
  m.def("capability", &capability_of, py::arg("J"), py::arg("tau_d"), py::arg("lower"),
        py::arg("upper"), py::arg("c"), py::arg("B") = py::none(), py::kw_only(),
        py::arg("free") = py::none(), py::arg("measure") = Case().measure, py::arg("solver") = "",
        py::arg("threads") = 0, kCapability);
  m.def("scale", &scale, py::arg("B"), py::arg("lower"), py::arg("upper"), py::arg("tau_d"),
        py::arg("w"), kScale);
}

}  // namespace maxwrench::python
