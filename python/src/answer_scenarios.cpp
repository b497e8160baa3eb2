#include <pybind11/stl.h>

#include "maxwrench/sensitivity.h"
#include "python/src/background.h"
#include "python/src/parts.h"

namespace maxwrench::python {
namespace {

py::object decides(const PyAnswer& self) {
  const Answer& answer = self.answer;
  if (!answer.has_value() || answer.task->scenarios.empty()) return py::none();
  const bool in_time = answer.task->motion.has_value();
  return py::str(describe(answer.task->scenarios,
                          in_time ? answer.trajectory.decides : answer.capability.decides));
}

py::object worst(const PyAnswer& self) {
  const Answer& answer = self.answer;
  const bool in_time = answer.task && answer.task->motion.has_value();
  const bool list = answer.has_value() && !answer.task->scenarios.empty();
  if (!list || (in_time && answer.trajectory.decides_at < 0)) return py::none();
  const ScenarioData data =
      scenario_data(*answer.task, in_time ? answer.trajectory.decides : answer.capability.decides);
  return py::module_::import("json").attr("loads")(to_json(data));
}

py::object decides_at(const PyAnswer& self) {
  const Answer& answer = self.answer;
  const Trajectory& trajectory = answer.trajectory;
  const bool list = answer.has_value() && answer.task->motion && !answer.task->scenarios.empty();
  if (!list || trajectory.decides_at < 0) return py::none();
  return py::float_(trajectory.instants[static_cast<std::size_t>(trajectory.decides_at)].t);
}

py::list scenarios(const PyAnswer& self) {
  std::vector<ScenarioEnds> ends;
  run_or_interrupt([&] { ends = scenario_ends(self.answer); });
  py::list list;
  for (const ScenarioEnds& each : ends) {
    py::dict entry;
    entry["name"] = each.name;
    entry["low"] = each.low;
    entry["high"] = each.high;
    entry["held"] = each.held;
    list.append(entry);
  }
  return list;
}

py::dict sample_of(const PyAnswer& self, long n, std::uint64_t seed,
                   std::optional<double> guaranteed) {
  ScenarioSample sample;
  run_or_interrupt([&] { sample = sample_scenarios(self.answer, n, seed, guaranteed); });
  py::dict numbers;
  numbers["drawn"] = sample.drawn;
  numbers["infeasible"] = sample.infeasible;
  numbers["least"] = sample.least;
  numbers["q01"] = sample.q01;
  numbers["q05"] = sample.q05;
  numbers["median"] = sample.median;
  numbers["below"] = sample.below;
  numbers["guaranteed"] = sample.guaranteed;
  numbers["unit"] = sample.unit;
  numbers["values"] = sample.values;
  return numbers;
}

}  // namespace

void add_scenarios(py::class_<PyAnswer>& answer) {
  answer
      .def_property_readonly(
          "decides", &decides,
          "The scenario that decides, if the task has a list of scenarios and there is a value, or "
          "None.")
      .def_property_readonly("worst", &worst,
                             R"(The data of `decides` as a dict, or None where that is None.

``wrench`` is the name of one of several wrenches, or None, and ``c`` the wrench [force; torque] per
unit of the value, in world axes; of a ball it is the critical one. ``deltas`` has the changes of
uncertain values by their keys, such as ``"mass.link_4"`` or ``"com.base"``, in the units of these
keys. ``current`` is the velocity of the water [m/s], or None if the task has no current. ``dead``,
``limp`` and ``locked`` list actuators by name, and ``weaker`` has the shares by which others are
weaker.

>>> push = maxwrench.load("fixed/push")
>>> unsure = maxwrench.Static(push.robot, uncertainty={"payload": {"mass": 0.5}})
>>> maxwrench.evaluate(unsure, unsure.theta_r_default).worst["deltas"]
{'payload.mass': 0.5}
)")
      .def_property_readonly(
          "decides_at", &decides_at,
          "The time of the instant that decides [s], if the task is in time and has a list of "
          "scenarios, or None.")
      .def("scenarios", &scenarios, R"(The interval of each scenario at this posture or trajectory.

In time each scenario is solved alone, and ``low`` is infinite, or 0 for a payload.

Returns a list of dicts with ``name``, ``low``, ``high`` (infinite where there is no end) and
``held``: whether the interval has a point. Raises InputError if the task has no list of scenarios
or the posture or trajectory is invalid.
)")
      .def("sample", &sample_of, py::arg("n"), py::arg("seed") = 0,
           py::arg("guaranteed") = py::none(),
           R"(Draws n models of a task with a list of scenarios, at this posture.

Every width is uniform; a current and a loss are drawn from theirs. A sample proves nothing, but no
value is below a guaranteed one.

Args:
    n: the number of models, at least 1.
    seed: of the random numbers. Model i of a seed is the same in any posture.
    guaranteed: what models are compared with [unit], such as the guaranteed value of another
        posture. Default: the value for all models at this posture.

Returns:
    dict: ``drawn`` and, of these, ``infeasible``; ``least``, ``q01``, ``q05`` and ``median``: the
    least value and the quantiles 1 %, 5 % and 50 % [unit]; ``guaranteed``, what they are
    compared with [unit], and ``below``, how many are below it; ``unit``; ``values``, a list of
    that of each model. A model without a value counts as minus infinity.

Raises:
    InputError: the task has no list or is in time, the posture is invalid, or n < 1.

>>> push = maxwrench.load("fixed/push")
>>> unsure = maxwrench.Static(push.robot, uncertainty={"torque": 0.1})
>>> drawn = maxwrench.evaluate(unsure, unsure.theta_r_default).sample(20)
>>> drawn["drawn"], drawn["below"]
(20, 0)
)");
}

}  // namespace maxwrench::python
