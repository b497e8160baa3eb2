#include <fmt/format.h>
#include <pybind11/stl.h>

#include "maxwrench/lp_solver.h"
#include "maxwrench/mps.h"
#include "maxwrench/strategies.h"
#include "problems/make/bad_value.h"
#include "python/src/arrays.h"
#include "python/src/background.h"
#include "python/src/fields.h"
#include "python/src/parts.h"
#include "python/src/words.h"

namespace maxwrench::python {
namespace {

/// Entries of a matrix whose program takes about as long as another thread.
constexpr Eigen::Index kSmall = 500;

/// The answer of a linear program, with its residuals.
struct LpAnswer {
  LpSolution solution;
  Residual residual;
};

template <class Archive>
void fields(Archive& archive, LpAnswer& a) {
  LpSolution& s = a.solution;
  archive(static_cast<Verdict&>(s), s.x, s.lambda, s.certificate, s.objective, s.iterations,
          a.residual);
}

/// A matrix of scipy.sparse, of any format.
Eigen::SparseMatrix<double> sparse_matrix(const py::object& value) {
  const py::object csc = value.attr("tocsc")(py::arg("copy") = true);
  csc.attr("sum_duplicates")();
  const auto shape = csc.attr("shape").cast<std::pair<Eigen::Index, Eigen::Index>>();
  const Eigen::VectorXd data = vector("A", csc.attr("data"));
  const auto rows = csc.attr("indices").cast<py::array_t<int, py::array::forcecast>>();
  const auto starts = csc.attr("indptr").cast<py::array_t<int, py::array::forcecast>>();
  return Eigen::Map<const Eigen::SparseMatrix<double>>(shape.first, shape.second, data.size(),
                                                       starts.data(), rows.data(), data.data());
}

/// Bounds of an argument; None: `otherwise` throughout.
Eigen::VectorXd bounds_in(const char* key, const py::object& value, Eigen::Index cols,
                          double otherwise) {
  return value.is_none() ? Eigen::VectorXd(Eigen::VectorXd::Constant(cols, otherwise))
                         : vector(key, value, cols);
}

LpAnswer linprog(const py::object& c, const py::object& A, const py::object& b, const py::object& l,
                 const py::object& u, const std::string& solver) {
  LinearProgram program;
  program.c = vector("c", c);
  const Eigen::Index cols = program.c.size();
  program.A = py::hasattr(A, "tocsc")
                  ? sparse_matrix(A)
                  : Eigen::SparseMatrix<double>(matrix("A", A, -1, cols).sparseView());
  if (program.A.cols() != cols) {
    throw BadValue("A", fmt::format("{} columns", program.A.cols()), fmt::format("{}", cols));
  }
  program.A.makeCompressed();
  program.b = vector("b", b, program.A.rows());
  program.l = bounds_in("l", l, cols, 0);
  program.u = bounds_in("u", u, cols, kInfinity);
  require_all_finite("c", program.c);
  require_all_finite("b", program.b);
  const Eigen::Map<const Eigen::VectorXd> entries(program.A.valuePtr(), program.A.nonZeros());
  require_all_finite("A", entries);
  require_bounds("l", program.l, "u", program.u, kInfinity);
  validate(program);
  const LpEntry& entry = find_lp_solver(solver);
  LpAnswer answer;
  const auto solve = [&] {
    entry.make()->solve(program, answer.solution);
    answer.residual = residuals(program, answer.solution);
    // No status counts that the data do not confirm.
    const Status status = answer.solution.status;
    const bool claims =
        status == Status::kOptimal || status == Status::kInfeasible || status == Status::kUnbounded;
    if (claims && !verified(program, answer.solution)) {
      answer.solution.conclude(Status::kNumericalError, "the data do not confirm the verdict");
    }
  };
  // A small program ends before a key is pressed.
  if (program.A.nonZeros() > kSmall) {
    run_or_interrupt(solve);
  } else {
    const py::gil_scoped_release released;
    solve();
  }
  if (answer.solution.status != Status::kOptimal) {
    answer.solution.objective = std::numeric_limits<double>::quiet_NaN();
  }
  return answer;
}

constexpr const char* kLinprog = R"(Solves a linear program, and verifies the verdict from its data.

    max c'x  subject to  A x = b,  l <= x <= u

Note that it maximises, and that multipliers are derivatives of the maximum.

Args:
    c: objective (n).
    A: matrix (m×n), an array or a matrix of scipy.sparse.
    b: right-hand side (m).
    l, u: bounds (n); they may be infinite. None: 0 and infinity.
    solver: "simplex" (ours), "clp", "glpk" or "ipopt".

Returns:
    LpAnswer: status, x, objective, lambda_ and certificate.

Raises:
    InputError: shapes do not fit, or an entry is not finite.

>>> maxwrench.linprog([1, 2], [[1, 1]], [1]).objective
2.0
)";

}  // namespace

void add_linear_programs(py::module_& m) {
  py::class_<LpAnswer>(m, "LpAnswer", R"(The answer of ``linprog``.

>>> answer = maxwrench.linprog([1, 2], [[1, 1]], [1])
>>> answer.status, answer.objective, answer.x
('optimal', 2.0, array([0., 1.]))
)")
      .def_property_readonly(
          "status", [](const LpAnswer& a) { return to_string(a.solution.status); },
          "optimal, infeasible, unbounded, budget_exhausted or numerical_error.")
      .def_property_readonly(
          "reason", [](const LpAnswer& a) { return a.solution.reason.str(); },
          "Why there is no verdict; empty if there is one.")
      .def_property_readonly(
          "x",
          [](const py::object& self) {
            return view(self.cast<const LpAnswer&>().solution.x, self);
          },
          "The point (n).")
      .def_property_readonly(
          "objective", [](const LpAnswer& a) { return a.solution.objective; },
          "c'x; NaN unless optimal.")
      .def_property_readonly(
          "lambda_",
          [](const py::object& self) {
            return view(self.cast<const LpAnswer&>().solution.lambda, self);
          },
          "Multipliers: derivatives of the maximum by b (m).")
      .def_property_readonly(
          "certificate",
          [](const py::object& self) {
            return view(self.cast<const LpAnswer&>().solution.certificate, self);
          },
          "Infeasible: y (m) with sup {y'A x : l <= x <= u} < y'b (Farkas). Unbounded: a ray (n).")
      .def_property_readonly(
          "iterations", [](const LpAnswer& a) { return a.solution.iterations; },
          "Iterations of the solver.")
      .def_property_readonly(
          "residual",
          [](const LpAnswer& a) {
            py::dict numbers;
            numbers["balance"] = a.residual.balance;
            numbers["bounds"] = a.residual.bounds;
            numbers["dual"] = a.residual.dual;
            numbers["gap"] = a.residual.gap;
            return numbers;
          },
          "balance, bounds, dual and gap, recomputed from the data.")
      .def("__repr__",
           [](const LpAnswer& a) {
             const bool optimal = a.solution.status == Status::kOptimal;
             return fmt::format(
                 "<LpAnswer: {}{}>", to_string(a.solution.status),
                 optimal ? fmt::format(", objective {:.10g}", a.solution.objective) : "");
           })
      .def(py::pickle(&pack<LpAnswer>, &unpack<LpAnswer>));
  m.def("linprog", &linprog, py::arg("c"), py::arg("A"), py::arg("b"), py::arg("l") = py::none(),
        py::arg("u") = py::none(), py::kw_only(), py::arg("solver") = "simplex", kLinprog);
}

}  // namespace maxwrench::python
