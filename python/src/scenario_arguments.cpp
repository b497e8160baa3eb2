#include <toml++/toml.h>

#include "problems/loader/bad_input.h"
#include "problems/loader/scenario_tables.h"
#include "python/src/parts.h"
#include "python/src/words.h"

// Dicts become tables of a task file, which the loader reads, so keys and errors are the same.

namespace maxwrench::python {
namespace {

constexpr int kMostLevels = 8;

toml::table table_of(const std::string& start, const py::dict& values, int level);
toml::array array_of(const std::string& key, const py::object& values, int level);

/// Gives a value of Python to `add` as one of TOML. NumPy's arrays and numbers are lists and
/// numbers.
template <class Add>
void add_value(const std::string& key, const py::object& value, int level, const Add& add) {
  constexpr const char* kExpected = "a number, a text, True, False, or lists or dicts of them";
  if (level > kMostLevels) throw BadValue(key, "lists in lists", kExpected);
  PyObject* const of = value.ptr();
  if (py::hasattr(value, "tolist")) {
    add_value(key, value.attr("tolist")(), level + 1, add);
  } else if (PyDict_Check(of)) {
    add(table_of(key + ".", value.cast<py::dict>(), level + 1));
  } else if (PyList_Check(of) || PyTuple_Check(of)) {
    add(array_of(key, value, level + 1));
  } else if (PyUnicode_Check(of)) {
    add(text_in(key, value));
  } else if (PyBool_Check(of)) {
    add(flag_in(key, value));
  } else if (PyLong_Check(of) || PyFloat_Check(of)) {
    add(number_in(key, value));
  } else {
    throw BadValue(key, std::string(py::repr(value)), kExpected);
  }
}

/// The table whose keys have the given start in messages.
toml::table table_of(const std::string& start, const py::dict& values, int level) {
  toml::table table;
  for (const auto& [key, value] : values) {
    const std::string name = text_in(start + "keys", py::reinterpret_borrow<py::object>(key));
    add_value(start + name, py::reinterpret_borrow<py::object>(value), level,
              [&](auto entry) { table.insert_or_assign(name, std::move(entry)); });
  }
  return table;
}

toml::array array_of(const std::string& key, const py::object& values, int level) {
  toml::array array;
  for (const py::handle value : values) {
    add_value(key, py::reinterpret_borrow<py::object>(value), level,
              [&array](auto entry) { array.push_back(std::move(entry)); });
  }
  return array;
}

/// A ball that is given as (axes, radius), as the dict of both.
py::object ball_in(const py::object& ball) {
  if (!py::isinstance<py::tuple>(ball) && !py::isinstance<py::list>(ball)) return ball;
  if (py::len(ball) != 2) {
    throw BadValue("wrench.ball", std::string(py::repr(ball)), "(axes, radius), or a dict");
  }
  py::list axes;
  for (const std::string& axis : names_in("wrench.ball.axes", ball[py::int_(0)])) axes.append(axis);
  py::dict named;
  named["axes"] = axes;
  named["radius"] = ball[py::int_(1)];
  return named;
}

}  // namespace

void read_scenario_arguments(const py::dict& wrench, const py::dict& tables, TaskSpec& spec) {
  py::dict all = tables.attr("copy")(), asked = wrench.attr("copy")();
  if (asked.contains("ball")) asked["ball"] = ball_in(asked["ball"]);
  if (!asked.empty()) all["wrench"] = asked;
  const Block block = Block::of(table_of("", all, 0));
  try {
    read_scenario_tables(block, spec);
    if (!asked.empty()) read_wrenches(block.table("wrench"), spec);
  } catch (const BadInput& bad) {
    throw BadValue(bad.value());  // there is no file
  }
}

}  // namespace maxwrench::python
