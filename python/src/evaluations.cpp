#include "maxwrench/evaluations.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>

#include "python/src/arrays.h"
#include "python/src/background.h"
#include "python/src/parts.h"

namespace maxwrench::python {
namespace {

/// The evaluations of a task, as Python holds them.
struct PyEvaluations {
  Evaluations rows;
  PyTask task;
  bool gradients = false;  ///< whether they were requested
};

std::vector<const char*> status_names(const PyEvaluations& self) {
  std::vector<const char*> names;
  for (const Status status : self.rows.status) names.push_back(to_string(status));
  return names;
}

py::array valid(const PyEvaluations& self) {
  py::array_t<bool> flags(py::ssize_t(self.rows.status.size()));
  for (std::size_t i = 0; i < self.rows.status.size(); ++i) {
    flags.mutable_at(py::ssize_t(i)) = self.rows.status[i] == Status::kOptimal;
  }
  return flags;
}

std::string repr_of_evaluations(const PyEvaluations& self) {
  const auto count = std::count(self.rows.status.begin(), self.rows.status.end(), Status::kOptimal);
  return fmt::format("<Evaluations of {}: {} postures, {} with a value>", self.task.problem->name,
                     self.rows.status.size(), count);
}

/// A read-only view of rows that the object holds.
template <Evaluations::Rows Evaluations::*rows>
py::array rows_of(const py::object& self) {
  const Evaluations::Rows& table = (self.cast<const PyEvaluations&>().rows).*rows;
  return view(table.data(), {table.rows(), table.cols()}, self);
}

py::object gradient_of(const py::object& self) {
  if (!self.cast<const PyEvaluations&>().gradients) return py::none();
  return rows_of<&Evaluations::gradient>(self);
}

py::tuple evaluations_state(const PyEvaluations& self) {
  const Evaluations& rows = self.rows;
  py::list status;
  for (const Status each : rows.status) status.append(static_cast<int>(each));
  return py::make_tuple(self.task, self.gradients, status, copy(rows.beta), copy(rows.gradient),
                        copy(rows.q), copy(rows.base), copy(rows.u), copy(rows.h));
}

PyEvaluations evaluations_of(const py::tuple& state) {
  PyEvaluations self{{}, state[0].cast<PyTask>(), state[1].cast<bool>()};
  Evaluations& rows = self.rows;
  for (const py::handle each : state[2]) {
    rows.status.push_back(static_cast<Status>(each.cast<int>()));
  }
  const auto table = [&state](int i) { return matrix("state", state[std::size_t(i)]); };
  rows.beta = vector("state", state[3]);
  rows.gradient = table(4);
  rows.q = table(5);
  rows.base = table(6);
  rows.u = table(7);
  rows.h = table(8);
  return self;
}

/// The Evaluations that evaluate(options) returns, in the background.
template <class Evaluate>
py::object evaluated(const PyTask& task, Eigen::Index rows, bool gradients, Options options,
                     const py::object& callback, const Evaluate& evaluate) {
  PyEvaluations result{{}, task, gradients};
  const Callback shown(callback, rows, task.problem->name);
  run_in_background(shown.function(), [&](Watch& watch) {
    watch_over(watch, options);
    result.rows = evaluate(options);
  });
  return py::cast(std::move(result));
}

}  // namespace

py::object evaluate_rows(const PyTask& task, const py::object& theta_r, const Options& options,
                         bool gradients, const py::object& callback) {
  const RowMatrix table = matrix("theta_r", theta_r, -1, task.problem->redundancy());
  require_all_finite("theta_r", table);
  return evaluated(task, table.rows(), gradients, options, callback, [&](const Options& how) {
    return evaluate_each(*task.problem, table, how, gradients);
  });
}

py::object evaluate_joint_rows(const PyTask& task, const py::object& q, const Options& options,
                               const py::object& callback) {
  const RowMatrix table = matrix("q", q, -1, Eigen::Index(task.problem->robot.joints.size()));
  require_all_finite("q", table);
  return evaluated(task, table.rows(), false, options, callback, [&](const Options& how) {
    return evaluate_each_posture(*task.problem, table, how);
  });
}

void add_evaluations(py::module_& m) {
  py::class_<PyEvaluations>(m, "Evaluations", R"(The values of N postures of a static task.

Arrays have a row for each posture and are read-only views. They are NaN where there is no value.

>>> rows = maxwrench.evaluate("planar/force", [[0, 0], [0.1, 0]], gradients=True)
>>> rows.beta.shape, rows.gradient.shape
((2,), (2, 2))
)")
      .def_property_readonly(
          "beta",
          [](const py::object& self) {
            return view(self.cast<const PyEvaluations&>().rows.beta, self);
          },
          "The values (N) [unit].")
      .def_property_readonly("gradient", &gradient_of,
                             "Gradients by theta_r (N×r); None unless they were requested.")
      .def_property_readonly("q", &rows_of<&Evaluations::q>, "All joints (N×J) [rad or m].")
      .def_property_readonly("base", &rows_of<&Evaluations::base>,
                             "Base in the world: x, y, z, roll, pitch, yaw (N×6) [m; rad].")
      .def_property_readonly("u", &rows_of<&Evaluations::u>, "Efforts (N×m) [N or N m].")
      .def_property_readonly("h", &rows_of<&Evaluations::h>,
                             "Wrenches [force; torque] in the world (N×6).")
      .def_property_readonly("status", &status_names, "The status of each posture (N texts).")
      .def_property_readonly("valid", &valid, "Whether there is a value (N booleans).")
      .def_property_readonly(
          "unit", [](const PyEvaluations& e) { return e.task.problem->unit(); },
          "The unit of measures that are a wrench along c.")
      .def_property_readonly(
          "task", [](const PyEvaluations& e) { return e.task; }, "The Task.")
      .def("__len__", [](const PyEvaluations& e) { return e.rows.status.size(); })
      .def("__repr__", &repr_of_evaluations)
      .def(py::pickle(&evaluations_state, &evaluations_of));
}

}  // namespace maxwrench::python
