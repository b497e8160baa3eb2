#include <fmt/format.h>
#include <pybind11/stl.h>

#include "maxwrench/solve.h"
#include "maxwrench/wrench_set.h"
#include "problems/make/bad_value.h"
#include "python/src/arrays.h"
#include "python/src/background.h"
#include "python/src/parts.h"

namespace maxwrench::python {
namespace {

/// A posture with its task.
struct Placed {
  std::shared_ptr<const Problem> task;
  Posture posture;
};

/// The posture of an Answer, or of a task at theta_r: the best IK solution there.
Placed posture_in(const py::object& task, const py::object& theta_r) {
  if (py::isinstance<PyAnswer>(task)) {
    const Answer& answer = task.cast<const PyAnswer&>().answer;
    if (answer.task->motion) throw BadValue("task", "a task in time", "a static task");
    if (!answer.has_posture()) throw BadValue("task", "an answer without a posture", "one with it");
    return {answer.task, answer.posture};
  }
  const PyTask of = task_of(task);
  if (of.problem->motion) throw BadValue("task", "a task in time", "a static task");
  const Eigen::VectorXd at = vector("theta_r", theta_r, of.problem->redundancy());
  require_all_finite("theta_r", at);
  return {of.problem, evaluate(*of.problem, at.transpose()).posture};
}

/// The directions of a set: "force", "torque", or 6×k numbers.
Matrix6Xd directions_in(const py::object& value) {
  if (!py::isinstance<py::str>(value)) {
    const RowMatrix E = matrix("directions", value, 6, -1);
    require_all_finite("directions", E);
    return E;
  }
  const std::string name = value.cast<std::string>();
  if (name != "force" && name != "torque") {
    throw BadValue("directions", shown(name), "force, torque or 6×k numbers");
  }
  return name == "force" ? Matrix6Xd(Matrix6Xd::Identity(6, 3))
                         : Matrix6Xd(Matrix6Xd::Identity(6, 6).rightCols<3>());
}

WrenchSet polytope(const py::object& task, const py::object& theta_r, const py::object& directions,
                   const std::string& wrench, const std::string& measure,
                   const std::string& solver) {
  const Placed placed = posture_in(task, theta_r);
  WrenchSetOptions options;
  options.E = directions_in(directions);
  options.wrench = parse_wrench(wrench);
  options.measure = measure;
  options.solver = solver;
  WrenchSet set;
  run_or_interrupt([&] { set = force_polytope(*placed.task, placed.posture, options); });
  return set;
}

WrenchEllipsoid ellipsoid(const py::object& task, const py::object& theta_r,
                          const py::object& directions, const std::string& wrench) {
  const Placed placed = posture_in(task, theta_r);
  const Matrix6Xd E = directions_in(directions);
  const py::gil_scoped_release released;
  return force_ellipsoid(*placed.task, placed.posture, E, parse_wrench(wrench));
}

py::array triangles_of(const WrenchSet& set) {
  py::array_t<int> array(std::vector<py::ssize_t>{set.triangles.cols(), 3});
  for (Eigen::Index i = 0; i < set.triangles.cols(); ++i) {
    for (int j = 0; j < 3; ++j) array.mutable_at(i, j) = set.triangles(j, i);
  }
  return array;
}

py::tuple polytope_state(const WrenchSet& s) {
  return py::make_tuple(static_cast<int>(s.status), s.reason.str(), s.dimension,
                        copy(RowMatrix(s.vertices)), copy(RowMatrix(s.efforts)),
                        copy(RowMatrix(s.wrenches)), copy(RowMatrix(s.normals)), copy(s.offsets),
                        s.faces, triangles_of(s), copy(RowMatrix(s.flat_normals)),
                        copy(s.flat_offsets), s.volume, copy(s.ray), s.residual.balance,
                        s.residual.bounds, s.residual.dual, s.residual.gap, s.programs);
}

WrenchSet polytope_of(const py::tuple& state) {
  const auto table = [&state](int i) { return matrix("state", state[std::size_t(i)]); };
  const auto number = [&state](int i) { return state[std::size_t(i)].cast<double>(); };
  WrenchSet s;
  s.conclude(static_cast<Status>(state[0].cast<int>()), state[1].cast<std::string>());
  s.dimension = state[2].cast<int>();
  s.vertices = table(3);
  s.efforts = table(4);
  s.wrenches = table(5);
  s.normals = table(6);
  s.offsets = vector("state", state[7]);
  s.faces = state[8].cast<std::vector<std::vector<int>>>();
  s.triangles = table(9).transpose().cast<int>();
  s.flat_normals = table(10);
  s.flat_offsets = vector("state", state[11]);
  s.volume = number(12);
  s.ray = vector("state", state[13]);
  s.residual = {number(14), number(15), number(16), number(17)};
  s.programs = state[18].cast<int>();
  return s;
}

py::tuple ellipsoid_state(const WrenchEllipsoid& e) {
  return py::make_tuple(static_cast<int>(e.status), e.reason.str(), copy(e.centre),
                        copy(RowMatrix(e.axes)), copy(e.radii), e.volume, copy(e.ray));
}

WrenchEllipsoid ellipsoid_of(const py::tuple& state) {
  WrenchEllipsoid e;
  e.conclude(static_cast<Status>(state[0].cast<int>()), state[1].cast<std::string>());
  e.centre = vector("state", state[2]);
  e.axes = matrix("state", state[3]);
  e.radii = vector("state", state[4]);
  e.volume = state[5].cast<double>();
  e.ray = vector("state", state[6]);
  return e;
}

constexpr const char* kPolytope =
    R"(Computes the set of forces that the robot can exert at a posture.

Args:
    task: a static Task, the name of one, or an Answer, whose posture counts.
    theta_r: the redundant coordinates (r) [rad or m]; not with an Answer.
    directions: "force", "torque", or 6×k numbers: k directions [force; torque] in the world.
    wrench: "pure": nothing beside these directions; "any": together with other wrenches of the
        task.
    measure: "linf_polytope" or "l2_polytope".
    solver: the solver of the linear programs; the first one that supports the task if empty.

Returns:
    Polytope: vertices, faces and the inequalities of the set.

Raises:
    InputError: a value is wrong, or the measure does not support the robot.

>>> task = maxwrench.load("uvms/valve")
>>> polytope = maxwrench.polytope(task, task.theta_r_default)
>>> polytope.status, polytope.dimension
('optimal', 3)
>>> in_plane = numpy.eye(6)[:, :2]                       # a planar robot bears any force across it
>>> maxwrench.polytope("planar/force", [0, 0], directions=in_plane).dimension
2
)";

constexpr const char* kEllipsoid =
    R"(Computes the ellipsoid of forces of the measure ellipsoid at a posture.

Args:
    task, theta_r, directions, wrench: as of ``polytope``.

Returns:
    Ellipsoid: centre, axes and radii.

Raises:
    InputError: as ``polytope``, and if an actuator cannot act in both directions.

>>> in_plane = numpy.eye(6)[:, :2]                       # a planar robot bears any force across it
>>> maxwrench.ellipsoid("planar/force", [0, 0], directions=in_plane).radii.shape
(2,)
)";

}  // namespace

void add_wrench_sets(py::module_& m) {
  py::class_<WrenchSet>(m, "Polytope", R"(A convex polytope of wrenches: normals @ f <= offsets.

A flat set also satisfies flat_normals @ f == flat_offsets. Only a set of status optimal has
vertices and faces.

>>> in_plane = numpy.eye(6)[:, :2]
>>> polytope = maxwrench.polytope("planar/force", [0, 0], directions=in_plane)
>>> bool(numpy.all(polytope.normals @ polytope.vertices.T <= polytope.offsets[:, None] + 1e-9))
True
)")
      .def_property_readonly(
          "status", [](const WrenchSet& s) { return to_string(s.status); },
          "optimal: complete and verified; infeasible: empty; unbounded; or why there is none.")
      .def_property_readonly(
          "reason", [](const WrenchSet& s) { return s.reason.str(); },
          "Why it is not complete; empty if it is.")
      .def_readonly("dimension", &WrenchSet::dimension, "Dimension of the affine hull, 0 to k.")
      .def_property_readonly(
          "vertices", [](const WrenchSet& s) { return copy(RowMatrix(s.vertices.transpose())); },
          "Vertices (V×k) [N or N m].")
      .def_property_readonly(
          "efforts", [](const WrenchSet& s) { return copy(RowMatrix(s.efforts.transpose())); },
          "Efforts that exert each vertex (V×m) [N or N m].")
      .def_property_readonly(
          "normals", [](const WrenchSet& s) { return copy(RowMatrix(s.normals.transpose())); },
          "Outward unit normals of the facets (F×k).")
      .def_property_readonly(
          "offsets", [](const WrenchSet& s) { return copy(s.offsets); },
          "Largest normal @ f of each facet (F).")
      .def_readonly("faces", &WrenchSet::faces,
                    "Vertices of each facet in order, as lists of indices (F).")
      .def_property_readonly("triangles", &triangles_of,
                             "Triangles of the surface (T×3), as indices of vertices.")
      .def_property_readonly(
          "flat_normals",
          [](const WrenchSet& s) { return copy(RowMatrix(s.flat_normals.transpose())); },
          "Directions in which the set is flat ((k - dimension)×k).")
      .def_property_readonly(
          "flat_offsets", [](const WrenchSet& s) { return copy(s.flat_offsets); },
          "Values of these directions on the set.")
      .def_property_readonly(
          "ray", [](const WrenchSet& s) { return copy(s.ray); },
          "Of an unbounded set: a direction without end (k).")
      .def_readonly("volume", &WrenchSet::volume, "Volume, area or length.")
      .def("__repr__",
           [](const WrenchSet& s) {
             return fmt::format("<Polytope: {}, {} vertices, {} facets, dimension {}>",
                                to_string(s.status), s.vertices.cols(), s.normals.cols(),
                                s.dimension);
           })
      .def(py::pickle(&polytope_state, &polytope_of));
  py::class_<WrenchEllipsoid>(m, "Ellipsoid", R"(An ellipsoid of wrenches.

It consists of the points centre + axes @ y with sum (y / radii)^2 <= 1.

>>> in_plane = numpy.eye(6)[:, :2]
>>> ellipsoid = maxwrench.ellipsoid("planar/force", [0, 0], directions=in_plane)
>>> ellipsoid.status, ellipsoid.axes.shape, bool(ellipsoid.radii[0] >= ellipsoid.radii[1])
('optimal', (2, 2), True)
)")
      .def_property_readonly(
          "status", [](const WrenchEllipsoid& e) { return to_string(e.status); },
          "optimal, infeasible: empty, unbounded, or why there is none.")
      .def_property_readonly(
          "reason", [](const WrenchEllipsoid& e) { return e.reason.str(); },
          "Why there is none; empty if there is one.")
      .def_property_readonly(
          "centre", [](const WrenchEllipsoid& e) { return copy(e.centre); },
          "Centre (k) [N or N m].")
      .def_property_readonly(
          "axes", [](const WrenchEllipsoid& e) { return copy(RowMatrix(e.axes)); },
          "Orthonormal principal axes as columns (k×k), longest first.")
      .def_property_readonly(
          "radii", [](const WrenchEllipsoid& e) { return copy(e.radii); },
          "Radius along each axis (k) [N or N m].")
      .def_readonly("volume", &WrenchEllipsoid::volume, "Volume, area or length.")
      .def("__repr__",
           [](const WrenchEllipsoid& e) {
             return fmt::format("<Ellipsoid: {}, dimension {}>", to_string(e.status),
                                e.radii.size());
           })
      .def(py::pickle(&ellipsoid_state, &ellipsoid_of));
  m.def("polytope", &polytope, py::arg("task"), py::arg("theta_r") = py::none(), py::kw_only(),
        py::arg("directions") = "force", py::arg("wrench") = "pure",
        py::arg("measure") = "linf_polytope", py::arg("solver") = "", kPolytope);
  m.def("ellipsoid", &ellipsoid, py::arg("task"), py::arg("theta_r") = py::none(), py::kw_only(),
        py::arg("directions") = "force", py::arg("wrench") = "pure", kEllipsoid);
}

}  // namespace maxwrench::python
