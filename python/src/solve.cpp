#include "maxwrench/solve.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "maxwrench/strategies.h"
#include "problems/make/bad_value.h"
#include "python/src/arrays.h"
#include "python/src/background.h"
#include "python/src/parts.h"
#include "solvers/added_strategies.h"
#include "solvers/solve/method.h"

namespace maxwrench::python {

Eigen::MatrixXd knots_in(const Array& array, const Problem& task) {
  if (task.redundancy() == 0 && array.size() > 0) {
    throw BadValue(
        "theta_r", "shape " + shape_of(array),
        "an empty array: the robot is not redundant here (evaluate_joints takes joints)");
  }
  if (task.motion && array.ndim() != 1 && array.ndim() != 2) {
    throw BadValue("theta_r", "shape " + shape_of(array),
                   fmt::format("knots of shape ({}, {})", knots_of(task), task.redundancy()));
  }
  const bool table = task.motion && array.ndim() == 2;
  const Eigen::MatrixXd knots =
      table ? Eigen::MatrixXd(matrix("theta_r", array, knots_of(task), task.redundancy()))
            : Eigen::MatrixXd(vector("theta_r", array, task.redundancy()).transpose());
  require_all_finite("theta_r", knots);
  return knots;
}

namespace {

Options options_of(const std::string& measure, const std::string& wrench,
                   const std::string& solver) {
  Options options;
  options.measure = measure;
  options.wrench = parse_wrench(wrench);
  options.solver = solver;
  return options;
}

py::object evaluate_task(const py::object& task, const py::object& theta_r,
                         const std::string& measure, const std::string& wrench,
                         const std::string& solver, bool check_collision, bool gradients,
                         int threads, const py::object& callback) {
  const PyTask of = task_of(task);
  Options options = options_of(measure, wrench, solver);
  options.check_collision = check_collision;
  options.threads = threads;
  if (threads != 0) thread_count(threads);  // one posture uses one, but a wrong number is wrong
  require_callback(callback);
  const Array given = numbers("theta_r", theta_r);
  if (!of.problem->motion && given.ndim() == 2) {
    return evaluate_rows(of, given, options, gradients, callback);
  }
  const Eigen::MatrixXd knots = knots_in(given, *of.problem);
  PyAnswer result{{}, of};
  const auto compute = [&] { result.answer = evaluate(*of.problem, knots, options); };
  if (of.problem->motion) {
    run_or_interrupt(compute);
  } else {  // a posture takes less time than another thread
    const py::gil_scoped_release released;
    compute();
  }
  return py::cast(std::move(result));
}

py::object evaluate_joints(const py::object& task, const py::object& q, const std::string& measure,
                           const std::string& wrench, const std::string& solver,
                           bool check_collision, int threads, const py::object& callback) {
  const PyTask of = task_of(task);
  Options options = options_of(measure, wrench, solver);
  options.check_collision = check_collision;
  options.threads = threads;
  if (threads != 0) thread_count(threads);  // one posture uses one, but a wrong number is wrong
  require_callback(callback);
  const Array given = numbers("q", q);
  if (given.ndim() == 2) return evaluate_joint_rows(of, given, options, callback);
  const Eigen::VectorXd joints = vector("q", given, Eigen::Index(of.problem->robot.joints.size()));
  require_all_finite("q", joints);
  PyAnswer result{{}, of};  // it counts references, which needs the lock
  {
    const py::gil_scoped_release released;
    result.answer = evaluate_posture(*of.problem, joints, options);
  }
  return py::cast(std::move(result));
}

PyAnswer solve_task(const py::object& task, const std::string& measure, const std::string& wrench,
                    const std::string& solver, const std::string& search, std::uint64_t seed,
                    long budget, int threads, const py::object& callback) {
  const PyTask of = task_of(task);
  Options options = options_of(measure, wrench, solver);
  options.search = search;
  options.seed = seed;
  options.budget = budget;
  options.threads = threads;
  PyAnswer result{{}, of};
  const Callback shown(callback, budget, of.problem->name);
  run_in_background(shown.function(), [&](Watch& watch) {
    watch_over(watch, options);
    result.answer = solve(*of.problem, options);
  });
  return result;
}

/// Adds the entries of a user.
template <class Entry>
py::dict with_added(py::dict names, const std::vector<const Entry*>& added) {
  for (const Entry* entry : added) names[py::str(entry->name)] = entry->summary;
  return names;
}

template <class Table>
py::dict summaries(const Table& table) {
  py::dict names;
  for (const auto& entry : table) names[py::str(entry.name)] = entry.summary;
  return names;
}

py::dict all_searches() {
  py::dict names = summaries(searches());
  names.attr("update")(summaries(trajectory_searches()));
  names.attr("update")(summaries(facet_searches()));
  names.attr("update")(summaries(path_searches()));
  names.attr("update")(summaries(transfer_searches()));
  return with_added(names, added_searches());
}

constexpr const char* kEvaluate = R"(Evaluates a task at theta_r.

Args:
    task: a Task, or the name of one.
    theta_r: the redundant coordinates (r) [rad or m]. For a static task also N postures, one in
        each row (N×r), which are evaluated side by side. For a task in time knots (k×r), or r
        numbers that it keeps throughout.
    measure: the measure; ``measures()`` lists them.
    wrench: "pure": only multiples of c; "any": other wrenches of the task may occur, too.
    solver: the solver of the lower level; the first one that supports the task if empty.
    check_collision: whether a posture that collides is invalid.
    gradients: for N postures, whether ``Evaluations.gradient`` is computed. One posture always has
        its gradient.
    threads: for N postures, the number of threads; it changes the time, never the values; 0: one
        per core.
    callback: for N postures, as of ``solve``; those that remain have the status budget_exhausted.

Returns:
    Answer: the value with everything that is known about it. Evaluations: those of N postures.

Raises:
    InputError: the array has the wrong shape or is not finite, a name does not exist, or the
        choices do not fit together.

>>> maxwrench.evaluate("planar/force", [0, 0]).status
'optimal'
)";

constexpr const char* kEvaluateJoints =
    R"(Evaluates a static task in postures that are given by all joints.

The base is at its mount and the end effector where the joints put it. There is no inverse
kinematics, and no gradient.

Args:
    task: a static Task with one contact, or the name of one.
    q: positions of all joints (J) [rad or m], in the order of ``robot.joint_names``; or N postures,
        one in each row (N×J), which are evaluated side by side.
    others: as of ``evaluate``.

Returns:
    Answer: the value. Evaluations: those of N postures, without gradients.

Raises:
    InputError: as ``evaluate``.

>>> task = maxwrench.load("fixed/push")
>>> at_rest = [0, 0.3, 0, -1.5, 0, -0.6, 0]
>>> maxwrench.evaluate_joints(task, at_rest).has_value
True
>>> maxwrench.evaluate_joints(task, [at_rest, at_rest]).beta.shape
(2,)
)";

constexpr const char* kSolve = R"(Searches for the best posture or trajectory.

Args:
    task: a Task, or the name of one.
    measure, wrench, solver: as of ``evaluate``.
    search: the search, or stages joined by "+"; ``searches()`` lists them. Empty: the best one in
        general.
    seed: of the random numbers.
    budget: largest number of evaluations; 0: a usual one.
    threads: number of threads; it changes the time, never the answer; 0: one per core.
    callback: called every tenth of a second with the number of evaluations; if it returns True,
        the search ends. Ctrl-C ends it, too. Either way the best so far is returned, with status
        budget_exhausted. None: a line of progress on a terminal or in a notebook; False: nothing.

Returns:
    Answer: the best one that the search finds, evaluated again.

Raises:
    InputError: as ``evaluate``.

>>> answer = maxwrench.solve("planar/force", seed=1)
>>> answer.status
'best_found'
)";

}  // namespace

void add_solve(py::module_& m) {
  m.def("evaluate", &evaluate_task, py::arg("task"), py::arg("theta_r"), py::kw_only(),
        py::arg("measure") = Case().measure, py::arg("wrench") = "pure", py::arg("solver") = "",
        py::arg("check_collision") = true, py::arg("gradients") = false, py::arg("threads") = 0,
        py::arg("callback") = py::none(), kEvaluate);
  m.def("evaluate_joints", &evaluate_joints, py::arg("task"), py::arg("q"), py::kw_only(),
        py::arg("measure") = Case().measure, py::arg("wrench") = "pure", py::arg("solver") = "",
        py::arg("check_collision") = true, py::arg("threads") = 0, py::arg("callback") = py::none(),
        kEvaluateJoints);
  m.def("solve", &solve_task, py::arg("task"), py::kw_only(), py::arg("measure") = Case().measure,
        py::arg("wrench") = "pure", py::arg("solver") = "", py::arg("search") = "",
        py::arg("seed") = 1, py::arg("budget") = 0, py::arg("threads") = 0,
        py::arg("callback") = py::none(), kSolve);
  m.def(
      "measures", [] { return with_added(summaries(measures()), added_measures()); },
      R"(Returns the measures: a line about each, by name.

>>> "linf_polytope" in maxwrench.measures()
True
)");
  m.def(
      "solvers", [] { return summaries(wrench_solvers()); },
      R"(Returns the solvers of the lower level: a line about each, by name.

>>> "facets" in maxwrench.solvers()
True
)");
  m.def("searches", &all_searches, R"(Returns the searches: a line about each, by name.

>>> "cmaes" in maxwrench.searches()
True
)");
  m.def(
      "integrators", [] { return summaries(integrators()); },
      R"(Returns the integrators: a line about each, by name.

>>> "runge_kutta" in maxwrench.integrators()
True
)");
}

}  // namespace maxwrench::python
