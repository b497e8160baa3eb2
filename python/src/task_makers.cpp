#include "maxwrench/task.h"
#include "problems/make/posture.h"
#include "python/src/arrays.h"
#include "python/src/parts.h"
#include "python/src/task_arguments.h"
#include "python/src/words.h"

// Tasks made in code: Static, Trajectory and Impulse.

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

void add_task_makers(py::module_& m) {
  m.def("Static", &make_static, py::arg("robot"), kStatic);
  m.def("Trajectory", &make_trajectory, py::arg("robot"), py::arg("path"), py::arg("knots"),
        kTrajectory);
  m.def("Impulse", &make_impulse, py::arg("robot"), py::arg("pose"), py::arg("T"), py::arg("knots"),
        kImpulse);
}

}  // namespace maxwrench::python