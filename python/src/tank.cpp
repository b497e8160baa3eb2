#include "maxwrench/tank.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "maxwrench/strategies.h"
#include "problems/make/bad_value.h"
#include "python/src/arrays.h"
#include "python/src/background.h"
#include "python/src/parts.h"
#include "python/src/tank_request.h"
#include "python/src/words.h"
#include "solvers/solve/tank.h"

namespace maxwrench::python {
namespace {

/// {name: time}
void read_deaths(const py::object& value, const Robot& robot, TankOptions& tank) {
  if (!py::isinstance<py::dict>(value)) {
    throw BadValue("dies", py::repr(value).cast<std::string>(),
                   "a dict {name of an actuator: time in seconds}");
  }
  for (const auto& [name, t] : value.cast<py::dict>()) {
    const py::object time = py::reinterpret_borrow<py::object>(t);
    tank.deaths.push_back(
        death_of(robot, "dies", py::str(name).cast<std::string>(), number_in("dies", time)));
  }
}

}  // namespace

/// Reads the options of the tank, each of which is a number; rejects other names.
Request read_request(const PyAnswer& given, const std::string& integrator,
                     const std::string& interpolation, double planned, const py::kwargs& options) {
  const std::vector<std::string> supported = stiff_integrators();
  if (std::find(supported.begin(), supported.end(), integrator) == supported.end()) {
    throw BadValue("integrator", shown(integrator), "one for stiff systems: " + shown(supported));
  }
  const Answer& answer = given.answer;
  if (answer.task->contact) {
    throw BadValue("answer", "a task with a second contact", "one without");
  }
  if (!answer.has_value()) throw BadValue("answer", answer.reason.str(), "one with a value");
  Request request{integrator, interpolation, planned, {}};
  TankOptions& tank = request.tank;
  const std::map<std::string, double*> known = {
      {"ramp", &tank.ramp},
      {"hold", &tank.hold},
      {"period", &tank.period},
      {"thruster_lag", &tank.thruster_lag},
      {"bandwidth", &tank.bandwidth},
      {"margin", &tank.margin},
      {"load", &tank.load},
      {"thrust_efficiency", &tank.imperfections.thrust_efficiency},
      {"thrust_noise", &tank.imperfections.thrust_noise},
      {"noticed_after", &tank.noticed_after}};
  for (const auto& [key, value] : options) {
    const std::string name = key.cast<std::string>();
    if (name == "invert_lag") {
      tank.invert_lag = flag_in(name, py::reinterpret_borrow<py::object>(value));
      continue;
    }
    if (name == "seed") {
      tank.imperfections.seed =
          std::uint64_t(integer_in("seed", py::reinterpret_borrow<py::object>(value)));
      continue;
    }
    if (name == "dies") {
      read_deaths(py::reinterpret_borrow<py::object>(value), answer.task->robot, tank);
      continue;
    }
    const auto found = known.find(name);
    if (found == known.end()) {
      throw py::type_error("simulate: got an unexpected argument '" + name + "'");
    }
    *found->second = number_in(name, py::reinterpret_borrow<py::object>(value));
  }
  check(tank);
  return request;
}

Answer held_answer(const Answer& answer) {
  const Problem& task = *answer.task;
  const Eigen::VectorXd& theta_r = answer.posture.theta_r;
  // The controller holds the end effector at its pose for theta_r.
  Options options;
  static_cast<Case&>(options) = answer.choice;
  options.check_collision = answer.collision;
  return evaluate(held_at(task, theta_r), held_theta_r(task, theta_r), options);
}

ScriptOptions script_options(const Problem& task, const Request& request) {
  ScriptOptions script;
  script.interpolation = request.interpolation.empty() ? usual_interpolation(task)
                                                       : parse_interpolation(request.interpolation);
  script.planned = request.planned;
  script.margin = request.tank.margin;
  return script;
}

namespace {

TankRun hold_posture(const Answer& answer, const Request& request) {
  const Answer held = held_answer(answer);
  if (!held.has_value() || held.capability.u.size() == 0 || held.capability.w.size() == 0) {
    throw BadValue("answer", shown(answer.choice.measure), "a posture with efforts and a wrench");
  }
  if (request.tank.load > 0) {
    return simulate_load(held, request.tank.load, request.integrator, request.tank);
  }
  const double planned =
      request.planned > 0 ? request.planned : held.task->c.dot(held.capability.h);
  if (!(planned > 0)) throw BadValue("planned", shown(planned), "a value > 0: none is possible");
  return simulate_posture(held, planned, request.integrator, request.tank);
}

TankRun carry_out(const Answer& answer, const Request& request) {
  const Problem& task = *answer.task;
  return simulate_trajectory(task, answer.trajectory, answer.choice.wrench,
                             find_trajectory_solver(answer.choice.solver),
                             script_options(task, request), request.integrator, request.tank)
      .run;
}

PyExperiment simulate(const PyAnswer& given, const std::string& integrator,
                      const std::string& interpolation, double planned, const py::kwargs& options) {
  const Answer& answer = given.answer;
  if (!answer.task->scenarios.empty()) {
    throw BadValue("answer", "a task with a list of scenarios",
                   "one wrench; simulate_scenarios takes lists");
  }
  Request request = read_request(given, integrator, interpolation, planned, options);
  PyExperiment result{{}, given.task};
  run_in_background(py::none(), [&](Watch& watch) {
    request.tank.interrupted = [&watch] { return watch.stop.load(); };
    result.run = answer.task->motion ? carry_out(answer, request) : hold_posture(answer, request);
  });
  return result;
}

/// One number of each sample.
template <class Number>
py::array of_samples(const PyExperiment& self, Number number) {
  Eigen::VectorXd v(self.run.samples.size());
  Eigen::Index i = 0;
  for (const TankSample& sample : self.run.samples) v[i++] = number(sample);
  return copy(v);
}

template <class Row>
py::array rows_of_samples(const PyExperiment& self, Eigen::Index cols, Row row) {
  RowMatrix table(self.run.samples.size(), cols);
  Eigen::Index i = 0;
  for (const TankSample& sample : self.run.samples) table.row(i++) = row(sample);
  return copy(table);
}

std::string repr_of_experiment(const PyExperiment& self) {
  const TankSummary& summary = self.run.summary;
  return fmt::format("<Experiment {}: {}, reading {:.6g} of {:.6g} planned {}>",
                     self.task.problem->name, summary.held ? "held" : "not held",
                     reading_of(summary), summary.planned, self.task.problem->unit());
}

// ---- Pickled experiments

/// The numbers of a sample beside its arrays; flags are 0 or 1.
std::vector<double> tank_numbers(const TankSample& s) {
  return {s.t,
          s.planned,
          s.reading,
          s.shortfall,
          double(s.saturated),
          double(s.relaxed),
          s.theta_r_error,
          s.configuration_error,
          s.position_error,
          s.deflection_error,
          s.violation,
          s.off_axis_force,
          s.off_axis_torque,
          s.speed,
          s.angle};
}

TankSample tank_sample(const std::vector<double>& n) {
  TankSample s;
  s.t = n[0];
  s.planned = n[1];
  s.reading = n[2];
  s.shortfall = n[3];
  s.saturated = n[4] != 0;
  s.relaxed = n[5] != 0;
  s.theta_r_error = n[6];
  s.configuration_error = n[7];
  s.position_error = n[8];
  s.deflection_error = n[9];
  s.violation = n[10];
  s.off_axis_force = n[11];
  s.off_axis_torque = n[12];
  s.speed = n[13];
  s.angle = n[14];
  return s;
}

py::list samples_state(const TankRun& run) {
  py::list list;
  for (const TankSample& s : run.samples) {
    list.append(
        py::make_tuple(tank_numbers(s), copy(Eigen::VectorXd(s.h_e)), copy(s.u), copy(s.theta_r)));
  }
  return list;
}

/// What Python shows of the summary; the rest follows from the samples.
py::tuple experiment_state(const PyExperiment& self) {
  const TankRun& run = self.run;
  const TankSummary& s = run.summary;
  const py::object motion =
      s.motion ? py::object(py::float_(s.motion->at_peak)) : py::object(py::none());
  return py::make_tuple(self.task, static_cast<int>(run.status), run.reason.str(),
                        samples_state(run), s.planned, s.mean, s.low, s.held, s.missed, motion);
}

PyExperiment experiment_of(const py::tuple& state) {
  PyExperiment self{{}, state[0].cast<PyTask>()};
  TankRun& run = self.run;
  run.conclude(static_cast<Status>(state[1].cast<int>()), state[2].cast<std::string>());
  for (const py::handle item : state[3]) {
    const auto parts = item.cast<py::tuple>();
    TankSample sample = tank_sample(parts[0].cast<std::vector<double>>());
    sample.h_e = vector("state", parts[1], 6);
    sample.u = vector("state", parts[2]);
    sample.theta_r = vector("state", parts[3]);
    run.samples.push_back(std::move(sample));
  }
  TankSummary& s = run.summary;
  s.planned = state[4].cast<double>();
  s.mean = state[5].cast<double>();
  s.low = state[6].cast<double>();
  s.held = state[7].cast<bool>();
  s.missed = state[8].cast<std::string>();
  if (!state[9].is_none()) s.motion.emplace().at_peak = state[9].cast<double>();
  return self;
}

constexpr const char* kSimulate = R"(Carries out an answer in the virtual tank.

A controller, thrusters with lag and a load cell show whether the robot holds the wrench. Ctrl-C ends
it; the record so far is returned, with status budget_exhausted.

Args:
    answer: an Answer with a value, of one contact.
    integrator: an integrator for stiff systems: "cvode" or "ida".
    interpolation: in time: "linear" or "spline"; empty: that of the scheme.
    planned: wrench along c [N or N m]; 0: the value of the answer, in time that between knots.
    ramp, hold: duration of each ramp and of the hold of a static task [s].
    period: time between two commands [s].
    thruster_lag: time constant of the thrusters [s].
    invert_lag: whether requested efforts are those that thrusters reach behind their lag.
    bandwidth: of the control of posture errors [rad/s].
    margin: fraction of the planned wrench that is not requested.
    load: mass that the end effector carries in place of the load cell [kg].
    thrust_efficiency, thrust_noise, seed: how the thrusters differ from the model.
    dies: {name: time} of thrusters and joint drives that exert nothing from a time on [s].
    noticed_after: time until the controller no longer counts on them [s].

Returns:
    Experiment: the record.

Raises:
    InputError: the answer has no value or no wrench, or a value is out of its range.

>>> answer = maxwrench.evaluate("planar/force", [0, 0])
>>> maxwrench.simulate(answer, hold=1).held
True
)";

}  // namespace

void add_tank(py::module_& m) {
  py::class_<PyExperiment> experiment(m, "Experiment", R"(The record of ``simulate``.

>>> answer = maxwrench.evaluate("planar/force", [0, 0])
>>> experiment = maxwrench.simulate(answer, ramp=1, hold=1)
>>> experiment.status, experiment.t.shape, experiment.h.shape
('reached', (300,), (300, 6))
>>> abs(experiment.reading - experiment.planned) < 0.02 * experiment.planned
True
)");
  const auto curve = [&experiment](const char* name, double TankSample::*member, const char* doc) {
    experiment.def_property_readonly(
        name,
        [member](const PyExperiment& e) {
          return of_samples(e, [member](const TankSample& s) { return s.*member; });
        },
        doc);
  };
  curve("t", &TankSample::t, "Times of the samples (N) [s].");
  curve("readings", &TankSample::reading, "Readings along c (N) [N or N m].");
  curve("planned_readings", &TankSample::planned, "Planned readings along c (N) [N or N m].");
  curve("theta_r_error", &TankSample::theta_r_error, "Errors of theta_r (N) [rad, m].");
  curve("position_error", &TankSample::position_error, "Errors of the end effector (N) [m].");
  experiment
      .def_property_readonly(
          "h",
          [](const PyExperiment& e) {
            return rows_of_samples(e, 6, [](const TankSample& s) { return s.h_e.transpose(); });
          },
          "Readings of the cell [force; torque] (N×6).")
      .def_property_readonly(
          "u",
          [](const PyExperiment& e) {
            return rows_of_samples(e, e.task.problem->robot.actuators(),
                                   [](const TankSample& s) { return s.u.transpose(); });
          },
          "Efforts (N×m) [N or N m].")
      .def_property_readonly(
          "reading", [](const PyExperiment& e) { return reading_of(e.run.summary); },
          "The reading that counts: mean of the hold, lowest along a path, that at the peak.")
      .def_property_readonly(
          "planned", [](const PyExperiment& e) { return e.run.summary.planned; },
          "The planned wrench along c [N or N m].")
      .def_property_readonly(
          "held", [](const PyExperiment& e) { return e.run.summary.held; },
          "Whether the wrench was held.")
      .def_property_readonly(
          "missed", [](const PyExperiment& e) { return e.run.summary.missed; },
          "Why it was not held, each value with the largest that is allowed.")
      .def_property_readonly(
          "status", [](const PyExperiment& e) { return to_string(e.run.status); },
          "How it ended: reached, or why not.")
      .def_property_readonly(
          "reason", [](const PyExperiment& e) { return e.run.reason.str(); },
          "Why it ended early; empty if it did not.")
      .def(
          "csv", [](const PyExperiment& e) { return tank_csv(*e.task.problem, e.run); },
          "Returns the samples as a CSV table.")
      .def_property_readonly(
          "task", [](const PyExperiment& e) { return e.task; }, "The Task.")
      .def("__repr__", &repr_of_experiment)
      .def(py::pickle(&experiment_state, &experiment_of));
  m.def("simulate", &simulate, py::arg("answer"), py::arg("integrator") = "cvode",
        py::arg("interpolation") = "", py::arg("planned") = 0.0, kSimulate);
  add_tank_scenarios(m);
}

}  // namespace maxwrench::python
