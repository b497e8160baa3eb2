#include <fmt/format.h>
#include <pybind11/stl.h>

#include "lib/scenario/scenario_list.h"
#include "maxwrench/load.h"
#include "maxwrench/task.h"
#include "problems/make/bad_value.h"
#include "problems/make/posture.h"
#include "python/src/arrays.h"
#include "python/src/parts.h"
#include "python/src/words.h"

namespace maxwrench::python {
namespace {

PyTask load(const py::object& name, const std::string& limits) {
  const std::string text = path_in("name", name);
  py::dict how;
  how["name"] = name;
  how["limits"] = limits;
  return {std::make_shared<const Problem>(load_problem(text, {limits})), {"load", how}};
}

PyRobot robot_of(const PyTask& task) {
  py::dict how;
  how["task"] = task;
  return {std::shared_ptr<const Robot>(task.problem, &task.problem->robot), {"Task.robot", how}};
}

/// A limit of an actuator that must be a number.
double limit_in(const char* key, const Eigen::VectorXd& limits, Eigen::Index i) {
  require_finite(key, limits[i]);
  return limits[i];
}

/// The same task with other limits of the efforts. A joint has one limit for both directions.
PyTask with_limits(const PyTask& self, const py::object& u_min, const py::object& u_max) {
  require_no_scenarios(*self.problem, "with_limits");
  auto changed = std::make_shared<Problem>(*self.problem);
  Robot& robot = changed->robot;
  const Eigen::VectorXd low = vector("u_min", u_min, robot.actuators());
  const Eigen::VectorXd high = vector("u_max", u_max, robot.actuators());
  Eigen::Index i = 0;
  for (Thruster& thruster : robot.thrusters) {
    thruster.force_min = limit_in("u_min", low, i);
    thruster.force_max = limit_in("u_max", high, i++);
  }
  for (Joint& joint : robot.joints) {
    joint.effort_max = high[i];
    if (!(high[i] >= 0) || low[i] != -high[i]) {
      throw BadValue("u_min", shown(low[i]), "minus u_max, which is not negative, for a joint");
    }
    ++i;
  }
  complete_actuation(robot);
  if (!changed->dependent.empty()) prepare_ik_solutions(*changed);
  changed->digest.clear();
  py::dict how;
  how["self"] = self;
  how["u_min"] = copy(low);
  how["u_max"] = copy(high);
  return {std::move(changed), {"Task.with_limits", how}};
}

std::vector<std::string> theta_r_names(const Problem& task) {
  std::vector<std::string> names;
  for (int i = 0; i < task.redundancy(); ++i) names.push_back(task.theta_r_name(i));
  return names;
}

std::vector<std::string> joint_names_of(const Problem& task, const std::vector<int>& joints) {
  std::vector<std::string> names;
  for (const int joint : joints) names.push_back(task.robot.joints[std::size_t(joint)].name);
  return names;
}

std::string repr_of_task(const PyTask& self) {
  const Problem& task = *self.problem;
  return fmt::format(
      "<Task {}: {}, theta_r {}, unit {}>", task.name, task.type(),
      task.redundancy() == 0 ? "empty" : fmt::format("{}", fmt::join(theta_r_names(task), " ")),
      task.unit());
}
}  // namespace

py::tuple reduced(const Recipe& recipe, const std::string& digest) {
  const py::object remake = py::module_::import("maxwrench._pickle").attr("remake");
  return py::make_tuple(remake, py::make_tuple(recipe.first, recipe.second, digest));
}

PyTask task_of(const py::object& task) {
  if (py::isinstance<PyTask>(task)) return task.cast<PyTask>();
  if (!py::isinstance<py::str>(task) && !py::hasattr(task, "__fspath__")) {
    throw BadValue("task", "a " + std::string(py::str(py::type::of(task).attr("__name__"))),
                   "a Task, or the name or the file of one");
  }
  return load(task, "");
}

void add_tasks(py::module_& m) {
  py::class_<PyTask>(m, "Task", R"(A robot and a task. It cannot change.

``load`` reads one; ``Static``, ``Trajectory`` and ``Impulse`` make one in code.

>>> maxwrench.load("planar/force")
<Task planar/force: static, theta_r shoulder elbow, unit N>
)")
      .def_property_readonly(
          "name", [](const PyTask& t) { return t.problem->name; }, "The name.")
      .def_property_readonly(
          "type", [](const PyTask& t) { return t.problem->type(); },
          "The type: static, trajectory or impulse.")
      .def_property_readonly("robot", &robot_of, "The Robot.")
      .def_property_readonly(
          "end_effector",
          [](const PyTask& t) {
            return t.problem->robot.end_effectors[std::size_t(t.problem->end_effector)].name;
          },
          "The name of the end effector.")
      .def_property_readonly(
          "unit", [](const PyTask& t) { return t.problem->unit(); },
          "The unit of beta: N, N m, mixed of one wrench of both, kg of a payload, or - of a "
          "factor.")
      .def_property_readonly(
          "c", [](const PyTask& t) { return copy(Eigen::VectorXd(t.problem->c)); },
          "Unit direction [force; torque] of the wrench in the world (6).")
      .def_property_readonly(
          "W_any", [](const PyTask& t) { return copy(RowMatrix(t.problem->W_any)); },
          "Orthonormal basis of the wrenches that wrench=\"any\" allows (6×k).")
      .def_property_readonly(
          "pose", [](const PyTask& t) { return t.problem->pose; },
          "The Pose of the end effector in the world; the start of a path.")
      .def_property_readonly(
          "theta_r_names", [](const PyTask& t) { return theta_r_names(*t.problem); },
          "The names of the coordinates of theta_r (r).")
      .def_property_readonly(
          "theta_r_min", [](const PyTask& t) { return copy(t.problem->theta_r_min); },
          "Lower limits of theta_r (r) [rad or m].")
      .def_property_readonly(
          "theta_r_max", [](const PyTask& t) { return copy(t.problem->theta_r_max); },
          "Upper limits of theta_r (r) [rad or m].")
      .def_property_readonly(
          "theta_r_default", [](const PyTask& t) { return copy(t.problem->theta_r_default); },
          "Default theta_r (r) [rad or m].")
      .def_property_readonly(
          "dependent",
          [](const PyTask& t) { return joint_names_of(*t.problem, t.problem->dependent); },
          "The joints that follow from theta_r.")
      .def_property_readonly(
          "knots", [](const PyTask& t) { return knots_of(*t.problem); },
          "The number of knots of a table of theta_r; one for a static task.")
      .def_property_readonly(
          "default_knots",
          [](const PyTask& t) { return copy(RowMatrix(default_knots(*t.problem))); },
          "The table of theta_r at which a search begins (knots×r).")
      .def_property_readonly(
          "digest", [](const PyTask& t) { return t.problem->digest; },
          "Hash of the files of task and robot; empty if the task was made in code.")
      .def("with_limits", &with_limits, py::arg("u_min"), py::arg("u_max"),
           R"(Returns the same task with other limits of the efforts (m) [N or N m].

A joint has one limit for both directions: its u_min is minus its u_max.

Raises:
    InputError: limits cross, or those of a joint differ in size.

>>> task = maxwrench.load("planar/force")
>>> stronger = task.with_limits(2 * task.robot.u_min, 2 * task.robot.u_max)
>>> round(maxwrench.evaluate(stronger, [0, 0]).beta / maxwrench.evaluate(task, [0, 0]).beta)
2
)")
      .def("__repr__", &repr_of_task)
      .def("__reduce__", [](const PyTask& t) { return reduced(t.recipe, t.problem->digest); });
  m.def("load", &load, py::arg("name"), py::kw_only(), py::arg("limits") = "",
        R"(Reads a task and its robot.

Args:
    name: the name of a shipped task, such as "uvms/valve" (``tasks()`` lists them), or the path of
        a task file in TOML.
    limits: the name of the table in the robot's ``[limits]`` that counts. Empty: none.

Returns:
    Task: the task.

Raises:
    InputError: the file is missing or something in it is wrong.

>>> maxwrench.load("uvms/valve").unit
'N m'
)");
  m.def("tasks", &shipped_problems, R"(Returns the names of the shipped tasks.

>>> "uvms/valve" in maxwrench.tasks()
True
)");
}

}  // namespace maxwrench::python
