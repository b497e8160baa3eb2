"""Objects as plain data: to_dict, to_json and from_dict."""

import inspect
import json

import maxwrench as mw
import numpy as np
import pytest

# A page is a document, the others are code: of the user, of a running search, or without content.
NO_DATA = {"Measure", "Objective", "Page", "Search", "SearchEnded"}


def made_robot():
    sphere = mw.Hydrodynamics(mw.Pose([0, 0, 0.1], rpy=[0.1, 0.2, 0.3]), added_mass=np.array([2, 2, 2, 0, 0, 0]))
    rod = dict(inertia=[1e-3, 1e-2, 1e-2], com=(0.1, 0, 0))
    links = [mw.Link("base", 3, inertia=np.eye(3), volume=0.003, hydrodynamics=[sphere]), mw.Link("upper", 1, **rod), mw.Link("hand", 0.5, **rod)]
    joints = [
        mw.Joint("shoulder", "base", mw.Pose([0, 0, 0.2]), (0, 1, 0), q_min=-1, q_max=1, velocity_max=2, effort_max=40),
        mw.Joint("elbow", "upper", mw.Pose([0.4, 0, 0]), [0, 1, 0], q_min=-2, q_max=2, effort_max=np.float64(20)),
    ]
    return mw.make_robot(
        links,
        joints,
        thrusters=[mw.Thruster("bow", [0.2, 0, 0], [1, 0, 0], -5, 5)],
        base="x",
        end_effectors=[mw.EndEffector("tool", "hand", mw.Pose([0.4, 0, 0]))],
        shapes=[mw.Shape("hand", radius=0.05, half_length=0.1)],
        name="sketch",
        water_density=1000,
        mount=mw.Pose([0, 0, 0.1]),
    )


def tasks():
    push, two = mw.load("fixed/push"), mw.load("dual_arm/two_arms")
    start = mw.load("planar/trajectory").pose
    planar = mw.load("planar/force").robot
    screw = mw.Path.screw(start, duration=4, displacement=[0.2, 0.1, 0])
    spline = mw.Path.spline(np.array([0, 1.5]), [start, mw.Pose(start.p + [0.1, 0, 0], R=start.R)])
    return {
        "shipped": push,
        "in time": mw.load("uvms/valve_trajectory"),
        "two arms": two,
        "other limits": push.with_limits(-np.ones(7), np.ones(7)),
        "in code": mw.Static(made_robot(), joints={"shoulder": 0.2, "elbow": -0.4}, c="x", name="poke"),
        "ball": mw.Static(push.robot, pose=push.pose, ball=(["fx", "fy"], 0.5)),
        "set": mw.Static(push.robot, pose=push.pose, set=[[1, 0, 0, 0, 0, 0], [0, 2, 0, 0, 0, 0]], uncertainty={"torque": 0.1}),
        "nominal": mw.nominal(mw.Static(push.robot, uncertainty={"torque": 0.1})),
        "loss": mw.Static(push.robot, c="x", loss={"any": 1, "actuators": ["joint_2"], "joints": "locked", "brake": 100}),
        "payload": mw.Static(push.robot, pose=push.pose, payload={"com": [0, 0, 0.1]}),
        "screw": mw.Trajectory(planar, screw, knots=6, c="x"),
        "spline": mw.Trajectory(planar, spline, knots=4, c="x"),
        "impulse": mw.Impulse(planar, mw.load("planar/force").pose, T=1, knots=3, theta_0=[0, 0], c="x"),
    }


TASKS = tasks()


def again(thing):
    return type(thing).from_dict(json.loads(thing.to_json()))


@pytest.mark.parametrize("name", TASKS)
def test_a_task_is_made_again_with_the_same_values(name):
    task = TASKS[name]
    table = task.to_dict()
    assert json.loads(json.dumps(table, allow_nan=False)) == table
    assert (table["class"], table["name"], table["unit"]) == ("Task", task.name, task.unit)
    copy = mw.Task.from_dict(table)
    assert copy.to_dict() == table and repr(copy) == repr(task) and copy.digest == task.digest
    first, second = mw.evaluate(task, task.theta_r_default), mw.evaluate(copy, task.theta_r_default)
    assert second.status == first.status
    for number in ("beta", "u", "h", "gradient"):
        a, b = getattr(first, number), getattr(second, number)
        assert (a is None and b is None) or np.asarray(a).tobytes() == np.asarray(b).tobytes()  # bits


@pytest.mark.parametrize("name", ["shipped", "two arms", "in code", "screw"])
def test_a_robot_is_made_again(name):
    robot = TASKS[name].robot
    copy = again(robot)
    assert copy.to_dict() == robot.to_dict() and repr(copy) == repr(robot)
    assert copy.B.tobytes() == robot.B.tobytes() and copy.u_max.tobytes() == robot.u_max.tobytes()


def test_a_robot_in_code_is_its_parts():
    robot = made_robot()
    assert again(robot).to_dict() == robot.to_dict()
    with_parts = robot.to_dict()["with"]
    assert [mw.Link.from_dict(link).name for link in with_parts["links"]] == ["base", "upper", "hand"]


def test_a_robot_of_a_file(problems):
    for robot in (mw.Robot.from_toml(problems / "fixed/arm.toml"), mw.Robot.from_urdf(problems / "fixed/arm.urdf")):
        assert again(robot).to_dict() == robot.to_dict()


@pytest.mark.parametrize("name", ["screw", "spline"])
def test_a_path_is_made_again(name):
    start = mw.Pose([0.5, 0, 0.3], rpy=[0.1, 0.2, 0.3])
    path = {
        "screw": mw.Path.screw(start, 2, axis=[1, 2, 3], angle=0.7, timing="quintic"),
        "spline": mw.Path.spline([0, 1, 3], [start, mw.Pose([0.6, 0, 0.3]), mw.Pose([0.6, 0.2, 0.3])]),
    }[name]
    copy = again(path)
    assert copy.duration == path.duration == path.to_dict()["duration"]
    assert all(copy.at(t) == path.at(t) for t in np.linspace(0, path.duration, 7))


def test_a_pose_has_the_same_bits():
    pose = mw.Pose([1 / 3, -0.0, 1e-300], rpy=[0.1, 0.2, 0.3])
    assert again(pose) == pose and again(pose).matrix.tobytes() == pose.matrix.tobytes()


PARTS = [
    mw.Hydrodynamics(added_mass=np.ones(6)),
    mw.Link("rod", mass=0.1, com=[0.05, 0, 0], hydrodynamics=[mw.Hydrodynamics()]),
    mw.Gear("finger_1", ratio=-1),
    mw.Joint("finger_2", 1, gear=mw.Gear("finger_1")),  # without limits: infinity
    mw.Thruster("bow", position=[0.2, 0, 0]),
    mw.EndEffector("tool", "hand", mw.Pose([0.1, 0, 0])),
    mw.Shape("hull", "hull", points=np.eye(4)[:, :3], radius=0.1),
    mw.Direction([0, 0, -1, 0, 0, 0], min=0),
    mw.Contact("fist", "basis", basis=[mw.Direction([0, 0, 1, 0, 0, 0])], rest={"wrist": 0.1}, joints=("a", "b")),
]


@pytest.mark.parametrize("part", PARTS, ids=lambda part: type(part).__name__)
def test_parts_are_made_again(part):
    copy = again(part)
    assert type(copy) is type(part) and copy.to_dict() == part.to_dict()
    assert set(part.to_dict()) == {"class", *inspect.signature(type(part)).parameters}


def test_an_infinite_limit_is_written_and_read():
    joint = again(mw.Joint("turn"))
    assert (joint.q_min, joint.q_max) == (-np.inf, np.inf)
    assert mw.Joint("turn").to_dict()["q_max"] == {"float": "inf"}


def test_changed_files_are_seen(rejects):
    table = mw.load("fixed/push").to_dict()
    table["digest"] = "0123456789abcdef"
    assert "have changed" in str(rejects(mw.Task.from_dict, table))


@pytest.mark.parametrize(
    "kind, data, line",
    [
        (mw.Task, 3, "class: got a int, expected 'Task'"),
        (mw.Task, {}, "class: got None, expected 'Task'"),
        (mw.Task, {"class": "Pose"}, "class: got 'Pose', expected 'Task'"),
        (mw.Task, {"class": "Task"}, "class: got 'Task', expected a class of maxwrench that can be made again"),
        (mw.Task, {"class": "Task", "by": "eval", "with": {}}, "by: got 'eval', expected one of Impulse, Path.screw"),
        (mw.Task, {"class": "Task", "by": "load"}, "with: got None, expected the arguments of load"),
        (mw.Task, {"class": "Task", "by": "load", "with": {}}, "with: got load: missing a required argument"),
        (mw.Task, {"class": "Task", "by": "Task.robot", "with": {}}, "with: got 'task', expected the arguments of Task.robot"),
        (mw.Path, {"class": "Path", "by": "load", "with": {"name": "fixed/push"}}, "by: got 'load', expected what makes a Path"),
        (mw.Pose, {"class": "Pose", "p": [1, 2]}, "p: got shape (2,), expected an array of shape (3,)"),
        (mw.Link, {"class": "Link"}, "Link: got Link.__init__() missing 1 required"),
        (mw.Link, {"class": "Link", "name": "a", "weight": 3}, "Link: got Link.__init__() got an unexpected keyword"),
    ],
)
def test_wrong_data(rejects, kind, data, line):
    assert str(rejects(kind.from_dict, data)).startswith(line)


def test_what_cannot_be_written(rejects):
    assert rejects(mw.Link("rod", mass=object()).to_dict).key == "mass"


def seen():
    """A Posture, which only a measure sees."""
    postures = []

    class Look(mw.Measure):
        name = "look_at_data"

        def value(self, posture):
            postures.append(posture)
            return 1.0

    mw.add_measure(Look())
    mw.evaluate("planar/force", [0, 0], measure="look_at_data")
    return postures[0]


def test_a_posture_is_data():
    table = json.loads(seen().to_json())
    assert table == seen().to_dict() and len(table["J"]) == 6 and table["theta_r"] == [0, 0]


def test_an_error_is_data(rejects):
    error = rejects(mw.evaluate, "planar/force", [0, 0], measure="no")
    assert json.loads(error.to_json()) == error.to_dict()
    assert error.to_dict()["line"] == str(error) and error.to_dict()["key"] == "measure"


def test_results_are_json():
    force = mw.load("planar/force")
    sample = mw.sensitivity(force, actuators="elbow", friction=1, budget=20)
    for result in (mw.evaluate(force, [0, 0]), mw.evaluate(force, [[0, 0], [0, 1.2]]), sample, sample.losses[1]):
        assert json.loads(result.to_json()) == result.to_dict()


def test_every_class_with_data_has_these_methods():
    classes = {name for name in mw.__all__ if isinstance(getattr(mw, name), type)}
    assert NO_DATA < classes
    for name in classes - NO_DATA:
        kind = getattr(mw, name)
        assert callable(kind.to_dict) and callable(kind.to_json), name
        assert kind.to_dict.__doc__ and kind.to_json.__doc__, name
