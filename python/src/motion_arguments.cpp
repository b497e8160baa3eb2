#include "problems/make/bad_value.h"
#include "python/src/parts.h"
#include "python/src/words.h"

// What a task in time has in place of one wrench along c.

namespace maxwrench::python {

void read_wrench_in_time(py::dict& arguments, TaskSpec& spec) {
  const py::object none = py::none();
  const py::object payload = arguments.attr("pop")("payload", none);
  if (!payload.is_none()) {
    py::dict tables;
    tables["payload"] = payload;
    read_scenario_arguments({}, tables, spec);
  }
  const bool needs_c = payload.is_none() && !arguments.contains("wrenches");
  const py::object c = arguments.attr("pop")("c", needs_c ? py::object(py::str("z")) : none);
  if (!c.is_none()) spec.c = direction_in("c", c);
}

std::optional<WrenchTable> wrenches_in(py::dict& arguments) {
  const py::object given = arguments.attr("pop")("wrenches", py::none());
  if (given.is_none()) return std::nullopt;
  const Eigen::MatrixXd rows = matrix("wrenches", py::array(given), -1, 7);
  WrenchTable table;
  for (const double t : rows.col(0)) table.t.push_back(t);
  table.wrenches = rows.rightCols<6>().transpose();
  return table;
}

}  // namespace maxwrench::python
