#pragma once

#include <fmt/format.h>
#include <pybind11/pybind11.h>

#include <string>
#include <string_view>
#include <vector>

#include "maxwrench/types.h"
#include "problems/make/bad_value.h"
#include "python/src/arrays.h"
#include "python/src/words.h"

// The parts of robots and contacts that are made in code: the classes of maxwrench/_parts.py, which
// hold values of any type.

namespace maxwrench::python {

/// The values of a part.
class Part {
 public:
  /// Rejects objects of another class.
  Part(std::string_view key, const py::handle& object, const char* type)
      : object_(py::reinterpret_borrow<py::object>(object)) {
    if (py::isinstance(object, py::module_::import("maxwrench._parts").attr(type))) return;
    throw BadValue(key, std::string(py::repr(object)), fmt::format("a maxwrench.{}", type));
  }

  py::object get(const char* name) const { return object_.attr(name); }
  bool has(const char* name) const { return !get(name).is_none(); }
  std::string text(const std::string& key, const char* name) const {
    return text_in(key, get(name));
  }
  double number(const std::string& key, const char* name) const {
    return number_in(key, get(name));
  }
  Eigen::VectorXd numbers(const std::string& key, const char* name, Eigen::Index size = -1) const {
    return vector(key, get(name), size);
  }
  Pose<double> pose(const std::string& key, const char* name) const {
    if (py::isinstance<Pose<double>>(get(name))) return get(name).cast<Pose<double>>();
    throw BadValue(key, std::string(py::repr(get(name))), "a maxwrench.Pose");
  }

 private:
  py::object object_;
};

/// The items of a list or tuple, or BadValue with what was `expected`.
inline py::list items_in(std::string_view key, const py::object& value, const char* expected) {
  const bool is_list = py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value);
  if (!is_list) throw BadValue(key, std::string(py::repr(value)), expected);
  return py::list(value);
}

/// The parts of a list, each made by `make` of its key and the object.
template <class Item, class Make>
std::vector<Item> parts_in(const std::string& key, const py::object& value, const char* expected,
                           const Make& make) {
  std::vector<Item> items;
  for (const py::handle& each : items_in(key, value, expected)) {
    items.push_back(make(fmt::format("{}[{}]", key, items.size()), each));
  }
  return items;
}

}  // namespace maxwrench::python
