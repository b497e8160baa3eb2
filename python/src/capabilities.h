#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

#include "maxwrench/capability.h"
#include "maxwrench/zonotope.h"
#include "python/src/arrays.h"

// What `capability` and `scale` share: their actuators and their results.

namespace maxwrench::python {

/// B and the limits of u, with their facets.
using SharedZonotope = std::shared_ptr<const Zonotope>;

/// B of an argument; None: one direct drive for each of n joints. Those of the last calls are kept.
SharedZonotope actuators_in(const py::object& B, const py::object& lower, const py::object& upper,
                            Eigen::Index n);

/// The results of many programs, with the shape of the leading axes.
struct Capabilities {
  std::vector<py::ssize_t> shape;
  std::vector<Status> status;
  std::vector<std::string> reason;
  Eigen::VectorXd beta;
  RowMatrix h, u, lambda;

  Capabilities() = default;
  /// No results yet, of programs with m efforts and n joints.
  Capabilities(std::vector<py::ssize_t> leading, Eigen::Index m, Eigen::Index n);
  /// The result of program i. It has a value only if it satisfies its program.
  void store(Eigen::Index i, const Capability& capability);
};

}  // namespace maxwrench::python
