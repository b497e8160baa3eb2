#include <fmt/format.h>
#include <pybind11/stl.h>

#include <limits>

#include "maxwrench/figures.h"
#include "maxwrench/map.h"
#include "problems/make/bad_value.h"
#include "python/src/arrays.h"
#include "python/src/background.h"
#include "python/src/fields.h"
#include "python/src/parts.h"
#include "python/src/words.h"

namespace maxwrench::python {

template <class Archive>
void fields(Archive& archive, MapAxis& a) {
  archive(a.name, a.low, a.high, a.count);
}

template <class Archive>
void fields(Archive& archive, MapPlan& p) {
  archive(p.over, p.refine, p.tolerance, p.check, p.check_budget, p.bound, p.gap, p.seconds,
          p.shard, p.shards);
}

template <class Archive>
void fields(Archive& archive, MapCell& c) {
  archive(static_cast<Verdict&>(c), c.index, c.at, c.level, c.beta, c.unit, c.theta_r, c.q, c.base,
          c.evaluations, c.bound, c.scratch);
}

namespace {

/// A map, as Python holds it.
struct PyMap {
  CapabilityMap map;
  PyTask task;
};

template <class Archive>
void fields(Archive& archive, PyMap& self) {
  CapabilityMap& m = self.map;
  archive(self.task, static_cast<Verdict&>(m), m.choice, m.plan, m.unit, m.cells, m.unchanging,
          m.computed, m.wall_s);
  m.task = self.task.problem;
}

MapAxis axis_in(const std::string& name, const py::handle& value) {
  const std::string key = "over." + name;
  const Eigen::VectorXd numbers = vector(key, py::reinterpret_borrow<py::object>(value), 3);
  if (!(numbers[2] == std::floor(numbers[2])) || std::abs(numbers[2]) > 1e15) {
    throw BadValue(key, shown(numbers), "(low, high, count) with a whole count");
  }
  return {name, numbers[0], numbers[1], static_cast<long>(numbers[2])};
}

std::vector<MapAxis> axes_in(const py::object& over) {
  if (!py::isinstance<py::dict>(over)) {
    throw BadValue("over", std::string(py::str(over.get_type().attr("__name__"))),
                   "a dict such as {'x': (-0.2, 0.2, 9)}");
  }
  std::vector<MapAxis> axes;
  for (const auto& [name, value] : over.cast<py::dict>()) {
    axes.push_back(axis_in(std::string(py::str(name)), value));
  }
  return axes;
}

PyMap make_map(const py::object& task, const py::object& over, int refine, double tolerance,
               double check, long check_budget, bool certify, double gap, double seconds,
               const std::string& measure, const std::string& wrench, const std::string& solver,
               const std::string& search, std::uint64_t seed, long budget, int threads,
               const py::object& callback) {
  PyMap result{{}, task_of(task)};
  const Problem& problem = *result.task.problem;
  MapPlan plan;
  plan.over = axes_in(over);
  plan.refine = refine;
  plan.tolerance = tolerance;
  plan.check = check;
  plan.check_budget = check_budget;
  plan.bound = certify;
  plan.gap = gap;
  plan.seconds = seconds;
  Options options;
  options.measure = measure;
  options.wrench = parse_wrench(wrench);
  options.solver = solver;
  options.search = search;
  options.seed = seed;
  options.budget = budget;
  options.threads = threads;
  double cells = 1;
  for (const MapAxis& axis : plan.over) cells *= static_cast<double>(axis.count);
  const Callback shown_line(callback, cells < 1e9 ? static_cast<long>(cells) : 0, problem.name);
  run_in_background(shown_line.function(), [&](Watch& watch) {
    plan.progress = [&watch](long finished, long) { watch.evaluations = finished; };
    options.interrupted = [&watch] { return watch.stop.load(); };
    result.map = map(problem, plan, options);
  });
  result.map.plan.progress = nullptr;
  return result;
}

/// A row for each cell; NaN where it has none.
template <class Row>
py::array rows_of_cells(const PyMap& self, Eigen::Index width, const Row& row) {
  RowMatrix all = RowMatrix::Constant(static_cast<Eigen::Index>(self.map.cells.size()), width,
                                      std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < self.map.cells.size(); ++i) {
    const Eigen::VectorXd& v = row(self.map.cells[i]);
    if (v.size() == width) all.row(static_cast<Eigen::Index>(i)) = v.transpose();
  }
  return copy(all);
}

template <class Number>
py::array numbers_of_cells(const PyMap& self, const Number& number) {
  Eigen::VectorXd all(static_cast<Eigen::Index>(self.map.cells.size()));
  for (std::size_t i = 0; i < self.map.cells.size(); ++i) {
    all[static_cast<Eigen::Index>(i)] = number(self.map.cells[i]);
  }
  return copy(all);
}

py::array indices(const PyMap& self) {
  return rows_of_cells(self, static_cast<Eigen::Index>(self.map.plan.over.size()),
                       [](const MapCell& cell) {
                         Eigen::VectorXd index(static_cast<Eigen::Index>(cell.index.size()));
                         for (Eigen::Index a = 0; a < index.size(); ++a) {
                           index[a] = static_cast<double>(cell.index[static_cast<std::size_t>(a)]);
                         }
                         return index;
                       });
}

py::dict over_of(const PyMap& self) {
  py::dict over;
  for (const MapAxis& axis : self.map.plan.over) {
    over[py::str(axis.name)] = py::make_tuple(axis.low, axis.high, axis.count);
  }
  return over;
}

std::vector<const char*> statuses(const PyMap& self) {
  std::vector<const char*> names;
  for (const MapCell& cell : self.map.cells) names.push_back(to_string(cell.status));
  return names;
}

std::string repr_of_map(const PyMap& self) {
  const MapCell* best = self.map.best();
  return fmt::format(
      "<Map of {}: {} cells, {}>", self.map.task->name, self.map.cells.size(),
      best ? fmt::format("at most {:.6g} {}", best->beta, self.map.unit) : std::string("no value"));
}

constexpr const char* kMap =
    R"(Computes the best value over a grid of poses, directions and parameters.

Each cell is a task of its own; its value is that of the best posture that the search finds. Cells
after the first level begin at the postures of their neighbours. The map is the same at any number
of threads.

Args:
    task: a static Task, or the name of one.
    over: the coordinates, such as ``{"x": (-0.2, 0.2, 9)}``: low, high and the number of values.
        They are x, y, z [m], roll, pitch, yaw [rad], offsets along and about the axes of the task's
        pose; azimuth, elevation, the direction of c [rad]; wrench, the number of one of several;
        thrust, torque or the name of an actuator, a factor of its limits; environment.gravity,
        environment.water_density, environment.current.x (.y, .z), trim.buoyancy_mass,
        links.NAME.mass, in SI units, in place of the robot's; payload.mass, carried in addition;
        wrench.ball.radius, uncertainty.trim, uncertainty.mass.NAME, uncertainty.volume.NAME,
        uncertainty.payload.mass, in place of the task's.
    refine: how often cells of the grid are halved whose corners differ.
    tolerance: the difference of corners, as a share of the largest, above which they do.
    check: share of the cells that a search from scratch checks; see ``scratch``.
    check_budget: evaluations of such a search; 0: it is restarted until another optimum is unlikely.
    certify: whether to prove a bound in each cell, to ``gap`` within ``seconds``.
    gap: the gap at which such a proof is complete, relative to its value.
    seconds: the time after which such a proof ends [s].
    measure, wrench, solver, search, seed, budget, threads: as of ``solve``, for each cell. The
        budget counts in the first level, the default is 3000; later levels have a fifth of it.
    callback: gets the number of finished cells. If it returns True, or on Ctrl-C, the map has the
        cells that were finished.

Returns:
    Map: the cells, as arrays.

Raises:
    InputError: a coordinate does not exist or does not suit the task, limits are not in order, the
        grid has more than a million values, or as ``solve``.

>>> reach = maxwrench.map("planar/force", {"azimuth": (0, 6, 5)}, budget=100)
>>> reach.grid.shape
(5,)
>>> reach.beta.max() == reach.best["beta"]
True
)";

}  // namespace

void add_maps(py::module_& m) {
  py::class_<PyMap>(m, "Map",
                    R"(The best values over a grid, from ``map``. N cells of d coordinates.

>>> reach = maxwrench.map("planar/force", {"azimuth": (0, 6, 3)}, budget=100)
>>> reach.beta.shape, reach.task.name
((3,), 'planar/force')
)")
      .def_property_readonly(
          "task", [](const PyMap& self) { return self.task; }, "The Task.")
      .def_property_readonly("over", over_of, "The coordinates: low, high, number of values.")
      .def_property_readonly(
          "refine", [](const PyMap& self) { return self.map.plan.refine; },
          "How often cells of the grid may be halved.")
      .def_property_readonly(
          "unit", [](const PyMap& self) { return self.map.unit; }, "The unit of the values.")
      .def_property_readonly(
          "status", [](const PyMap& self) { return to_string(self.map.status); },
          "\"best_found\", \"none_found\", or \"budget_exhausted\" if it was interrupted.")
      .def_property_readonly("statuses", statuses,
                             "The status of each cell: \"best_found\" or \"none_found\" (N).")
      .def_property_readonly("index", indices,
                             "The place of each cell on the finest grid (N, d), whole numbers.")
      .def_property_readonly(
          "at",
          [](const PyMap& self) {
            return rows_of_cells(self, static_cast<Eigen::Index>(self.map.plan.over.size()),
                                 [](const MapCell& cell) { return cell.at; });
          },
          "The coordinates of each cell (N, d) [m or rad].")
      .def_property_readonly(
          "beta",
          [](const PyMap& self) {
            return numbers_of_cells(self, [](const MapCell& cell) {
              return cell.status == Status::kBestFound ? cell.beta
                                                       : std::numeric_limits<double>::quiet_NaN();
            });
          },
          "The values (N) [unit]; NaN: none was found.")
      .def_property_readonly(
          "bound",
          [](const PyMap& self) {
            return numbers_of_cells(self, [](const MapCell& cell) { return cell.bound; });
          },
          "No posture of a cell has a larger value (N) [unit]; infinity: not known.")
      .def_property_readonly(
          "scratch",
          [](const PyMap& self) {
            return numbers_of_cells(self, [](const MapCell& cell) {
              return cell.scratch.value_or(std::numeric_limits<double>::quiet_NaN());
            });
          },
          "What a search from scratch found (N) [unit]; NaN: none was made, -infinity: nothing.")
      .def_property_readonly(
          "level",
          [](const PyMap& self) {
            return numbers_of_cells(
                self, [](const MapCell& cell) { return static_cast<double>(cell.level); });
          },
          "The level of each cell (N), whole numbers from 0.")
      .def_property_readonly(
          "theta_r",
          [](const PyMap& self) {
            return rows_of_cells(self, self.map.task->redundancy(),
                                 [](const MapCell& cell) { return cell.theta_r; });
          },
          "The best postures (N, r) [rad or m]; NaN: none.")
      .def_property_readonly(
          "q",
          [](const PyMap& self) {
            return rows_of_cells(self,
                                 static_cast<Eigen::Index>(self.map.task->robot.joints.size()),
                                 [](const MapCell& cell) { return cell.q; });
          },
          "All their joints (N, J) [rad or m]; NaN: none.")
      .def_property_readonly(
          "base",
          [](const PyMap& self) {
            return rows_of_cells(self, 6, [](const MapCell& cell) { return cell.base; });
          },
          "Their bases in the world: x, y, z, roll, pitch, yaw (N, 6) [m; rad]; NaN: none.")
      .def_property_readonly(
          "checked", [](const PyMap& self) { return self.map.checked(); },
          "The number of cells that a search from scratch has checked.")
      .def_property_readonly(
          "improved", [](const PyMap& self) { return self.map.improved(); },
          "The number of these that it improves by more than 0.1 %.")
      .def_property_readonly(
          "proven", [](const PyMap& self) { return self.map.proven(); },
          "The number of cells whose bound is within ``gap`` of their value.")
      .def_property_readonly(
          "unchanging", [](const PyMap& self) { return self.map.unchanging; },
          "The coordinates without effect on any sampled posture.")
      .def(
          "figure", [](const PyMap& self) { return map_figure(self.map); },
          "Returns the SVG that the command draws.")
      .def(
          "summary", [](const PyMap& self) { return summary(self.map); },
          "Returns the text that the command prints.")
      .def(
          "to_dict",
          [](const PyMap& self) {
            return py::module_::import("json").attr("loads")(to_json(self.map));
          },
          "Returns the JSON object that the command prints, as a dict.")
      .def("__str__", [](const PyMap& self) { return summary(self.map); })
      .def("__len__", [](const PyMap& self) { return self.map.cells.size(); })
      .def("__repr__", repr_of_map)
      .def(py::pickle(&pack<PyMap>, &unpack<PyMap>));
  m.def("map", &make_map, py::arg("task"), py::arg("over"), py::kw_only(), py::arg("refine") = 0,
        py::arg("tolerance") = MapPlan().tolerance, py::arg("check") = 0.0,
        py::arg("check_budget") = 0, py::arg("certify") = false, py::arg("gap") = MapPlan().gap,
        py::arg("seconds") = MapPlan().seconds, py::arg("measure") = Case().measure,
        py::arg("wrench") = "pure", py::arg("solver") = "", py::arg("search") = "",
        py::arg("seed") = 1, py::arg("budget") = 0, py::arg("threads") = 0,
        py::arg("callback") = py::none(), kMap);
}

}  // namespace maxwrench::python
