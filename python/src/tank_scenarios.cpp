#include "solvers/solve/tank_scenarios.h"

#include <pybind11/stl.h>

#include "maxwrench/strategies.h"
#include "problems/make/bad_value.h"
#include "python/src/background.h"
#include "python/src/tank_request.h"

namespace maxwrench::python {
namespace {

ScenarioExperiments run_scenarios(const Answer& answer, const Request& request) {
  const Problem& task = *answer.task;
  if (task.motion) {
    return simulate_scenarios(task, answer.trajectory, answer.choice.wrench,
                              find_trajectory_solver(answer.choice.solver),
                              script_options(task, request), request.integrator, request.tank);
  }
  return simulate_scenarios(held_answer(answer), request.planned, request.integrator, request.tank);
}

py::dict simulate_list(const PyAnswer& given, const std::string& integrator,
                       const std::string& interpolation, double planned,
                       const py::kwargs& options) {
  const Answer& answer = given.answer;
  if (answer.task->scenarios.empty()) {
    throw BadValue("answer", "a task without a list of scenarios", "one with a list");
  }
  require_tank_scenarios(*answer.task);
  Request request = read_request(given, integrator, interpolation, planned, options);
  ScenarioExperiments experiments;
  run_in_background(py::none(), [&](Watch& watch) {
    request.tank.interrupted = [&watch] { return watch.stop.load(); };
    experiments = run_scenarios(answer, request);
  });
  py::dict all;
  for (ScenarioExperiment& each : experiments.all) {
    all[py::str(each.scenario.name)] = PyExperiment{std::move(each.experiment.run), given.task};
  }
  return all;
}

constexpr const char* kSimulateScenarios =
    R"(Carries out each scenario of a list in the virtual tank.

In each experiment the robot has the limits of its scenario and exerts its wrench, times the value
of the answer. With ``dies`` all actuators work at first, so only the wrenches differ.

Args:
    answer: an Answer with a value, of a task with a list of wrenches, losses or weaker actuators.
    planned: factor of the wrenches; 0: the value of the answer, in time that between knots.
    integrator, interpolation, options: as of ``simulate``.

Returns:
    dict[str, Experiment]: the experiment of each scenario, by its name.

Raises:
    InputError: the task has no list, or one with a ball, a payload, a locked joint or uncertain
        loads; the answer has no value, or a value is out of its range.

>>> push = maxwrench.load("planar/force")
>>> both = maxwrench.Static(push.robot, pose=push.pose, set=[[1, 0, 0, 0, 0, 0], [-1, 0, 0, 0, 0, 0]])
>>> answer = maxwrench.evaluate(both, both.theta_r_default)
>>> experiments = maxwrench.simulate_scenarios(answer, ramp=1, hold=1)
>>> list(experiments), [each.held for each in experiments.values()]
(['wrench 1', 'wrench 2'], [True, True])
)";

}  // namespace

void add_tank_scenarios(py::module_& m) {
  m.def("simulate_scenarios", &simulate_list, py::arg("answer"), py::arg("integrator") = "cvode",
        py::arg("interpolation") = "", py::arg("planned") = 0.0, kSimulateScenarios);
}

}  // namespace maxwrench::python
