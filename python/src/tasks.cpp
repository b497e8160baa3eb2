#include <fmt/format.h>
#include <pybind11/stl.h>

#include "lib/scenario/scenario_list.h"
#include "maxwrench/load.h"
#include "maxwrench/task.h"
#include "problems/make/bad_value.h"
#include "problems/make/posture.h"
#include "python/src/arrays.h"
#include "python/src/parts.h"
#include "python/src/task_arguments.h"
#include "python/src/words.h"

namespace maxwrench::python {
namespace {

/// An argument that the caller can no longer change.
py::object kept(const py::handle& value) {
  const bool changes = py::isinstance<py::array>(value) || py::isinstance<py::list>(value) ||
                       py::isinstance<py::dict>(value);
  if (!changes) return py::reinterpret_borrow<py::object>(value);
  return py::module_::import("copy").attr("deepcopy")(value);
}

/// The recipe of a task made of a robot.
Recipe recipe_of(const char* function, const PyRobot& robot, const py::kwargs& arguments) {
  py::dict how;
  for (const auto& [key, value] : arguments) how[key] = kept(value);
  how["robot"] = robot;
  return {function, how};
}

PyTask make_static(const PyRobot& robot, const py::kwargs& given) {
  py::dict arguments = given.attr("copy")();
  const bool posed = arguments.contains("pose") || arguments.contains("joints");
  TaskSpec spec = begin_spec(robot, arguments, false);
  require_empty(arguments, "Static");
  Problem problem = posed ? make_problem(spec) : make_at_some_posture(std::move(spec));
  return {std::make_shared<const Problem>(std::move(problem)), recipe_of("Static", robot, given)};
}

PyTask make_trajectory(const PyRobot& robot, const PyPath& path, int knots,
                       const py::kwargs& given) {
  py::dict arguments = given.attr("copy")();
  TaskSpec spec = begin_spec(robot, arguments, true);
  MotionTask motion;
  motion.table = wrenches_in(arguments);
  motion.path = path.path;
  motion.T = path.path.duration();
  motion.k = knots;
  read_scheme(arguments, motion);
  require_empty(arguments, "Trajectory");
  spec.pose = motion.path.pose(0);
  spec.motion = motion;
  Recipe recipe = recipe_of("Trajectory", robot, given);
  recipe.second["path"] = path;
  recipe.second["knots"] = knots;
  return {std::make_shared<const Problem>(make_problem(spec)), recipe};
}

PyTask make_impulse(const PyRobot& robot, const Pose<double>& pose, double T, int knots,
                    const py::kwargs& given) {
  py::dict arguments = given.attr("copy")();
  TaskSpec spec = begin_spec(robot, arguments, true);
  MotionTask motion;
  motion.impulse = true;
  motion.T = T;
  motion.k = knots;
  motion.instants_per_interval = 16;
  read_scheme(arguments, motion);
  motion.start = parse_start(text_in("start", taken(arguments, "start", py::str("static"))));
  motion.t_h = integer_in("t_h", taken(arguments, "t_h", py::int_(0)));
  const py::object theta_0 = taken(arguments, "theta_0");
  if (!theta_0.is_none()) motion.theta_0 = vector("theta_0", theta_0);
  require_empty(arguments, "Impulse");
  spec.pose = pose;
  spec.motion = motion;
  Recipe recipe = recipe_of("Impulse", robot, given);
  recipe.second["pose"] = pose;
  recipe.second["T"] = T;
  recipe.second["knots"] = knots;
  return {std::make_shared<const Problem>(make_problem(spec)), recipe};
}

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

constexpr const char* kStatic =
    R"(Makes a static task in code: to hold a pose and exert the largest wrench.

Args:
    robot: the Robot.
    pose: the Pose of the end effector in the world.
    joints: instead of pose, joint positions [rad or m] by name, or the name of a posture of the
        robot (``robot.states``), that put the end effector there. Without either, the joints at
        rest, or another posture from which the end effector moves freely.
    c: direction [force; torque] (6) of the wrench that the robot exerts, of any length, or "x",
        "y", "z", "rx", "ry", "rz" with a sign if need be. Default: "z", a lift, unless set, ball
        or payload is given.
    set: in place of c, several wrenches [force; torque] (N×6), which keep their lengths [N; N m].
        The value is the factor by which each of them can be exerted.
    ball: axes and radius [N or N m], as ``(["fx", "fy"], 0.5)`` or a dict: a ball of forces or of
        torques that is added to c or to each wrench of set, or stands alone.
    hold: whether the robot must also hold its posture without a wrench.
    current: steady velocity of the water in the world [m/s]. Default: that of the robot.
    uncertainty: what is not known, a dict with the keys of the table ``[uncertainty]`` of a task
        file: half widths of mass [kg], com [m], volume [m^3] and cob [m] by link; trim [kg],
        payload, thrust and torque (shares), current.
    loss: the actuators that may be lost, a dict with the keys of ``[loss]``: any and actuators, or
        cases; joints, friction, brake.
    payload: in place of a wrench, a dict with the keys of ``[payload]``: com [m], volume_per_kg
        [m^3/kg], cob [m]. The value is a mass [kg].
    frame: axes of c, set, ball, any and desired: "world", or "end_effector", with which they turn.
    any: the wrenches that ``wrench="any"`` allows, of fx, fy, fz, tx, ty, tz. Default: all that do
        work.
    end_effector: its name; not needed if the robot has one.
    free: coordinates of the pose that are free, of x, y, z, roll, pitch, yaw.
    range: limits [min, max] of such coordinates by name [m; rad].
    along: axes of these coordinates: "pose" or "end_effector".
    contact: a Contact: a second end effector that touches the environment.
    theta_r: names of the redundant joints. Default: the program chooses them.
    theta_r_default: their default positions.
    guess, guess_base: joint positions and base coordinates by name that select the IK solution.
    reference: wrench along c, for measures of the efforts at a given wrench [N or N m].
    desired: units of the axes of the wrench (6), for measures of all axes together.
    name: name of the task in what is printed.

Returns:
    Task: the task.

Raises:
    InputError: a value is wrong; the message names it as the key of a task file.

>>> push = maxwrench.load("fixed/push")
>>> task = maxwrench.Static(push.robot, pose=push.pose, c="-x")
>>> carry = maxwrench.Static(push.robot, pose=push.pose, payload={"com": [0, 0, 0.1]})
>>> carry.unit
'kg'
)";

constexpr const char* kTrajectory = R"(Makes a task in time: a wrench along a path.

Args:
    robot: the Robot.
    path: the Path of the end effector.
    knots: k, the number of knots of theta_r.
    scheme: how knots become a motion: "spline", "forward" or "ends".
    instants_per_interval: for the scheme "spline".
    rates: whether limits of the rates of efforts apply.
    thruster_lag: time constant of the thrusters whose commands must be within the limits [s].
    payload: in place of c, a dict with the keys of ``[payload]``: the value is the mass [kg] that
        the robot carries along the path.
    wrenches: in place of c, a table of wrenches over time (N×7), rows [t, force, torque] with t
        from 0 to the duration of the path: the value is their factor.
    others: as of ``Static``, but for pose, joints, free, range, along, contact and ball. Of the
        uncertain values only thrust and torque.

Raises:
    InputError: a value is wrong.

>>> motion = maxwrench.load("planar/trajectory")
>>> path = maxwrench.Path.screw(motion.pose, duration=4, displacement=[0.2, 0.1, 0])
>>> maxwrench.Trajectory(motion.robot, path, knots=6, c="x").knots
6
)";

constexpr const char* kImpulse =
    R"(Makes an impulse: the peak of a wrench at a pose within a given time.

Args:
    robot: the Robot.
    pose: the Pose of the end effector.
    T: duration [s].
    knots: k, the number of knots of theta_r without the one at the start.
    scheme: "spline", "forward", "backward" or "backward_stop".
    start: how it starts: "static", "rest", "zero" or "free".
    t_h: the knot of the peak, 1 to k; 0: the best one.
    theta_0: theta_r at the start (r).
    others: as of ``Trajectory``.

Raises:
    InputError: a value is wrong.

>>> force = maxwrench.load("planar/force")
>>> maxwrench.Impulse(force.robot, force.pose, T=1, knots=3, theta_0=[0, 0], c="x").type
'impulse'
)";

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
  m.def("Static", &make_static, py::arg("robot"), kStatic);
  m.def("Trajectory", &make_trajectory, py::arg("robot"), py::arg("path"), py::arg("knots"),
        kTrajectory);
  m.def("Impulse", &make_impulse, py::arg("robot"), py::arg("pose"), py::arg("T"), py::arg("knots"),
        kImpulse);
}

}  // namespace maxwrench::python
