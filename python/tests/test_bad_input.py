"""Arguments of a wrong type, unknown names and numbers out of range: an InputError of one line that names them."""

import maxwrench as mw
import numpy as np
import pytest

GOOD = [0.1, 0.2]  # theta_r of planar/force
J, TAU, LIMITS = np.eye(6), np.zeros(6), np.ones(6)
EYE = np.eye(2)


def robot():
    return mw.load("fixed/push").robot


def pose():
    return mw.load("fixed/push").pose


def test_paths(rejects):
    poses = [mw.Pose()] * 2
    rejects(mw.Path.spline, [0], poses[:1])
    rejects(mw.Path.spline, [], [])
    rejects(mw.Path.spline, [0, 0], poses)
    rejects(mw.Path.spline, [1, 2], poses)
    rejects(mw.Path.spline, [0, 1], poses * 2)
    rejects(mw.Path.spline, [0, 1], [mw.Pose(), mw.Pose(rpy=[0, 0, np.pi])])
    rejects(mw.Path.screw, mw.Pose(), 0)
    rejects(mw.Path.screw, mw.Pose(), -1)
    assert rejects(mw.Path.screw, mw.Pose(), 1, axis=[0, 0, 0]).key == "axis"
    assert rejects(mw.Path.screw, mw.Pose(), 1, timing="fast").key == "timing"


WRONG_TYPES = {
    "measure": lambda: mw.evaluate("planar/force", GOOD, measure=3),
    "wrench": lambda: mw.evaluate("planar/force", GOOD, wrench=None),
    "solver": lambda: mw.evaluate("planar/force", GOOD, solver=3),
    "threads text": lambda: mw.evaluate("planar/force", [GOOD], threads="a"),
    "threads fraction": lambda: mw.evaluate("planar/force", [GOOD], threads=2.5),
    "threads of 1e12": lambda: mw.evaluate("planar/force", [GOOD], threads=10**12),
    "threads of one posture": lambda: mw.evaluate("planar/force", GOOD, threads=-1),
    "check_collision": lambda: mw.evaluate("planar/force", GOOD, check_collision="no"),
    "callback of one posture": lambda: mw.evaluate("planar/force", GOOD, callback=3),
    "callback of rows": lambda: mw.evaluate("planar/force", [GOOD], callback=3),
    "callback of solve": lambda: mw.solve("planar/force", budget=5, callback=3),
    "search": lambda: mw.solve("planar/force", budget=5, search=None),
    "seed negative": lambda: mw.solve("planar/force", budget=5, seed=-1),
    "seed fraction": lambda: mw.solve("planar/force", budget=5, seed=1.5),
    "seed of 2^64": lambda: mw.solve("planar/force", budget=5, seed=2**64),
    "budget text": lambda: mw.solve("planar/force", budget="a"),
    "budget of 1e30": lambda: mw.solve("planar/force", budget=10**30),
    "task number": lambda: mw.solve(3),
    "task None": lambda: mw.evaluate(None, GOOD),
    "task robot": lambda: mw.evaluate(robot(), [0]),
    "load number": lambda: mw.load(3),
    "load limits": lambda: mw.load("planar/force", limits=3),
    "load surrogate": lambda: mw.load("\udcff"),
    "urdf None": lambda: mw.Robot.from_urdf(None),
    "urdf tool": lambda: mw.Robot.from_urdf("a.urdf", tool=3),
    "urdf base": lambda: mw.Robot.from_urdf("a.urdf", base=3),
    "urdf packages": lambda: mw.Robot.from_urdf("a.urdf", packages=3),
    "urdf srdf": lambda: mw.Robot.from_urdf("a.urdf", srdf=3),
    "Static robot": lambda: mw.Static(3),
    "Static pose": lambda: mw.Static(robot(), pose=[0, 0, 0]),
    "Static joints": lambda: mw.Static(robot(), joints=4),
    "Static joints of texts": lambda: mw.Static(robot(), joints={"joint_1": "a"}),
    "Static c": lambda: mw.Static(robot(), c=3),
    "Static frame": lambda: mw.Static(robot(), frame=3),
    "Static name": lambda: mw.Static(robot(), name=3),
    "Static end_effector": lambda: mw.Static(robot(), end_effector=3),
    "Static any": lambda: mw.Static(robot(), any=3),
    "Static free": lambda: mw.Static(robot(), free=[3]),
    "Static range": lambda: mw.Static(robot(), range=3),
    "Static range of numbers": lambda: mw.Static(robot(), range={3: [0, 1]}),
    "Static range of one": lambda: mw.Static(robot(), range={"z": 3}),
    "Static along": lambda: mw.Static(robot(), along=3),
    "Static theta_r": lambda: mw.Static(robot(), theta_r=7),
    "Static guess": lambda: mw.Static(robot(), guess=[1]),
    "Static reference": lambda: mw.Static(robot(), reference="a"),
    "Static desired": lambda: mw.Static(robot(), desired="a"),
    "Trajectory path": lambda: mw.Trajectory(robot(), 3, 4),
    "Trajectory knots": lambda: mw.Trajectory(robot(), mw.Path.screw(mw.Pose(), 1), 2.5),
    "Trajectory scheme": lambda: mw.Trajectory(robot(), mw.Path.screw(mw.Pose(), 1), 4, scheme=3),
    "Trajectory rates": lambda: mw.Trajectory(robot(), mw.Path.screw(mw.Pose(), 1), 4, rates="no"),
    "Trajectory instants": lambda: mw.Trajectory(robot(), mw.Path.screw(mw.Pose(), 1), 4, instants_per_interval="a"),
    "Impulse pose": lambda: mw.Impulse(robot(), [0, 0, 0], 1, 4),
    "Impulse T": lambda: mw.Impulse(robot(), pose(), "a", 4),
    "Impulse start": lambda: mw.Impulse(robot(), pose(), 1, 4, start=3),
    "Impulse t_h": lambda: mw.Impulse(robot(), pose(), 1, 4, t_h="a"),
    "Path poses": lambda: mw.Path.spline([0, 1], [1, 2]),
    "Path start": lambda: mw.Path.screw([0, 0, 0], 1),
    "Path duration": lambda: mw.Path.screw(mw.Pose(), "a"),
    "Path time": lambda: mw.Path.screw(mw.Pose(), 1).at("a"),
    "capability solver": lambda: mw.capability(J, TAU, -LIMITS, LIMITS, "x", solver=3),
    "capability c": lambda: mw.capability(J, TAU, -LIMITS, LIMITS, None),
    "linprog solver": lambda: mw.linprog([1, 1], EYE, [1, 1], solver=3),
    "linprog A": lambda: mw.linprog([1, 1], "A", [1, 1]),
}


@pytest.mark.parametrize("call", WRONG_TYPES.values(), ids=WRONG_TYPES)
def test_wrong_types(rejects, call):
    line = str(rejects(call))
    assert "expected" in line and "C++" not in line and "std::" not in line and "maxwrench._core" not in line


@pytest.mark.parametrize("function", [mw.Static, mw.load, mw.evaluate, mw.solve], ids=lambda f: f.__name__)
def test_unknown_arguments_are_type_errors(function):
    first = {mw.Static: [robot()], mw.evaluate: ["planar/force", GOOD]}.get(function, ["planar/force"])
    with pytest.raises(TypeError) as caught:
        function(*first, colour=3)
    assert "colour" in str(caught.value) and len(str(caught.value).splitlines()) == 1


def test_missing_arguments_are_named():
    with pytest.raises(TypeError, match="solve: missing a required argument: 'task'"):
        mw.solve()
    with pytest.raises(TypeError, match="theta_r"):
        mw.evaluate("planar/force")
    with pytest.raises(TypeError, match="too many positional arguments"):
        mw.solve("planar/force", 3)


def test_a_path_with_a_zero_is_shown(rejects):
    assert "b" in str(rejects(mw.load, "a\0b")).partition("expected")[0]


UNKNOWN_NAMES = {
    "task": ("problem", lambda: mw.load("planar/nothing")),
    "limits": ("limits", lambda: mw.load("uvms/valve", limits="no")),
    "measure": ("measure", lambda: mw.evaluate("planar/force", GOOD, measure="no")),
    "wrench": ("wrench", lambda: mw.evaluate("planar/force", GOOD, wrench="no")),
    "solver": ("solver", lambda: mw.evaluate("planar/force", GOOD, solver="no")),
    "search": ("search", lambda: mw.solve("planar/force", search="no")),
    "solver of linprog": ("solver", lambda: mw.linprog([1, 1], EYE, [1, 1], solver="no")),
    "joint": ("pose.joints.elbow", lambda: mw.Static(robot(), joints={"elbow": 1})),
    "posture": ("joints", lambda: mw.Static(robot(), joints="home")),
    "axis": ("c", lambda: mw.Static(robot(), pose=pose(), c="up")),
    "two signs": ("c", lambda: mw.Static(robot(), pose=pose(), c="--x")),
    "empty axis": ("c", lambda: mw.Static(robot(), pose=pose(), c="")),
    "coordinate": (None, lambda: mw.Static(robot(), pose=pose(), free="height")),
    "wrench axis": (None, lambda: mw.Static(robot(), pose=pose(), any=["fw"])),
    "end effector": (None, lambda: mw.Static(robot(), pose=pose(), end_effector="hand")),
    "redundant joint": (None, lambda: mw.Static(robot(), pose=pose(), theta_r=["joint_8"])),
    "frame": ("frame", lambda: mw.Static(robot(), pose=pose(), frame="tool0")),
    "along": ("along", lambda: mw.Static(robot(), pose=pose(), along="world")),
    "pose and joints": ("pose", lambda: mw.Static(robot(), pose=pose(), joints={})),
    "start": ("start", lambda: mw.Impulse(robot(), pose(), 1, 4, start="moving")),
    "knot": (None, lambda: mw.Impulse(robot(), pose(), 1, 4, t_h=5)),
    "scheme": ("scheme", lambda: mw.Trajectory(robot(), mw.Path.screw(pose(), 1), 4, scheme="linear")),
    "base": (None, lambda: mw.Robot.from_urdf("a.urdf", base="x,u")),
    "timing": ("timing", lambda: mw.Path.screw(mw.Pose(), 1, timing="fast")),
}


@pytest.mark.parametrize("key, call", UNKNOWN_NAMES.values(), ids=UNKNOWN_NAMES)
def test_unknown_names(rejects, key, call):
    error = rejects(call)
    assert "expected" in str(error) and error.key and (key is None or error.key == key)


@pytest.mark.parametrize("text", ["a\nb", "a\tb", "a\rb"])
def test_lines_stay_one_line(rejects, text):
    # What is after a line break is shown, too.
    for call in (
        lambda: mw.load(text),
        lambda: mw.evaluate("planar/force", GOOD, measure=text),
        lambda: mw.Static(robot(), pose=pose(), c=text),
        lambda: mw.Static(robot(), joints={text: 1}),
        lambda: mw.Path.screw(mw.Pose(), 1, timing=text),
    ):
        line = str(rejects(call))
        assert "b" in line.partition("expected")[0] and "expected" in line


def test_numbers_out_of_range(rejects):
    assert rejects(mw.solve, "planar/force", budget=-1).key == "budget"
    assert rejects(mw.solve, "planar/force", budget=10**9).key == "budget"
    assert rejects(mw.solve, "planar/force", budget=5, threads=-1).key == "threads"
    assert rejects(mw.evaluate, "planar/force", [GOOD], threads=-1).key == "threads"
    assert rejects(mw.capability, J, TAU, -LIMITS, LIMITS, "x", threads=5000).key == "threads"
    for knots in (0, -1, 10**8):
        rejects(mw.Trajectory, robot(), mw.Path.screw(pose(), 1), knots)
    for instants in (0, -1, 10**7):
        rejects(mw.Trajectory, robot(), mw.Path.screw(pose(), 1), 4, instants_per_interval=instants)
    for T in (0, -1, np.inf):
        rejects(mw.Impulse, robot(), pose(), T, 4)


def test_choices_that_do_not_fit(rejects):
    rejects(mw.evaluate, "planar/force", GOOD, measure="ellipsoid", solver="clp")
    rejects(mw.evaluate, "planar/force", GOOD, wrench="any", solver="facets")
    rejects(mw.evaluate, "planar/trajectory", GOOD, measure="ellipsoid")
    rejects(mw.solve, "planar/trajectory", search="facet_sqp", budget=5)
    rejects(mw.evaluate_joints, "planar/trajectory", GOOD)
    rejects(mw.evaluate_joints, "planar/two_arms", [0, 0, 0, 0])
