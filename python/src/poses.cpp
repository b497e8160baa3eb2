#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cmath>

#include "problems/loader/urdf_tree.h"
#include "problems/make/bad_value.h"
#include "python/src/arrays.h"
#include "python/src/parts.h"
#include "solvers/solve/format.h"

namespace maxwrench::python {
namespace {

/// Three numbers; zeros for None.
Eigen::Vector3d three(std::string_view key, const py::object& value) {
  if (value.is_none()) return Eigen::Vector3d::Zero();
  return vector(key, value, 3);
}

/// A rotation from one of its forms; none of them: no rotation.
Eigen::Matrix3d rotation_of(const py::object& rpy, const py::object& R,
                            const py::object& quaternion) {
  if (int(!rpy.is_none()) + int(!R.is_none()) + int(!quaternion.is_none()) > 1) {
    throw BadValue("rotation", "several of rpy, R and quaternion", "one of them");
  }
  if (!R.is_none()) return matrix("R", R, 3, 3);
  if (!quaternion.is_none()) {
    const Eigen::Vector4d wxyz = vector("quaternion", quaternion, 4);
    const double length = wxyz.norm();
    if (!(std::abs(length - 1) < 1e-6)) {
      throw BadValue("quaternion", shown(Eigen::VectorXd(wxyz)), "w, x, y, z of length 1");
    }
    return Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).normalized().toRotationMatrix();
  }
  return pose_from_xyz_rpy({0, 0, 0}, three("rpy", rpy)).R;
}

Pose<double> make_pose(const py::object& p, const py::object& rpy, const py::object& R,
                       const py::object& quaternion) {
  Pose<double> pose;
  pose.p = three("p", p);
  pose.R = rotation_of(rpy, R, quaternion);
  require_pose("pose", pose);
  return pose;
}

Pose<double> from_matrix(const py::object& value) {
  const RowMatrix T = matrix("matrix", value, 4, 4);
  if (!(T.row(3) == Eigen::RowVector4d(0, 0, 0, 1))) {
    throw BadValue("matrix", "another last row", "a 4x4 matrix whose last row is 0 0 0 1");
  }
  Pose<double> pose{T.topLeftCorner<3, 3>(), T.topRightCorner<3, 1>()};
  require_pose("matrix", pose);
  return pose;
}

Eigen::VectorXd quaternion_of(const Pose<double>& pose) {
  const Eigen::Quaterniond q(pose.R);
  return Eigen::Vector4d(q.w(), q.x(), q.y(), q.z());
}

std::string repr_of_pose(const Pose<double>& pose) {
  const Eigen::Vector3d a = rpy(pose.R);
  return fmt::format("Pose([{:.6g}, {:.6g}, {:.6g}], rpy=[{:.6g}, {:.6g}, {:.6g}])", pose.p[0],
                     pose.p[1], pose.p[2], a[0], a[1], a[2]);
}

}  // namespace

RowMatrix matrix_of(const Pose<double>& pose) {
  RowMatrix T = RowMatrix::Identity(4, 4);
  T.topLeftCorner<3, 3>() = pose.R;
  T.topRightCorner<3, 1>() = pose.p;
  return T;
}

void add_poses(py::module_& m) {
  py::class_<Pose<double>>(m, "Pose", R"(A rigid transformation x -> R x + p.

Args:
    p: translation (3) [m].
    rpy: rotation as roll, pitch, yaw [rad]: R = Rz(yaw) Ry(pitch) Rx(roll).
    R: rotation as a matrix (3×3), instead of rpy.
    quaternion: rotation as w, x, y, z, of length 1, instead of rpy.

Raises:
    InputError: a value is not finite, R is not a rotation, or several rotations are given.

>>> maxwrench.Pose([0.5, 0, 0.3], rpy=[0, 0, 0])
Pose([0.5, 0, 0.3], rpy=[0, 0, 0])
)")
      .def(py::init(&make_pose), py::arg("p") = py::none(), py::kw_only(),
           py::arg("rpy") = py::none(), py::arg("R") = py::none(),
           py::arg("quaternion") = py::none())
      .def_static("from_matrix", &from_matrix, py::arg("matrix"),
                  "Returns the pose of a homogeneous matrix (4×4).")
      .def_property_readonly(
          "p", [](const Pose<double>& pose) { return copy(Eigen::VectorXd(pose.p)); },
          "Translation (3) [m].")
      .def_property_readonly(
          "R", [](const Pose<double>& pose) { return copy(RowMatrix(pose.R)); }, "Rotation (3×3).")
      .def_property_readonly(
          "rpy", [](const Pose<double>& pose) { return copy(Eigen::VectorXd(rpy(pose.R))); },
          "Roll, pitch, yaw (3) [rad], with R = Rz(yaw) Ry(pitch) Rx(roll).")
      .def_property_readonly(
          "quaternion", [](const Pose<double>& pose) { return copy(quaternion_of(pose)); },
          "The rotation as w, x, y, z (4).")
      .def_property_readonly(
          "matrix", [](const Pose<double>& pose) { return copy(matrix_of(pose)); },
          "Homogeneous matrix (4×4).")
      .def("inverse", &Pose<double>::inverse, "Returns the inverse transformation.")
      .def(
          "__mul__", [](const Pose<double>& a, const Pose<double>& b) { return a * b; },
          py::is_operator())
      .def(
          "__eq__",
          [](const Pose<double>& a, const Pose<double>& b) { return a.R == b.R && a.p == b.p; },
          py::is_operator())
      .def("__repr__", &repr_of_pose)
      .def(
          py::pickle([](const Pose<double>& pose) { return py::make_tuple(copy(matrix_of(pose))); },
                     [](const py::tuple& state) { return from_matrix(state[0]); }));
}

}  // namespace maxwrench::python
