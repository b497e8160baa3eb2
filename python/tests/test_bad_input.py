"""Bad input gives an InputError of one line that names the argument, what was given and what was expected."""

import pathlib

import maxwrench as mw
import numpy as np
import pytest

NAN, INF = np.nan, np.inf
GOOD = [0.1, 0.2]  # theta_r of planar/force
J, TAU, LIMITS = np.eye(6), np.zeros(6), np.ones(6)
EYE = np.eye(2)


def robot():
    return mw.load("fixed/push").robot


def pose():
    return mw.load("fixed/push").pose


# Anything that is not an array of finite real numbers of the right shape.
NOT_NUMBERS = {
    "None": None,
    "text": "0,0",
    "texts": ["a", "b"],
    "bytes": b"ab",
    "complex": np.zeros(2, complex),
    "object": np.array([0.1, None], dtype=object),
    "bool": np.array([True, False]),
    "dict": {1: 2},
    "ragged": [[0, 0], [0]],
    "durations": np.array([0, 0], "m8[s]"),
    "dates": np.array(["2020", "2021"], "M8[Y]"),
    "records": np.zeros(2, [("x", float)]),
    "iterator": iter([0, 0]),
    "huge integers": [10**400, 0],
    "object()": object(),
}


@pytest.mark.parametrize("value", NOT_NUMBERS.values(), ids=NOT_NUMBERS)
def test_what_is_not_numbers(rejects, value):
    error = rejects(mw.evaluate, "planar/force", value)
    assert error.key == "theta_r" and "expected" in str(error)
    assert rejects(mw.capability, J, value, -LIMITS, LIMITS, "x").key == "tau_d"
    assert rejects(mw.linprog, value, EYE, [1, 1]).key == "c"
    assert rejects(mw.linprog, [1, 1], EYE, value).key == "b"
    assert rejects(mw.scale, None, value, [1, 1], [0, 0], [1, 0]).key == "lower"


@pytest.mark.parametrize(
    "shape", [(), (0,), (1,), (3,), (0, 3), (2, 1), (5, 3), (1, 1, 2), (0, 0), (2, 0)], ids=str
)
def test_shapes_of_theta_r(rejects, shape):
    error = rejects(mw.evaluate, "planar/force", np.zeros(shape))
    assert error.key == "theta_r" and str(shape) in str(error) and "(2,)" in str(error) or ", 2)" in str(error)


@pytest.mark.parametrize("shape", [(), (3,), (7, 2), (8, 3), (1, 8, 2), (2, 8)], ids=str)
def test_shapes_of_knots(rejects, shape):
    assert rejects(mw.evaluate, "planar/trajectory", np.zeros(shape)).key == "theta_r"


@pytest.mark.parametrize("bad", [NAN, INF, -INF])
@pytest.mark.parametrize("task, shape", [("planar/force", (2,)), ("planar/force", (3, 2)), ("planar/trajectory", (8, 2))])
def test_numbers_that_are_not_finite(rejects, task, shape, bad):
    values = np.zeros(shape)
    values[(-1,) * len(shape)] = bad
    error = rejects(mw.evaluate, task, values)
    assert error.key == "theta_r" and "finite" in str(error) and "expected" in str(error)


def test_not_finite_elsewhere(rejects):
    assert rejects(mw.evaluate_joints, "planar/force", [NAN, 0]).key == "q"
    assert rejects(mw.Pose, [NAN, 0, 0]).key
    assert rejects(mw.Pose, rpy=[INF, 0, 0]).key
    assert rejects(mw.Pose.from_matrix, np.full((4, 4), NAN)).key == "matrix"
    assert rejects(mw.Path.screw, mw.Pose(), NAN).key == "duration"
    assert rejects(mw.Path.screw, mw.Pose(), 1, angle=INF).key == "angle"
    assert rejects(mw.Path.screw, mw.Pose(), 1, centre=[0, 0, NAN]).key == "centre"
    assert rejects(mw.Path.screw, mw.Pose(), 1, axis=[0, 0, NAN]).key == "axis"
    assert rejects(mw.Path.spline, [0, NAN], [mw.Pose()] * 2).key == "times"
    rejects(mw.Path.screw(mw.Pose(), 1).at, NAN)
    rejects(mw.Static, robot(), pose=pose(), c=[NAN, 0, 0, 0, 0, 0])
    rejects(mw.Static, robot(), pose=pose(), reference=NAN)
    rejects(mw.Static, robot(), joints={"joint_2": NAN})
    rejects(mw.Static, robot(), pose=pose(), theta_r=["joint_7"], theta_r_default=[NAN])
    rejects(mw.Static, robot(), pose=pose(), range={"yaw": [NAN, 1]})
    rejects(mw.Impulse, robot(), pose(), NAN, 4)


def test_limits_and_matrices_that_are_not_finite(rejects):
    upper = LIMITS.copy()
    upper[2] = NAN
    assert rejects(mw.capability, J, TAU, -LIMITS, upper, "x").key == "upper"
    assert rejects(mw.capability, J, TAU, upper, LIMITS, "x").key == "lower"
    assert rejects(mw.capability, J, TAU, LIMITS, -LIMITS, "x").key in ("lower", "upper")  # they cross
    assert rejects(mw.capability, J, TAU, -LIMITS, LIMITS, upper).key == "c"
    assert rejects(mw.capability, J, TAU, -LIMITS, LIMITS, "x", np.diag(upper)).key == "B"
    assert rejects(mw.capability, J, TAU, -LIMITS, LIMITS, "x", free=np.diag(upper)).key == "free"
    assert rejects(mw.scale, None, [-1, -1], [1, 1], [0, NAN], [1, 0]).key == "tau_d"
    assert rejects(mw.scale, None, [-1, -1], [1, 1], [0, 0], [1, INF]).key == "w"
    assert rejects(mw.linprog, [1, NAN], EYE, [1, 1]).key == "c"
    assert rejects(mw.linprog, [1, 1], EYE * NAN, [1, 1]).key == "A"
    assert rejects(mw.linprog, [1, 1], EYE, [1, INF]).key == "b"
    assert rejects(mw.linprog, [1, 1], EYE, [1, 1], [0, NAN]).key == "l"
    assert rejects(mw.linprog, [1, 1], EYE, [1, 1], [0, 0], [-INF, 1]).key == "u"


def test_shapes_of_arrays(rejects):
    for bad in (np.zeros(6), np.zeros((5, 6)), np.zeros((6, 6, 2))):
        rejects(mw.capability, bad, TAU, -LIMITS, LIMITS, "x")
    assert rejects(mw.capability, np.zeros((2, 6, 6)), np.zeros((3, 6)), -LIMITS, LIMITS, "x").key == "tau_d"
    assert rejects(mw.capability, J, np.zeros(5), -LIMITS, LIMITS, "x").key == "tau_d"
    assert rejects(mw.capability, J, TAU, -LIMITS[:5], LIMITS, "x").key == "lower"
    assert rejects(mw.capability, J, TAU, -LIMITS, 1, "x").key == "upper"
    assert rejects(mw.capability, J, TAU, -LIMITS, LIMITS, [1, 0, 0]).key == "c"
    assert rejects(mw.capability, J, TAU, -LIMITS, LIMITS, np.zeros(6)).key == "c"
    assert rejects(mw.capability, J, TAU, -LIMITS, LIMITS, "x", np.eye(5)).key == "B"
    assert rejects(mw.capability, J, TAU, -LIMITS, LIMITS, "x", free=np.zeros((5, 1))).key == "free"
    assert rejects(mw.capability, J, TAU, -LIMITS, LIMITS, "x", free=np.zeros(6)).key == "free"
    assert rejects(mw.linprog, [1, 1], np.eye(3), [1, 1]).key == "A"
    assert rejects(mw.linprog, [1, 1], [1, 1], [1]).key == "A"
    assert rejects(mw.linprog, [1, 1], EYE, [1]).key == "b"
    assert rejects(mw.linprog, [1, 1], EYE, [1, 1], [0]).key == "l"
    assert rejects(mw.linprog, [1, 1], EYE, [1, 1], None, [[1, 1]]).key == "u"
    assert rejects(mw.evaluate_joints, "planar/force", [0]).key == "q"
    assert rejects(mw.Pose, [1, 2]).key == "p"
    assert rejects(mw.Pose, R=np.eye(2)).key == "R"
    assert rejects(mw.Pose.from_matrix, np.eye(3)).key == "matrix"


def test_rotations(rejects):
    rejects(mw.Pose, R=2 * np.eye(3))
    rejects(mw.Pose, R=np.diag([1, 1, -1]))  # a reflection
    rejects(mw.Pose, rpy=[0, 0, 0], R=np.eye(3))
    assert rejects(mw.Pose, quaternion=[0, 0, 0, 0]).key == "quaternion"
    assert rejects(mw.Pose, quaternion=[1, 1, 0, 0]).key == "quaternion"
    last_row = np.eye(4)
    last_row[3, 0] = 1
    assert rejects(mw.Pose.from_matrix, last_row).key == "matrix"


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
    first = [robot()] if function is mw.Static else ["planar/force"]
    with pytest.raises(TypeError) as caught:
        function(*first, colour=3)
    assert function is not mw.Static or "colour" in str(caught.value)


def test_unknown_names(rejects):
    assert rejects(mw.load, "planar/nothing").key == "problem"
    assert rejects(mw.load, "uvms/valve", limits="no").key == "limits"
    assert rejects(mw.evaluate, "planar/force", GOOD, measure="no").key == "measure"
    assert rejects(mw.evaluate, "planar/force", GOOD, wrench="no").key == "wrench"
    assert rejects(mw.evaluate, "planar/force", GOOD, solver="no").key == "solver"
    assert rejects(mw.solve, "planar/force", search="no").key == "search"
    assert rejects(mw.linprog, [1, 1], EYE, [1, 1], solver="no").key == "solver"
    assert rejects(mw.Static, robot(), joints={"elbow": 1}).key == "pose.joints.elbow"
    rejects(mw.Static, robot(), joints="home")
    rejects(mw.Static, robot(), pose=pose(), c="up")
    rejects(mw.Static, robot(), pose=pose(), c="--x")
    rejects(mw.Static, robot(), pose=pose(), c="")
    rejects(mw.Static, robot(), pose=pose(), free="height")
    rejects(mw.Static, robot(), pose=pose(), any=["fw"])
    rejects(mw.Static, robot(), pose=pose(), end_effector="hand")
    rejects(mw.Static, robot(), pose=pose(), theta_r=["joint_8"])
    rejects(mw.Static, robot(), pose=pose(), frame="tool0")
    rejects(mw.Static, robot(), pose=pose(), along="world")
    rejects(mw.Static, robot(), pose=pose(), joints={})  # one of both
    rejects(mw.Impulse, robot(), pose(), 1, 4, start="moving")
    rejects(mw.Impulse, robot(), pose(), 1, 4, t_h=5)
    rejects(mw.Trajectory, robot(), mw.Path.screw(pose(), 1), 4, scheme="linear")
    for text in ("a\nb", "a\tb", "a\rb"):
        rejects(mw.evaluate, "planar/force", GOOD, measure=text)
        rejects(mw.load, text)
    assert "b" in str(rejects(mw.load, "a\0b"))  # the line does not end at the zero


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
    for T in (0, -1, INF):
        rejects(mw.Impulse, robot(), pose(), T, 4)


def test_choices_that_do_not_fit(rejects):
    rejects(mw.evaluate, "planar/force", GOOD, measure="ellipsoid", solver="clp")
    rejects(mw.evaluate, "planar/force", GOOD, wrench="any", solver="facets")
    rejects(mw.evaluate, "planar/trajectory", GOOD, measure="ellipsoid")
    rejects(mw.solve, "planar/trajectory", search="facet_sqp", budget=5)
    rejects(mw.evaluate_joints, "planar/trajectory", GOOD)
    rejects(mw.evaluate_joints, "planar/two_arms", [0, 0, 0, 0])


def test_missing_files(tmp_path, problems, command):
    gone = tmp_path / "gone.toml"
    for call in (
        lambda: mw.load(gone),
        lambda: mw.load("planar/nothing"),
        lambda: mw.Robot.from_toml(gone),
        lambda: mw.Robot.from_urdf(gone),
        lambda: mw.Robot.from_urdf(problems / "fixed" / "arm.urdf", srdf=gone),
    ):
        with pytest.raises(mw.MissingFileError) as caught:
            call()
        error = caught.value
        assert isinstance(error, FileNotFoundError) and isinstance(error, mw.InputError)
        assert len(str(error).splitlines()) == 1 and error.file and error.value and error.expected and error.key
        assert error.file in str(error)
    assert isinstance(mw.InputError("a"), ValueError) and mw.InputError("a").key is None


def test_a_file_that_is_there_is_not_missing(rejects, tmp_path):
    for path in (tmp_path, "/dev/null"):
        assert not isinstance(rejects(mw.load, path), mw.MissingFileError)
    (tmp_path / "task.toml").write_text('type = "static')
    assert not isinstance(rejects(mw.load, tmp_path / "task.toml"), mw.MissingFileError)


def test_paths_of_bytes(problems):
    name = str(problems / "fixed" / "push.toml").encode()
    assert mw.load(name).unit == "N"  # os.fspath may return bytes


def test_package_folders_may_be_paths(problems):
    urdf = problems / "fixed" / "arm.urdf"
    assert mw.Robot.from_urdf(urdf, packages=[pathlib.Path("/tmp")]).name == mw.Robot.from_urdf(urdf).name


@pytest.mark.parametrize(
    "old, new, key",
    [
        ("[pose]", "[pose", "line 7"),
        ("c = [1, 0, -0.5, 0, 0, 0]", "c = [1, 0, nan, 0, 0, 0]", "wrench.c"),
        ("c = [1, 0, -0.5, 0, 0, 0]", "c = [1, 0]", "wrench.c"),
        ("c = [1, 0, -0.5, 0, 0, 0]", "c = [0, 0, 0, 0, 0, 0]", "wrench.c"),
        ("c = [1, 0, -0.5, 0, 0, 0]", "", "wrench.c"),
        ("xyz = [0.6, 0.1, 0.5]", 'xyz = "here"', "pose.xyz"),
        ('type = "static"', 'type = "dynamic"', "type"),
        ('robot = "arm.toml"', 'robot = "gone.toml"', "robot"),
        ('joints = ["joint_7"]', 'joints = ["joint_8"]', "theta_r.joints"),
        ("default = [0]", "default = [7]", "theta_r.default"),
        ("[theta_r]", "colour = 1\n[theta_r]", "wrench.colour"),
    ],
)
def test_broken_files_give_the_line_of_the_command(command, rejects, problems, tmp_path, old, new, key):
    for name in ("push.toml", "arm.toml", "arm.urdf"):
        (tmp_path / name).write_bytes((problems / "fixed" / name).read_bytes())
    file = tmp_path / "push.toml"
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new, 1))
    error = rejects(mw.load, file)
    printed = command("eval", file)
    assert printed.returncode == 2 and printed.stderr == f"maxwrench: {error}\n"
    assert error.key == key and error.file == str(file)
    assert error.value in str(error) and error.expected in str(error)


@pytest.mark.parametrize(
    "words, call",
    [
        (["eval", "no/no"], lambda: mw.load("no/no")),
        (["eval", "/"], lambda: mw.load("/")),
        (["eval", "uvms/valve", "--limits", "no"], lambda: mw.load("uvms/valve", limits="no")),
        (["eval", "planar/force", "--measure", "no"], lambda: mw.evaluate("planar/force", GOOD, measure="no")),
        (["eval", "planar/force", "--measure", "a\nb"], lambda: mw.evaluate("planar/force", GOOD, measure="a\nb")),
        (["eval", "planar/force", "--solver", "no"], lambda: mw.evaluate("planar/force", GOOD, solver="no")),
        (["eval", "planar/force", "--wrench", "no"], lambda: mw.evaluate("planar/force", GOOD, wrench="no")),
        (["eval", "planar/force", "--measure", "ellipsoid", "--solver", "clp"],
         lambda: mw.evaluate("planar/force", GOOD, measure="ellipsoid", solver="clp")),
        (["eval", "uvms/valve", "--measure", "manipulability", "--wrench", "any"],
         lambda: mw.evaluate("uvms/valve", [0, 0, 0, 0], measure="manipulability", wrench="any")),
        (["eval", "planar/trajectory", "--measure", "ellipsoid"],
         lambda: mw.evaluate("planar/trajectory", GOOD, measure="ellipsoid")),
        (["solve", "planar/force", "--search", "no"], lambda: mw.solve("planar/force", search="no")),
        (["solve", "planar/force", "--search", "cmaes+"], lambda: mw.solve("planar/force", search="cmaes+")),
        (["solve", "planar/trajectory", "--search", "facet_sqp"],
         lambda: mw.solve("planar/trajectory", search="facet_sqp")),
    ],
)
def test_the_line_is_that_of_the_command(command, rejects, words, call):
    error = rejects(call)
    printed = command(*words)
    assert printed.returncode == 2 and printed.stdout == ""
    # The command names its option where the package has an argument.
    assert printed.stderr.removeprefix("maxwrench: ").removeprefix("--") == f"{error}\n"


def test_arrays_in_any_order_are_read():
    values = np.random.default_rng(1).uniform(-0.5, 0.5, (7, 2))
    reference = mw.evaluate("planar/force", values)
    wide = np.zeros((7, 6))
    wide[:, ::3] = values
    frozen = values.copy()
    frozen.flags.writeable = False
    forms = {
        "Fortran": np.asfortranarray(values),
        "strided": wide[:, ::3],
        "negative": values[::-1, ::-1].copy()[::-1, ::-1],
        "transposed": values.T.copy().T,
        "read-only": frozen,
        "list": values.tolist(),
        "tuple": tuple(map(tuple, values)),
        "big endian": values.astype(">f8"),
        "long double": values.astype(np.longdouble),
        "unaligned": np.frombuffer(b"\0" + values.tobytes(), offset=1).reshape(7, 2),
        "broadcast": np.broadcast_to(values, (1, 7, 2))[0],
        "matrix": np.matrix(values),
    }
    for name, form in forms.items():
        rows = mw.evaluate("planar/force", form)
        assert np.array_equal(rows.beta, reference.beta, equal_nan=True), name
        assert np.array_equal(rows.u, reference.u, equal_nan=True), name
    single = mw.evaluate("planar/force", np.float32([0.25, -0.5]))  # exact in single precision
    assert single.beta == mw.evaluate("planar/force", [0.25, -0.5]).beta
    assert mw.evaluate("planar/force", np.array([0, 1])).beta == mw.evaluate("planar/force", [0.0, 1.0]).beta


def test_jacobians_in_any_order_are_read():
    rng = np.random.default_rng(2)
    jacobians, tau_d = rng.normal(size=(4, 6, 7)), rng.normal(size=(4, 7)) * 0.1
    limits = np.ones(7)
    reference = mw.capability(jacobians, tau_d, -limits, limits, "z")
    others = [
        (np.asfortranarray(jacobians), np.asfortranarray(tau_d)),
        (jacobians.transpose(0, 2, 1).copy().transpose(0, 2, 1), tau_d.T.copy().T),
        (jacobians[:, ::-1, ::-1].copy()[:, ::-1, ::-1], np.repeat(tau_d, 2, axis=1)[:, ::2]),
        (jacobians.tolist(), tau_d.tolist()),
    ]
    for form_J, form_tau in others:
        mine = mw.capability(form_J, form_tau, -limits, limits, "z")
        assert np.array_equal(mine.beta, reference.beta) and np.array_equal(mine.u, reference.u)
    A = rng.normal(size=(2, 4))
    for form in (np.asfortranarray(A), A[::-1].copy()[::-1], np.repeat(A, 3, axis=1)[:, ::3]):
        mine, plain = (mw.linprog([1, 2, 3, 4], matrix, [0.1, 0.2], -np.ones(4), np.ones(4)) for matrix in (form, A))
        assert np.array_equal(mine.x, plain.x)
