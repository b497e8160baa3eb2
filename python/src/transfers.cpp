#include "problems/make/bad_value.h"
#include "python/src/parts.h"
#include "python/src/words.h"

namespace maxwrench::python {
namespace {

PyTask make_transfer(const PyRobot& robot, const py::dict& start, const py::dict& end, double T,
                     int knots, const py::dict& payload, int instants_per_interval, bool rates,
                     const std::string& end_effector, const std::string& name) {
  TaskSpec spec;
  spec.robot = *robot.robot;
  spec.name = name.empty() ? robot.robot->name : name;
  spec.end_effector = end_effector;
  if (end_effector.empty() && spec.robot.end_effectors.size() == 1) {
    spec.end_effector = spec.robot.end_effectors.front().name;
  }
  spec.from = numbers_by_name("from", start);
  spec.to = numbers_by_name("to", end);
  MotionTask& motion = spec.motion.emplace();
  motion.transfer = true;
  motion.T = T;
  motion.k = knots;
  motion.instants_per_interval = instants_per_interval;
  motion.rates = rates;
  py::dict tables;
  tables["payload"] = payload;
  read_scenario_arguments({}, tables, spec);
  const py::object copied = py::module_::import("copy").attr("deepcopy");
  py::dict how;
  how["robot"] = robot;
  how["start"] = copied(start);
  how["end"] = copied(end);
  how["T"] = T;
  how["knots"] = knots;
  how["payload"] = copied(payload);
  how["instants_per_interval"] = instants_per_interval;
  how["rates"] = rates;
  how["end_effector"] = end_effector;
  how["name"] = name;
  return {std::make_shared<const Problem>(make_problem(spec)), {"Transfer", how}};
}

constexpr const char* kTransfer =
    R"(Makes a transfer: the largest mass [kg] that a fixed arm moves between two postures.

It is at rest at both ends, and the end effector is free in between.

Args:
    robot: the Robot, whose base is fixed.
    start: joint positions [rad or m] by name at the start, of all joints to the end effector.
    end: likewise at the end.
    T: duration [s].
    knots: k, the number of knots with both ends; a table of theta_r has k - 2 rows.
    payload: a dict with the keys of ``[payload]``.
    instants_per_interval: instants between neighbouring knots.
    rates: whether limits of the rates of efforts apply.
    end_effector: its name; not needed if the robot has one.
    name: name of the task in what is printed.

Returns:
    Task: the task. Its ``default_knots`` are the straight line.

Raises:
    InputError: a value is wrong.

>>> arm = maxwrench.load("fixed/push").robot
>>> low = dict(zip(arm.joint_names, [0, 0.3, 0, -1.5, 0, -0.6, 0]))
>>> high, point = low | {"joint_2": 0.8}, {"com": [0, 0, 0]}
>>> carry = maxwrench.Transfer(arm, low, high, T=2, knots=6, payload=point)
>>> carry.type, carry.default_knots.shape
('transfer', (4, 7))
)";

}  // namespace

void add_transfers(py::module_& m) {
  m.def("Transfer", &make_transfer, py::arg("robot"), py::arg("start"), py::arg("end"),
        py::arg("T"), py::arg("knots"), py::kw_only(), py::arg("payload"),
        py::arg("instants_per_interval") = 4, py::arg("rates") = true, py::arg("end_effector") = "",
        py::arg("name") = "", kTransfer);
}

}  // namespace maxwrench::python
