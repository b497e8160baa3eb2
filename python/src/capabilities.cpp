#include "python/src/capabilities.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <limits>
#include <mutex>
#include <numeric>

#include "python/src/fields.h"
#include "python/src/parts.h"
#include "solvers/solve/method.h"

namespace maxwrench::python {

template <class Archive>
void fields(Archive& archive, Capabilities& c) {
  archive(c.shape, c.status, c.reason, c.beta, c.h, c.u, c.lambda);
}

namespace {

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

}  // namespace

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

Capabilities::Capabilities(std::vector<py::ssize_t> leading, Eigen::Index m, Eigen::Index n)
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

void Capabilities::store(Eigen::Index i, const Capability& capability) {
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

void add_capabilities(py::module_& m) {
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
}

}  // namespace maxwrench::python
