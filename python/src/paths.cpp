#include <fmt/format.h>
#include <pybind11/stl.h>

#include "problems/make/bad_value.h"
#include "python/src/arrays.h"
#include "python/src/parts.h"

namespace maxwrench::python {
namespace {

Timing timing_of(const std::string& name) {
  if (name == "cubic") return Timing::kCubic;
  if (name == "quintic") return Timing::kQuintic;
  if (name == "linear") return Timing::kLinear;
  throw BadValue("timing", shown(name), "cubic, quintic or linear");
}

PyPath spline_path(const py::object& times, const std::vector<Pose<double>>& poses) {
  const Eigen::VectorXd t = vector("times", times);
  require_all_finite("times", t);
  py::dict how;
  how["times"] = copy(t);
  how["poses"] = poses;
  return {Path::spline({t.begin(), t.end()}, poses), {"Path.spline", how}};
}

PyPath screw_path(const Pose<double>& start, double duration, const py::object& axis,
                  const py::object& centre, double angle, const py::object& displacement,
                  const std::string& timing) {
  require_finite("duration", duration);
  require_positive("duration", duration);
  require_finite("angle", angle);
  const Eigen::Vector3d a = direction_of("axis", vector("axis", axis, 3));
  const Eigen::Vector3d c =
      centre.is_none() ? start.p : Eigen::Vector3d(vector("centre", centre, 3));
  const Eigen::Vector3d d = displacement.is_none()
                                ? Eigen::Vector3d(Eigen::Vector3d::Zero())
                                : Eigen::Vector3d(vector("displacement", displacement, 3));
  require_all_finite("centre", c);
  require_all_finite("displacement", d);
  py::dict how;
  how["start"] = start;
  how["duration"] = duration;
  how["axis"] = copy(Eigen::VectorXd(a));
  how["centre"] = copy(Eigen::VectorXd(c));
  how["angle"] = angle;
  how["displacement"] = copy(Eigen::VectorXd(d));
  how["timing"] = timing;
  return {Path::screw(start, a, c, angle, d, timing_of(timing), duration), {"Path.screw", how}};
}

}  // namespace

void add_paths(py::module_& m) {
  py::class_<PyPath>(m, "Path", R"(The poses of an end effector over time.

>>> start = maxwrench.Pose([0.5, 0, 0.3])
>>> maxwrench.Path.screw(start, 2.0, displacement=[0.1, 0, 0]).at(2.0).p
array([0.6, 0. , 0.3])
)")
      .def_static("spline", &spline_path, py::arg("times"), py::arg("poses"),
                  R"(Makes a path through given poses, at rest at both ends.

Args:
    times: at least two times that increase from 0 [s].
    poses: one Pose for each time, each rotated by less than pi from the previous one.

Raises:
    InputError: otherwise.
)")
      .def_static("screw", &screw_path, py::arg("start"), py::arg("duration"), py::kw_only(),
                  py::arg("axis") = py::make_tuple(0, 0, 1), py::arg("centre") = py::none(),
                  py::arg("angle") = 0.0, py::arg("displacement") = py::none(),
                  py::arg("timing") = "cubic",
                  R"(Makes a path that rotates about an axis and translates.

Args:
    start: the Pose at t = 0.
    duration: the duration [s].
    axis: the axis of the rotation in the world (3), of any length.
    centre: a point on the axis (3) [m]; the end effector's origin if not given.
    angle: the rotation [rad].
    displacement: the translation (3) [m].
    timing: progress along the path: "cubic" (at rest at both ends), "quintic" (and without
        acceleration) or "linear".
)")
      .def_property_readonly(
          "duration", [](const PyPath& p) { return p.path.duration(); }, "The duration [s].")
      .def(
          "at",
          [](const PyPath& p, double t) {
            require_finite("t", t);
            return p.path.pose(t);
          },
          py::arg("t"), "Returns the Pose at the time t [s].")
      .def("__repr__",
           [](const PyPath& p) { return fmt::format("<Path of {:g} s>", p.path.duration()); })
      .def("__reduce__", [](const PyPath& p) { return reduced(p.recipe); });
}

}  // namespace maxwrench::python
