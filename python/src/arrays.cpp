#include "python/src/arrays.h"

#include <string>

#include "problems/make/bad_value.h"

namespace maxwrench::python {
namespace {

std::string dimensions(const std::vector<Eigen::Index>& sizes) {
  std::string text = "(";
  for (const Eigen::Index size : sizes) {
    if (text.size() > 1) text += ", ";
    text += size < 0 ? "any" : std::to_string(size);
  }
  return text + (sizes.size() == 1 ? ",)" : ")");
}

void require_shape(std::string_view key, const Array& array,
                   const std::vector<Eigen::Index>& sizes) {
  bool fits = array.ndim() == static_cast<py::ssize_t>(sizes.size());
  for (std::size_t i = 0; fits && i < sizes.size(); ++i) {
    fits = sizes[i] < 0 || array.shape(static_cast<py::ssize_t>(i)) == sizes[i];
  }
  if (!fits) {
    throw BadValue(key, "shape " + shape_of(array), "an array of shape " + dimensions(sizes));
  }
}

/// Whether it is a masked array of NumPy, some numbers of which do not count.
bool has_masked(const py::object& value) {
  // Only subclasses of arrays are asked: the others are the usual case.
  const PyTypeObject* plain = py::detail::npy_api::get().PyArray_Type_;
  if (!py::isinstance<py::array>(value) || Py_TYPE(value.ptr()) == plain) return false;
  return py::bool_(py::module_::import("numpy.ma").attr("is_masked")(value));
}

/// The array of any object; null if NumPy makes none of it. Unlike py::array::ensure it lets Ctrl-C
/// pass.
py::array array_of(const py::object& value) {
  const auto& api = py::detail::npy_api::get();
  auto array = py::reinterpret_steal<py::array>(api.PyArray_FromAny_(
      value.ptr(), nullptr, 0, 0, py::detail::npy_api::NPY_ARRAY_ENSUREARRAY_, nullptr));
  if (array) return array;
  if (PyErr_ExceptionMatches(PyExc_Exception) == 0) throw py::error_already_set();
  PyErr_Clear();
  return array;
}

}  // namespace

std::string shape_of(const Array& array) {
  std::vector<Eigen::Index> sizes(array.shape(), array.shape() + array.ndim());
  return dimensions(sizes);
}

Array numbers(std::string_view key, const py::object& value) {
  if (value.is_none()) throw BadValue(key, "None", "an array of numbers");
  const auto reject = [&](const std::string& got) {
    throw BadValue(key, got, "an array of real numbers");
  };
  if (has_masked(value)) {
    throw BadValue(key, "a masked array", "an array without masked numbers");
  }
  const py::array any = array_of(value);
  if (!any) reject("a " + std::string(py::str(py::type::of(value).attr("__name__"))));
  const char kind = any.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u') {
    reject("dtype " + std::string(py::str(any.dtype())));
  }
  return Array(any);
}

Eigen::VectorXd vector(std::string_view key, const py::object& value, Eigen::Index size) {
  return vector(key, numbers(key, value), size);
}

Eigen::VectorXd vector(std::string_view key, const Array& array, Eigen::Index size) {
  require_shape(key, array, {size});
  return Eigen::Map<const Eigen::VectorXd>(array.data(), array.size());
}

RowMatrix matrix(std::string_view key, const py::object& value, Eigen::Index rows,
                 Eigen::Index cols) {
  return matrix(key, numbers(key, value), rows, cols);
}

RowMatrix matrix(std::string_view key, const Array& array, Eigen::Index rows, Eigen::Index cols) {
  require_shape(key, array, {rows, cols});
  return Eigen::Map<const RowMatrix>(array.data(), array.shape(0), array.shape(1));
}

void require_all_finite(std::string_view key, const Eigen::Ref<const RowMatrix>& values) {
  if (!values.allFinite()) throw BadValue(key, "a NaN or an infinity", "finite numbers");
}

void require_bounds(std::string_view lower_key, const Eigen::VectorXd& lower,
                    std::string_view upper_key, const Eigen::VectorXd& upper, double most_crossed) {
  for (Eigen::Index i = 0; i < lower.size(); ++i) {
    if (!(lower[i] < kInfinity)) throw BadValue(lower_key, shown(lower[i]), "a lower bound");
    if (!(upper[i] > -kInfinity)) throw BadValue(upper_key, shown(upper[i]), "an upper bound");
    if (lower[i] > upper[i] && lower[i] - upper[i] > most_crossed) {
      throw BadValue(lower_key, shown(lower[i]),
                     "at most " + std::string(upper_key) + ", which is " + shown(upper[i]));
    }
  }
}

py::array view(const double* data, const std::vector<py::ssize_t>& shape, const py::object& owner) {
  py::array_t<double> array(shape, data, owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

py::array view(const Eigen::VectorXd& v, const py::object& owner) {
  return view(v.data(), {v.size()}, owner);
}

py::array copy(const Eigen::VectorXd& v) { return py::array_t<double>(v.size(), v.data()); }

py::array copy(const RowMatrix& m) {
  return py::array_t<double>(std::vector<py::ssize_t>{m.rows(), m.cols()}, m.data());
}

}  // namespace maxwrench::python
