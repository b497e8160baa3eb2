#include <pybind11/stl.h>

#include <cmath>

#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"
#include "problems/make/bad_value.h"
#include "python/src/arrays.h"
#include "python/src/parts.h"
#include "python/src/shared_objects.h"

namespace maxwrench::python {
namespace {

/// What a measure in Python sees of a posture: copies, which it may keep.
struct PyPosture {
  Eigen::VectorXd theta_r, q, tau_d, c, u_min, u_max;
  RowMatrix J, B;
};

PyPosture seen(const Problem& task, const Posture& posture, const WrenchProgram& program) {
  PyPosture view;
  view.theta_r = posture.theta_r;
  view.q = posture.q;
  view.tau_d = posture.tau_d;
  view.c.resize(6);
  view.c << posture.turn * task.c.head<3>(), posture.turn * task.c.tail<3>();
  view.J = posture.J;
  view.B = program.actuation->B;
  view.u_min = program.actuation->u_min;
  view.u_max = program.actuation->u_max;
  return view;
}

/// A measure that is written in Python.
class PythonMeasure : public Measure {
 public:
  PythonMeasure(const Problem& task, Shared measure, bool has_derivatives)
      : task_(task), measure_(std::move(measure)), has_derivatives_(has_derivatives) {
    const py::gil_scoped_acquire lock;
    name_ = attribute_of(*measure_, "name", "");
    differences_ = make_value_measure([this](const Posture& posture, const WrenchProgram& program) {
      return value_of(posture, program);
    });
  }

  void evaluate_well_formed(const Posture& posture, const WrenchProgram& program, bool,
                            Capability& capability) override {
    capability.conclude(Status::kOptimal);
    capability.beta = value_of(posture, program);
    if (std::isnan(capability.beta)) {
      capability.conclude(Status::kInfeasible, "measure " + name_ + " returned NaN");
    } else if (std::isinf(capability.beta)) {
      capability.conclude(Status::kNumericalError, "measure " + name_ + " returned an infinity");
    }
    capability.lambda.setZero(posture.tau_d.size());
    capability.beta_J.setZero(6, posture.J.cols());
  }

  void differentiate(const Posture& posture, const WrenchProgram& program,
                     Capability& capability) override {
    if (!has_derivatives_) return differences_->differentiate(posture, program, capability);
    const py::gil_scoped_acquire lock;
    const py::object pair = measure_->attr("derivatives")(seen(task_, posture, program));
    if (!py::isinstance<py::tuple>(pair) || py::len(pair) != 2) {
      throw BadValue(name_ + ".derivatives", std::string(py::repr(pair)),
                     "a pair of arrays (n) and (6, n)");
    }
    const Eigen::Index n = posture.tau_d.size();
    const std::string by_tau_d = name_ + ".derivatives[0]", by_J = name_ + ".derivatives[1]";
    capability.lambda = vector(by_tau_d, pair[py::int_(0)], n);
    capability.beta_J = matrix(by_J, pair[py::int_(1)], 6, n);
    require_all_finite(by_tau_d, capability.lambda);
    require_all_finite(by_J, capability.beta_J);
  }

 private:
  /// The number that it returns.
  double value_of(const Posture& posture, const WrenchProgram& program) const {
    const py::gil_scoped_acquire lock;
    const py::object value = measure_->attr("value")(seen(task_, posture, program));
    if (PyFloat_Check(value.ptr())) return PyFloat_AS_DOUBLE(value.ptr());
    const std::string key = name_ + ".value";
    const Array number = numbers(key, value);
    if (number.size() != 1) throw BadValue(key, "shape " + shape_of(number), "one number");
    return *number.data();
  }

  const Problem& task_;
  Shared measure_;
  bool has_derivatives_;
  std::string name_;
  std::unique_ptr<Measure> differences_;  ///< differentiates by values
};

void add_python_measure(const py::object& measure) {
  const std::string name = attribute_of(measure, "name", ""),
                    unit = attribute_of(measure, "unit", "");
  const std::string summary = attribute_of(measure, "__doc__", "a measure in Python");
  const bool derivatives = py::hasattr(measure, "derivatives");
  add_measure({name.c_str(), summary.c_str(), false, flag_of(measure, "supports_any"),
               unit.empty() ? nullptr : unit.c_str(),
               [shared = share(measure), derivatives](const Problem& task, auto) {
                 return std::make_unique<PythonMeasure>(task, shared, derivatives);
               }});
}

void add_posture(py::module_& m) {
  py::class_<PyPosture> posture(m, "Posture", R"(What a measure sees of a posture.

>>> class Lever(maxwrench.Measure):
...     name, unit = "lever", "m"
...     def value(self, posture):                        # of the last joint about z
...         return numpy.linalg.norm(posture.J[:2, -1])
>>> maxwrench.add_measure(Lever())
>>> maxwrench.evaluate("planar/force", [0, 0], measure="lever").status
'optimal'
)");
  const auto member = [&posture](const char* name, auto PyPosture::*array, const char* doc) {
    posture.def_property_readonly(
        name, [array](const PyPosture& p) { return copy(p.*array); }, doc);
  };
  member("theta_r", &PyPosture::theta_r, "Redundant coordinates (r).");
  member("q", &PyPosture::q, "All joints (J).");
  member("tau_d", &PyPosture::tau_d, "Forces that the efforts must exert without contact (n).");
  member("c", &PyPosture::c, "Unit direction [force; torque] of the task in the world (6).");
  member("u_min", &PyPosture::u_min, "Lower limits of the efforts (m).");
  member("u_max", &PyPosture::u_max, "Upper limits of the efforts (m).");
  member("J", &PyPosture::J, "Jacobian (6×n): velocities to the twist of the end effector.");
  member("B", &PyPosture::B, "Efforts to generalised forces (n×m).");
}

}  // namespace

void add_own_measures(py::module_& m) {
  add_posture(m);
  m.def("_add_measure", &add_python_measure, py::arg("measure"));
}

}  // namespace maxwrench::python
