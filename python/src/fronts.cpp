#include <fmt/format.h>
#include <pybind11/stl.h>

#include "maxwrench/figures.h"
#include "maxwrench/pareto.h"
#include "problems/make/bad_value.h"
#include "python/src/arrays.h"
#include "python/src/background.h"
#include "python/src/fields.h"
#include "python/src/parts.h"
#include "python/src/words.h"

namespace maxwrench::python {

template <class Archive>
void fields(Archive& archive, FrontPoint& p) {
  archive(p.phi, p.weights, p.theta_r, p.beta, p.t, p.bound);
}

namespace {

/// A front, as Python holds it.
struct PyFront : Front {
  std::vector<PyTask> tasks;  ///< one for each goal
};

template <class Archive>
void fields(Archive& archive, PyFront& f) {
  std::vector<PyAnswer> own;
  for (std::size_t k = 0; k < f.own.size(); ++k) own.push_back({f.own[k], f.tasks[k]});
  archive(static_cast<Verdict&>(f), own, f.tasks, f.points, f.compromise, f.dominated,
          f.evaluations, f.wall_s);
  f.own.clear();
  for (PyAnswer& each : own) f.own.push_back(std::move(each.answer));
}

/// The tasks of a front: one Task or name, or a list of them.
std::vector<py::object> tasks_in(const py::object& against) {
  if (py::isinstance<py::list>(against) || py::isinstance<py::tuple>(against)) {
    return against.cast<std::vector<py::object>>();
  }
  return {against};
}

PyFront make_front(const py::object& task, const py::object& against, int points, bool certify,
                   double gap, double seconds, const std::string& measure,
                   const std::string& wrench, const std::string& against_measure,
                   const std::string& against_wrench, const std::string& search, std::uint64_t seed,
                   long budget, int threads, const py::object& callback) {
  PyFront result;
  std::vector<Goal> goals;
  result.tasks.push_back(task_of(task));
  goals.push_back({*result.tasks.back().problem, measure, parse_wrench(wrench)});
  for (const py::object& other : tasks_in(against)) {
    result.tasks.push_back(task_of(other));
    goals.push_back({*result.tasks.back().problem,
                     against_measure.empty() ? measure : against_measure,
                     parse_wrench(against_wrench.empty() ? wrench : against_wrench)});
  }
  FrontPlan plan;
  plan.points = goals.size() > 2 && points == FrontPlan().points ? 0 : points;
  plan.bound = certify;
  plan.gap = gap;
  plan.seconds = seconds;
  Options options;
  options.search = search;
  options.seed = seed;
  options.budget = budget;
  options.threads = threads;
  const Callback shown_line(callback, 0, goals.front().task.name);
  run_in_background(shown_line.function(), [&](Watch& watch) {
    options.interrupted = [&watch] { return watch.stop.load(); };
    static_cast<Front&>(result) = pareto(goals, plan, options);
  });
  return result;
}

/// A row of each point.
py::array rows_of_points(const Front& front, Eigen::VectorXd FrontPoint::*row) {
  const Eigen::Index width = front.points.empty() ? 0 : (front.points.front().*row).size();
  RowMatrix all(static_cast<Eigen::Index>(front.points.size()), width);
  for (std::size_t i = 0; i < front.points.size(); ++i) {
    all.row(static_cast<Eigen::Index>(i)) = (front.points[i].*row).transpose();
  }
  return copy(all);
}

py::array numbers_of_points(const Front& front, double FrontPoint::*number) {
  Eigen::VectorXd all(static_cast<Eigen::Index>(front.points.size()));
  for (std::size_t i = 0; i < front.points.size(); ++i) {
    all[static_cast<Eigen::Index>(i)] = front.points[i].*number;
  }
  return copy(all);
}

py::object compromise_of(const PyFront& front) {
  if (front.compromise.theta_r.size() == 0) return py::none();
  py::dict found;
  found["share"] = front.compromise.t;
  found["beta"] = copy(front.compromise.beta);
  found["theta_r"] = copy(front.compromise.theta_r);
  return found;
}

constexpr const char* kPareto = R"(Computes what one posture can give to two tasks, or to several.

The tasks have the same robot, end effector, pose and redundant joints. For weights w that turn from
the first task's own best value to the second's, the search maximises the least of beta_k / w_k.

Args:
    task: a static Task, or the name of one.
    against: the other one; or a list of several, for one posture that suits all.
    points: number of weights of two tasks; 0: only the posture for all.
    certify: whether to prove for each weight what no posture exceeds, to ``gap`` within ``seconds``.
    gap: the gap at which such a proof is complete, relative to its value.
    seconds: the time after which such a proof ends [s].
    measure, wrench: as of ``solve``, of the first task.
    against_measure, against_wrench: those of the others; empty: the same.
    search, seed, budget, threads: as of ``solve``, for each weight. The default search is crs2+cmaes.
    callback: called every tenth of a second with 0. If it returns True, or on Ctrl-C, the front ends.

Returns:
    Front: the postures.

Raises:
    InputError: the tasks do not suit each other, or as ``solve``.

>>> front = maxwrench.pareto("uvms/valve", "uvms/lift", points=3, budget=100)
>>> front.beta.shape[1]
2
)";

}  // namespace

void add_fronts(py::module_& m) {
  py::class_<PyFront>(m, "Front",
                      R"(What one posture gives to several tasks, from ``pareto``. N points.

>>> front = maxwrench.pareto("uvms/valve", "uvms/lift", points=3, budget=100)
>>> front.beta[0, 0] >= front.beta[-1, 0] and front.beta[0, 1] <= front.beta[-1, 1]
True
)")
      .def_property_readonly(
          "phi", [](const PyFront& f) { return numbers_of_points(f, &FrontPoint::phi); },
          "The angles of the weights (N) [rad].")
      .def_property_readonly(
          "weights", [](const PyFront& f) { return rows_of_points(f, &FrontPoint::weights); },
          "The weights w (N, 2).")
      .def_property_readonly(
          "beta", [](const PyFront& f) { return rows_of_points(f, &FrontPoint::beta); },
          "The values of both tasks (N, 2). None is dominated.")
      .def_property_readonly(
          "theta_r", [](const PyFront& f) { return rows_of_points(f, &FrontPoint::theta_r); },
          "The postures (N, r) [rad or m].")
      .def_property_readonly(
          "t", [](const PyFront& f) { return numbers_of_points(f, &FrontPoint::t); },
          "The least of beta_k / w_k (N).")
      .def_property_readonly(
          "bound", [](const PyFront& f) { return numbers_of_points(f, &FrontPoint::bound); },
          "No posture has a larger t (N); infinity: not known.")
      .def_property_readonly(
          "own",
          [](const PyFront& f) {
            Eigen::VectorXd best(static_cast<Eigen::Index>(f.own.size()));
            for (Eigen::Index k = 0; k < best.size(); ++k) {
              const Answer& own = f.own[static_cast<std::size_t>(k)];
              best[k] = own.has_value() ? own.beta() : std::numeric_limits<double>::quiet_NaN();
            }
            return copy(best);
          },
          "The best value of each task alone; NaN: none.")
      .def_property_readonly("compromise", compromise_of,
                             "The posture with the largest worst share of each task's own best: a "
                             "dict of share, beta, theta_r; None: there is none.")
      .def_property_readonly(
          "status", [](const PyFront& f) { return to_string(f.status); },
          "\"best_found\", \"none_found\" or \"budget_exhausted\".")
      .def_property_readonly(
          "reason", [](const PyFront& f) { return f.reason.str(); }, "Why there is no front.")
      .def(
          "figure", [](const PyFront& f) { return front_figure(f); },
          "Returns the SVG that the command draws.")
      .def(
          "csv", [](const PyFront& f) { return front_csv(f); },
          "Returns the points as CSV, the posture for all in the last row.")
      .def(
          "summary", [](const PyFront& f) { return summary(f); },
          "Returns the text that the command prints.")
      .def(
          "to_dict",
          [](const PyFront& f) { return py::module_::import("json").attr("loads")(to_json(f)); },
          "Returns the JSON object that the command prints, as a dict.")
      .def("__len__", [](const PyFront& f) { return f.points.size(); })
      .def("__str__", [](const PyFront& f) { return summary(f); })
      .def("__repr__",
           [](const PyFront& f) {
             return fmt::format("<Front: {} tasks, {} points>", f.own.size(), f.points.size());
           })
      .def(py::pickle(&pack<PyFront>, &unpack<PyFront>));
  m.def("pareto", &make_front, py::arg("task"), py::arg("against"), py::kw_only(),
        py::arg("points") = FrontPlan().points, py::arg("certify") = false,
        py::arg("gap") = FrontPlan().gap, py::arg("seconds") = FrontPlan().seconds,
        py::arg("measure") = Case().measure, py::arg("wrench") = "pure",
        py::arg("against_measure") = "", py::arg("against_wrench") = "", py::arg("search") = "",
        py::arg("seed") = 1, py::arg("budget") = 0, py::arg("threads") = 0,
        py::arg("callback") = py::none(), kPareto);
}

}  // namespace maxwrench::python
