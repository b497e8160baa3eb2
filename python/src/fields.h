#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "maxwrench/explain.h"
#include "maxwrench/solve.h"
#include "maxwrench/status.h"
#include "python/src/arrays.h"

// Pickles of plain data. A function `fields(archive, object)` names the members of a class once; it
// writes them with a Packer and reads them with an Unpacker. It belongs to this namespace, or to
// that of its class.

namespace maxwrench::python {

template <class Archive>
void fields(Archive& archive, Verdict& verdict) {
  std::string reason = verdict.reason.str();
  archive(verdict.status, reason);
  verdict.reason = reason;
}

template <class Archive>
void fields(Archive& archive, Residual& r) {
  archive(r.balance, r.bounds, r.dual, r.gap);
}

template <class Archive>
void fields(Archive& archive, Case& c) {
  archive(c.problem, c.measure, c.wrench, c.solver, c.search, c.seed, c.budget, c.scheme);
}

template <class Archive>
void fields(Archive& archive, LimitRate& l) {
  archive(l.name, l.unit, l.side, l.limit, l.rate);
}

/// Writes members into a tuple.
class Packer {
 public:
  template <class... T>
  void operator()(T&... members) {
    (state_.append(packed(members)), ...);
  }
  /// Writes a text of any bytes.
  void bytes(const std::string& text) { state_.append(py::bytes(text)); }
  py::tuple state() const { return py::tuple(state_); }

 private:
  static py::object packed(Eigen::VectorXd& v) { return copy(v); }
  static py::object packed(Vector6d& v) { return copy(Eigen::VectorXd(v)); }
  static py::object packed(RowMatrix& m) { return copy(m); }
  static py::object packed(Eigen::MatrixXd& m) { return copy(RowMatrix(m)); }

  template <class T>
  static py::object packed(std::vector<T>& items) {
    py::list list;
    for (T& item : items) list.append(packed(item));
    return list;
  }

  template <class T>
  static py::object packed(std::optional<T>& item) {
    if (!item) return py::none();
    return packed(*item);
  }

  template <class T>
  static py::object packed(T& item) {
    if constexpr (std::is_enum_v<T>) {
      return py::int_(static_cast<int>(item));
    } else if constexpr (requires(Packer & p) { fields(p, item); }) {
      Packer parts;
      fields(parts, item);
      return parts.state();
    } else {
      return py::cast(item);
    }
  }

  py::list state_;
};

/// Reads members from the tuple that a Packer wrote.
class Unpacker {
 public:
  explicit Unpacker(py::tuple state) : state_(std::move(state)) {}

  template <class... T>
  void operator()(T&... members) {
    (read(next(), members), ...);
  }
  void bytes(std::string& text) { text = next().template cast<std::string>(); }

 private:
  py::object next() { return state_[at_++]; }

  static void read(const py::object& from, Eigen::VectorXd& v) { v = vector("state", from); }
  static void read(const py::object& from, Vector6d& v) { v = vector("state", from, 6); }
  static void read(const py::object& from, RowMatrix& m) { m = matrix("state", from); }
  static void read(const py::object& from, Eigen::MatrixXd& m) { m = matrix("state", from); }

  template <class T>
  static void read(const py::object& from, std::vector<T>& items) {
    items.clear();
    for (const py::handle& each : from) {
      read(py::reinterpret_borrow<py::object>(each), items.emplace_back());
    }
  }

  template <class T>
  static void read(const py::object& from, std::optional<T>& item) {
    item.reset();
    if (!from.is_none()) read(from, item.emplace());
  }

  template <class T>
  static void read(const py::object& from, T& item) {
    if constexpr (std::is_enum_v<T>) {
      item = static_cast<T>(from.cast<int>());
    } else if constexpr (requires(Unpacker & p) { fields(p, item); }) {
      Unpacker parts(from.cast<py::tuple>());
      fields(parts, item);
    } else {
      item = from.cast<T>();
    }
  }

  py::tuple state_;
  std::size_t at_ = 0;
};

/// What pickle stores of an object.
template <class T>
py::tuple pack(const T& object) {
  Packer packer;
  T copied = object;
  fields(packer, copied);
  return packer.state();
}

/// The object again.
template <class T>
T unpack(const py::tuple& state) {
  T object{};
  Unpacker unpacker(state);
  fields(unpacker, object);
  return object;
}

}  // namespace maxwrench::python
