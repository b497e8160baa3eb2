#include "maxwrench/sensitivity.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <limits>

#include "problems/make/bad_value.h"
#include "problems/make/losses.h"
#include "python/src/arrays.h"
#include "python/src/background.h"
#include "python/src/fields.h"
#include "python/src/parts.h"
#include "python/src/words.h"

namespace maxwrench::python {

/// What is shown of the answers: a lost actuator makes another task of each, which is not kept.
template <class Archive>
void fields(Archive& archive, LossEffect& effect) {
  archive(effect.name);
  for (Answer* a : {&effect.at_posture, &effect.best}) {
    archive(static_cast<Verdict&>(*a), a->unit, a->choice, a->evaluations, a->trajectory.status,
            a->trajectory.value, a->posture.theta_r);
  }
}

template <class Archive>
void fields(Archive& archive, Sensitivity& s) {
  archive(s.effects, s.all);
}

namespace {

double value_or_nan(const Answer& answer) {
  return answer.has_value() ? answer.beta() : std::numeric_limits<double>::quiet_NaN();
}

LossSpec loss_of(const py::object& actuators, const std::string& joints, double friction,
                 double brake) {
  if (joints != "limp" && joints != "locked") {
    throw BadValue("joints", shown(joints), "limp or locked");
  }
  LossSpec loss;
  loss.actuators = names_in("actuators", actuators);
  loss.joints_lock = joints == "locked";
  loss.friction = friction;
  loss.brake = brake;
  return loss;
}

Sensitivity compare_losses(const py::object& task, const py::object& theta_r,
                           const py::object& actuators, const std::string& joints, double friction,
                           double brake, const std::string& wrench, const std::string& solver,
                           const std::string& search, std::uint64_t seed, long budget, int threads,
                           const py::object& callback) {
  const PyTask of = task_of(task);
  const Problem& problem = *of.problem;
  Options options;
  options.wrench = parse_wrench(wrench);
  options.solver = solver;
  options.search = search;
  options.seed = seed;
  options.budget = budget;
  options.threads = threads;
  Eigen::VectorXd posture = problem.theta_r_default;
  if (!theta_r.is_none()) {
    posture = vector("theta_r", theta_r, problem.redundancy());
    require_all_finite("theta_r", posture.transpose());
  }
  const std::vector<ScenarioLimits> limits =
      limits_of_each_loss(loss_of(actuators, joints, friction, brake), problem.robot);
  Sensitivity result;
  const Callback shown_line(callback, 0, problem.name);
  run_in_background(shown_line.function(), [&](Watch& watch) {
    watch_over(watch, options);
    result = sensitivity(problem, posture, limits, options);
  });
  return result;
}

PyTask nominal_task(const py::object& task) {
  const PyTask of = task_of(task);
  py::dict how;
  how["task"] = of;
  return {std::make_shared<const Problem>(nominal(*of.problem)), {"nominal", how}};
}

constexpr const char* kNominal = R"(Returns a task without its uncertainty and its loss.

Its wrenches and its payload remain, with the nominal robot.

Args:
    task: a Task, or the name of one.

Returns:
    Task: the task of the nominal robot; the same one if it has no list of scenarios.

>>> push = maxwrench.load("fixed/push")
>>> weaker = maxwrench.Static(push.robot, uncertainty={"torque": 0.1})
>>> values = [maxwrench.evaluate(t, t.theta_r_default).beta for t in (weaker, maxwrench.nominal(weaker))]
>>> values[0] < values[1]
True
)";

constexpr const char* kSensitivity =
    R"(Computes what a static task is worth with each of several actuators lost.

Each loss is evaluated at the given posture, and the search is repeated for it. So is one posture for
all of them.

Args:
    task: a static Task with one contact, or the name of one.
    theta_r: the given posture (r) [rad or m]. Default: the default one of the task.
    actuators: names of thrusters and joints, "thrusters" or "joints" for all of them.
    joints: what a lost joint is: "limp", or "locked" by its brake.
    friction: what a limp joint resists [N m or N].
    brake: what a locked joint resists [N m or N].
    wrench, solver, search, seed, budget, threads, callback: as of ``solve``, for each search.
        callback gets the evaluations of one search after the other. Ctrl-C ends them all; searches
        after it have no value.

Returns:
    Sensitivity: the values.

Raises:
    InputError: an actuator does not exist, the task is in time or has a second contact, or as
        ``solve``.

>>> cost = maxwrench.sensitivity("planar/force", actuators="elbow", friction=1, budget=50)
>>> [loss.name for loss in cost.losses]
['', 'elbow limp']
)";

}  // namespace

void add_sensitivity(py::module_& m) {
  py::class_<LossEffect>(m, "Loss", R"(What a task is worth with some actuators lost.

>>> cost = maxwrench.sensitivity("planar/force", actuators="elbow", friction=1, budget=50)
>>> loss = cost.losses[1]
>>> loss.name, loss.at_posture <= cost.losses[0].at_posture
('elbow limp', True)
)")
      .def_readonly("name", &LossEffect::name,
                    "What is lost, such as \"front_left dead\"; empty: nothing.")
      .def_property_readonly(
          "at_posture", [](const LossEffect& e) { return value_or_nan(e.at_posture); },
          "The value at the given posture [unit]; NaN: there is none.")
      .def_property_readonly(
          "best", [](const LossEffect& e) { return value_or_nan(e.best); },
          "The value of the best posture that the search finds [unit]; NaN: there is none.")
      .def_property_readonly(
          "theta_r",
          [](const LossEffect& e) -> py::object {
            if (!e.best.has_value()) return py::none();
            return copy(e.best.posture.theta_r);
          },
          "The best posture (r) [rad or m]; None: there is none.")
      .def("__repr__",
           [](const LossEffect& e) {
             return fmt::format("<Loss {}: {:.6g} at the posture, {:.6g} in the best one>",
                                e.name.empty() ? "of nothing" : e.name, value_or_nan(e.at_posture),
                                value_or_nan(e.best));
           })
      .def(py::pickle(&pack<LossEffect>, &unpack<LossEffect>));
  py::class_<Sensitivity>(m, "Sensitivity", R"(The losses of a task, compared by ``sensitivity``.

>>> cost = maxwrench.sensitivity("planar/force", actuators="elbow", friction=1, budget=50)
>>> len(cost.losses), cost.unit, cost.all.at_posture <= cost.losses[0].at_posture
(2, 'N', True)
)")
      .def_readonly("losses", &Sensitivity::effects,
                    "Each Loss, in the order of the actuators; the first is of nothing.")
      .def_readonly("all", &Sensitivity::all,
                    "One posture for all of them: the least of their values, as a Loss.")
      .def_property_readonly(
          "unit", [](const Sensitivity& s) { return s.all.at_posture.unit; },
          "The unit of the values.")
      .def(
          "summary", [](const Sensitivity& s) { return summary(s); },
          "Returns the table that the command prints.")
      .def(
          "to_dict",
          [](const Sensitivity& s) {
            return py::module_::import("json").attr("loads")(to_json(s));
          },
          "Returns the JSON object that the command prints, as a dict.")
      .def("__str__", [](const Sensitivity& s) { return summary(s); })
      .def("__repr__",
           [](const Sensitivity& s) {
             return fmt::format("<Sensitivity {}: {} losses, {:.6g} {} with any of them>",
                                s.all.at_posture.choice.problem, s.effects.size() - 1,
                                value_or_nan(s.all.best), s.all.at_posture.unit);
           })
      .def(py::pickle(&pack<Sensitivity>, &unpack<Sensitivity>));
  m.def("nominal", &nominal_task, py::arg("task"), kNominal);
  m.def("sensitivity", &compare_losses, py::arg("task"), py::arg("theta_r") = py::none(),
        py::kw_only(), py::arg("actuators") = py::make_tuple("thrusters"),
        py::arg("joints") = "limp", py::arg("friction") = LossSpec().friction,
        py::arg("brake") = LossSpec().brake, py::arg("wrench") = "pure", py::arg("solver") = "",
        py::arg("search") = "", py::arg("seed") = 1, py::arg("budget") = 0, py::arg("threads") = 0,
        py::arg("callback") = py::none(), kSensitivity);
}

}  // namespace maxwrench::python
