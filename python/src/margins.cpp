#include "python/src/margins.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "maxwrench/figures.h"
#include "maxwrench/margin.h"
#include "maxwrench/motion_table.h"
#include "problems/make/bad_value.h"
#include "python/src/arrays.h"
#include "python/src/background.h"
#include "python/src/fields.h"
#include "python/src/parts.h"
#include "python/src/words.h"

namespace maxwrench::python {

template <class Archive>
void fields(Archive& archive, InstantMargin& m) {
  archive(static_cast<Verdict&>(m), m.t, m.margin, m.worst, m.facet, m.limits, m.binding, m.u,
          m.by_program);
}

template <class Archive>
void fields(Archive& archive, MotionMargin& m) {
  archive(static_cast<Verdict&>(m), m.problem, m.set, m.unit, m.instants, m.worst, m.infeasible,
          m.residual, m.difference, m.wall_s, m.checks_s);
}

namespace {

/// The table of a dict of columns.
MotionTable table_in(const py::dict& columns, int instants_per_interval) {
  std::vector<std::string> names;
  RowMatrix numbers;
  for (const auto& [key, value] : columns) {
    names.push_back(py::str(key));
    const Eigen::VectorXd column =
        vector("motion[" + names.back() + "]", py::reinterpret_borrow<py::object>(value),
               names.size() == 1 ? -1 : numbers.rows());
    numbers.conservativeResize(column.size(), static_cast<Eigen::Index>(names.size()));
    numbers.rightCols<1>() = column;
  }
  MotionTable table = make_motion_table(names, numbers);
  table.instants_per_interval = instants_per_interval;
  return table;
}

std::vector<Instant> instants_in(const Problem& problem, const py::object& motion, int each) {
  if (py::isinstance<PyAnswer>(motion)) {
    const Answer& answer = motion.cast<const PyAnswer&>().answer;
    if (!answer.task || answer.trajectory.instants.empty()) {
      throw BadValue("motion", "an answer without a trajectory", "one of a task in time");
    }
    return answer.trajectory.instants;
  }
  if (py::isinstance<py::dict>(motion)) {
    return motion_instants(problem, table_in(motion.cast<py::dict>(), each));
  }
  const bool path = py::isinstance<py::str>(motion) || py::hasattr(motion, "__fspath__");
  if (!path) {
    throw BadValue("motion", py::repr(motion).cast<std::string>(),
                   "a dict of columns, a CSV file or an Answer");
  }
  return load_motion(py::module_::import("os").attr("fspath")(motion).cast<std::string>(), problem,
                     each);
}

MotionMargin compute_margin(const py::object& task, const py::object& motion,
                            const py::object& ball, const std::string& ball_frame, bool task_wrench,
                            int instants_per_interval) {
  const PyTask of = task_of(task);
  MarginSet set;
  set.of_task = task_wrench;
  if (ball_frame != "world" && ball_frame != "end_effector") {
    throw BadValue("ball_frame", shown(ball_frame), "world or end_effector");
  }
  if (task_wrench && (!ball.is_none() || ball_frame != "world")) {
    throw BadValue("task_wrench", "True", "False beside ball and ball_frame");
  }
  if (!task_wrench) {
    const py::object axes = ball.is_none() ? py::object(py::make_tuple("fx", "fy", "fz")) : ball;
    set = margin_ball(names_in("ball", axes), ball_frame == "end_effector");
  }
  const std::vector<Instant> instants = instants_in(*of.problem, motion, instants_per_interval);
  MotionMargin margin;
  run_or_interrupt([&] { margin = motion_margin(*of.problem, instants, set); });
  return margin;
}

py::array numbers_of(const MotionMargin& margin, double InstantMargin::*number) {
  Eigen::VectorXd all(static_cast<Eigen::Index>(margin.instants.size()));
  for (std::size_t i = 0; i < margin.instants.size(); ++i) {
    all[static_cast<Eigen::Index>(i)] = margin.instants[i].*number;
  }
  return copy(all);
}

py::array wrenches_of(const MotionMargin& margin) {
  RowMatrix all(static_cast<Eigen::Index>(margin.instants.size()), 6);
  for (std::size_t i = 0; i < margin.instants.size(); ++i) {
    all.row(static_cast<Eigen::Index>(i)) = margin.instants[i].worst.transpose();
  }
  return copy(all);
}

constexpr const char* kMargin =
    R"(Computes how much an end effector can exert beside what a motion itself needs.

At an instant with tau_d of the inverse dynamics it is the largest r such that for every wrench h of
the set there are efforts within their limits with B u = tau_d + r J'h. For a ball of forces this is
the inscribed radius of the residual force polytope (Ferrolho et al.). If the motion itself is
infeasible, the margin is negative: less help than that leaves it infeasible. Each margin is checked
by a linear program.

Args:
    task: a Task with one contact, or the name of one.
    motion: a dict of ``t`` and the coordinates by name, each with N numbers; a CSV file with these
        columns; or the Answer of a task in time. Coordinates are joints [rad or m], and ``base_x``
        .. ``base_yaw`` of a base that moves [m, rad]; without these, the end effector keeps its pose
        or follows its path. ``NAME_dot`` and ``NAME_ddot`` are derivatives; without them they are
        those of a cubic spline.
    ball: names of axes, all of forces or all of torques. Default: fx, fy and fz.
    ball_frame: "world" or "end_effector": their axes.
    task_wrench: whether the set is that of the task, in place of a ball.
    instants_per_interval: instants for each row of a table without derivatives.

Returns:
    Margin: the margins, N or (N - 1) instants_per_interval + 1 of them.

Raises:
    InputError: the table or the set is wrong, or the task has a second contact or uncertain loads.

>>> motion = {"t": [0, 1, 2], "shoulder": [-0.8, -0.7, -0.8], "elbow": [1, 0.9, 1]}
>>> margin = maxwrench.margin("planar/force", motion, ball=["fx", "fy"])
>>> margin.status, margin.margin.shape
('optimal', (3,))
)";

}  // namespace

void add_margins(py::module_& m) {
  py::class_<MotionMargin>(m, "Margin", R"(The margins of a motion, from ``margin``. N instants.

>>> turn = maxwrench.load("planar/trajectory")
>>> left = maxwrench.margin(turn, maxwrench.evaluate(turn, [0, 0]), task_wrench=True)
>>> left.margin.min() == left.least
True
)")
      .def_property_readonly(
          "t", [](const MotionMargin& f) { return numbers_of(f, &InstantMargin::t); },
          "The times (N) [s].")
      .def_property_readonly(
          "margin", [](const MotionMargin& f) { return numbers_of(f, &InstantMargin::margin); },
          "The margins (N) [unit]. Negative: the motion itself needs more than the actuators can "
          "exert; minus infinity: no wrench of the set helps.")
      .def_property_readonly("wrench", wrenches_of,
                             "The wrench of the set that meets the limits first, at a margin of "
                             "one, in world axes (N, 6).")
      .def_property_readonly(
          "binding",
          [](const MotionMargin& f) {
            py::list all;
            for (const InstantMargin& at : f.instants) {
              py::list limits;
              for (const LimitRate& limit : at.binding) {
                limits.append(py::make_tuple(limit.name, to_string(limit.side)));
              }
              all.append(limits);
            }
            return all;
          },
          "The limits that bind at each instant: lists of (actuator, \"min\" or \"max\").")
      .def_property_readonly(
          "least",
          [](const MotionMargin& f) {
            return f.instants[static_cast<std::size_t>(f.worst)].margin;
          },
          "The least margin [unit].")
      .def_readonly("worst", &MotionMargin::worst, "The index of the instant that has it.")
      .def_readonly("unit", &MotionMargin::unit, "The unit of the margins.")
      .def_readonly("difference", &MotionMargin::difference,
                    "The largest difference of a margin and its check [unit].")
      .def_property_readonly(
          "status", [](const MotionMargin& f) { return to_string(f.status); },
          "\"optimal\", \"infeasible\": the motion itself is, at some instant, \"unbounded\" or "
          "\"numerical_error\".")
      .def_property_readonly(
          "reason", [](const MotionMargin& f) { return f.reason.str(); },
          "Why the status is not \"optimal\".")
      .def(
          "figure", [](const MotionMargin& f) { return margin_figure(f); },
          "Returns the SVG that the command draws.")
      .def(
          "csv", [](const MotionMargin& f) { return margin_csv(f); },
          "Returns the table that the command writes.")
      .def(
          "summary", [](const MotionMargin& f) { return summary(f); },
          "Returns the text that the command prints.")
      .def(
          "to_dict",
          [](const MotionMargin& f) {
            return py::module_::import("json").attr("loads")(to_json(f));
          },
          "Returns the JSON object that the command prints, as a dict.")
      .def("__len__", [](const MotionMargin& f) { return f.instants.size(); })
      .def("__str__", [](const MotionMargin& f) { return summary(f); })
      .def("__repr__",
           [](const MotionMargin& f) {
             return fmt::format("<Margin {}: {:.6g} {} at {:.6g} s, the least of {} instants>",
                                f.problem, f.instants[static_cast<std::size_t>(f.worst)].margin,
                                f.unit, f.instants[static_cast<std::size_t>(f.worst)].t,
                                f.instants.size());
           })
      .def(py::pickle(&pack<MotionMargin>, &unpack<MotionMargin>));
  m.def("margin", &compute_margin, py::arg("task"), py::arg("motion"), py::kw_only(),
        py::arg("ball") = py::none(), py::arg("ball_frame") = "world",
        py::arg("task_wrench") = false, py::arg("instants_per_interval") = 1, kMargin);
}

}  // namespace maxwrench::python
