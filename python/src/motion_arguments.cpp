#include "problems/make/bad_value.h"
#include "python/src/parts.h"
#include "python/src/words.h"

// What a task in time has in place of one wrench along c.

namespace maxwrench::python {

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
