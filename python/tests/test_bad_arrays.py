"""Arrays as arguments: what is not finite numbers of the right shape is rejected, in whatever order they are read."""

import maxwrench as mw
import numpy as np
import pytest

NAN, INF = np.nan, np.inf
J, TAU, LIMITS = np.eye(6), np.zeros(6), np.ones(6)
EYE = np.eye(2)


def static(**arguments):
    """A task in code with the robot of fixed/push."""
    task = mw.load("fixed/push")
    if "joints" not in arguments:
        arguments["pose"] = task.pose
    return mw.Static(task.robot, **arguments)


def changed(values, bad):
    """A copy whose third number is another one."""
    copy = np.array(values, dtype=float)
    copy.flat[2 % copy.size] = bad
    return copy


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


def test_masked_arrays(rejects):
    masked = np.ma.masked_array([0.1, 0.2], mask=[False, True])
    line = "theta_r: got a masked array, expected an array without masked numbers"
    assert str(rejects(mw.evaluate, "planar/force", masked)) == line
    assert rejects(mw.evaluate, "planar/force", np.ma.masked_array([[0.1, 0.2]] * 2, mask=[[0, 0], [0, 1]])).key == "theta_r"
    assert rejects(mw.linprog, [1, 1], EYE, masked).key == "b"
    # Where nothing is masked, all numbers count.
    assert mw.evaluate("planar/force", np.ma.masked_array([0.1, 0.2])).beta == mw.evaluate("planar/force", [0.1, 0.2]).beta


@pytest.mark.parametrize(
    "shape", [(), (0,), (1,), (3,), (0, 3), (2, 1), (5, 3), (1, 1, 2), (0, 0), (2, 0)], ids=str
)
def test_shapes_of_theta_r(rejects, shape):
    error = rejects(mw.evaluate, "planar/force", np.zeros(shape))
    assert error.key == "theta_r" and str(shape) in str(error)
    # One posture has two numbers, several have two in each row.
    assert "(2,)" in str(error) or ("(any, 2)" in str(error) and len(shape) > 1)


@pytest.mark.parametrize("shape", [(), (3,), (7, 2), (8, 3), (1, 8, 2), (2, 8)], ids=str)
def test_shapes_of_knots(rejects, shape):
    assert rejects(mw.evaluate, "planar/trajectory", np.zeros(shape)).key == "theta_r"


@pytest.mark.parametrize("bad", [NAN, INF, -INF])
@pytest.mark.parametrize(
    "task, shape", [("planar/force", (2,)), ("planar/force", (3, 2)), ("planar/trajectory", (8, 2))]
)
def test_numbers_that_are_not_finite(rejects, task, shape, bad):
    values = np.zeros(shape)
    values[(-1,) * len(shape)] = bad
    error = rejects(mw.evaluate, task, values)
    assert error.key == "theta_r" and "finite" in str(error) and "expected" in str(error)


NOT_FINITE = {
    "evaluate_joints q": ("q", lambda bad: mw.evaluate_joints("planar/force", changed([0, 0], bad))),
    "Pose p": (None, lambda bad: mw.Pose(changed([0, 0, 0], bad))),
    "Pose rpy": (None, lambda bad: mw.Pose(rpy=changed([0, 0, 0], bad))),
    "Pose R": (None, lambda bad: mw.Pose(R=changed(np.eye(3), bad))),
    "Pose quaternion": ("quaternion", lambda bad: mw.Pose(quaternion=changed([1, 0, 0, 0], bad))),
    "Pose matrix": (None, lambda bad: mw.Pose.from_matrix(changed(np.eye(4), bad))),
    "screw duration": ("duration", lambda bad: mw.Path.screw(mw.Pose(), bad)),
    "screw angle": ("angle", lambda bad: mw.Path.screw(mw.Pose(), 1, angle=bad)),
    "screw centre": ("centre", lambda bad: mw.Path.screw(mw.Pose(), 1, centre=changed([0, 0, 0], bad))),
    "screw displacement": (
        "displacement",
        lambda bad: mw.Path.screw(mw.Pose(), 1, displacement=changed([0, 0, 0], bad)),
    ),
    "screw axis": ("axis", lambda bad: mw.Path.screw(mw.Pose(), 1, axis=changed([0, 0, 0], bad))),
    "spline times": ("times", lambda bad: mw.Path.spline(changed([0, 1, 2], bad), [mw.Pose()] * 3)),
    "time on a path": (None, lambda bad: mw.Path.screw(mw.Pose(), 1).at(bad)),
    "Static c": (None, lambda bad: static(c=changed([1, 0, 0, 0, 0, 0], bad))),
    "Static reference": (None, lambda bad: static(reference=bad)),
    "Static desired": (None, lambda bad: static(desired=changed(LIMITS, bad))),
    "Static joints": (None, lambda bad: static(joints={"joint_2": bad})),
    "Static guess": (None, lambda bad: static(theta_r=["joint_7"], guess={"joint_2": bad})),
    "Static theta_r_default": (None, lambda bad: static(theta_r=["joint_7"], theta_r_default=[bad])),
    "Static range": (None, lambda bad: static(range={"yaw": [bad, 1]})),
    "Impulse T": (None, lambda bad: mw.Impulse(mw.load("fixed/push").robot, mw.Pose(), bad, 4)),
    "capability lower": ("lower", lambda bad: mw.capability(J, TAU, changed(-LIMITS, np.nan), LIMITS, "x")),
    "capability upper": ("upper", lambda bad: mw.capability(J, TAU, -LIMITS, changed(LIMITS, np.nan), "x")),
    "capability c": ("c", lambda bad: mw.capability(J, TAU, -LIMITS, LIMITS, changed(LIMITS, bad))),
    "capability B": ("B", lambda bad: mw.capability(J, TAU, -LIMITS, LIMITS, "x", changed(J, bad))),
    "capability free": ("free", lambda bad: mw.capability(J, TAU, -LIMITS, LIMITS, "x", free=changed(J, bad))),
    "scale tau_d": ("tau_d", lambda bad: mw.scale(None, [-1, -1], [1, 1], [0, bad], [1, 0])),
    "scale w": ("w", lambda bad: mw.scale(None, [-1, -1], [1, 1], [0, 0], [1, bad])),
    "linprog c": ("c", lambda bad: mw.linprog([1, bad], EYE, [1, 1])),
    "linprog A": ("A", lambda bad: mw.linprog([1, 1], changed(EYE, bad), [1, 1])),
    "linprog b": ("b", lambda bad: mw.linprog([1, 1], EYE, [1, bad])),
    "linprog l": ("l", lambda bad: mw.linprog([1, 1], EYE, [1, 1], [0, np.nan])),
    "linprog u": ("u", lambda bad: mw.linprog([1, 1], EYE, [1, 1], [0, 0], [np.nan, 1])),
}


@pytest.mark.parametrize("bad", [NAN, INF])
@pytest.mark.parametrize("key, call", NOT_FINITE.values(), ids=NOT_FINITE)
def test_not_finite_elsewhere(rejects, key, call, bad):
    error = rejects(call, bad)
    assert "expected" in str(error) and error.key and (key is None or error.key == key)


@pytest.mark.parametrize(
    "keys, call",
    [
        (["lower", "upper"], lambda: mw.capability(J, TAU, LIMITS, -LIMITS, "x")),
        (["lower", "upper"], lambda: mw.scale(None, [2, 0], [1, 1], [0, 0], [1, 0])),
        (["l"], lambda: mw.linprog([1, 1], EYE, [1, 1], [0, INF])),
        (["u"], lambda: mw.linprog([1, 1], EYE, [1, 1], [0, 0], [-INF, 1])),
    ],
    ids=["capability", "scale", "linprog l", "linprog u"],
)
def test_limits_that_leave_nothing(rejects, keys, call):
    assert rejects(call).key in keys


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
