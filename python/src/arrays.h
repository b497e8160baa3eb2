#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <string_view>

#include "maxwrench/types.h"

// NumPy arrays to and from Eigen. Arrays are float64 and C-contiguous; a view of what an object
// holds is read-only.

namespace maxwrench::python {

namespace py = pybind11;

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The numbers of an array or of nested lists. Throws std::invalid_argument, which names the key,
/// for anything else, such as text or complex numbers.
Array numbers(std::string_view key, const py::object& value);
/// The same of an array that `numbers` returned.
Eigen::VectorXd vector(std::string_view key, const Array& array, Eigen::Index size);
RowMatrix matrix(std::string_view key, const Array& array, Eigen::Index rows, Eigen::Index cols);
/// The same of `size` numbers in one dimension; -1: any size.
Eigen::VectorXd vector(std::string_view key, const py::object& value, Eigen::Index size = -1);
/// The same in two dimensions; -1: any size.
RowMatrix matrix(std::string_view key, const py::object& value, Eigen::Index rows = -1,
                 Eigen::Index cols = -1);
/// Throws std::invalid_argument unless all numbers are finite.
void require_all_finite(std::string_view key, const Eigen::Ref<const RowMatrix>& values);

/// Throws std::invalid_argument if a bound is NaN, leaves no number (lower = infinity, upper =
/// -infinity), or if lower exceeds upper by more than `most_crossed`.
void require_bounds(std::string_view lower_key, const Eigen::VectorXd& lower,
                    std::string_view upper_key, const Eigen::VectorXd& upper, double most_crossed);

/// "(3, 6)"
std::string shape_of(const Array& array);

/// A read-only view of numbers that `owner` keeps alive.
py::array view(const double* data, const std::vector<py::ssize_t>& shape, const py::object& owner);
py::array view(const Eigen::VectorXd& v, const py::object& owner);
/// A copy, which the caller may change.
py::array copy(const Eigen::VectorXd& v);
py::array copy(const RowMatrix& m);

}  // namespace maxwrench::python
