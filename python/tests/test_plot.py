"""Pictures of answers."""

import sys
from types import SimpleNamespace

import maxwrench as mw
import numpy as np
import pytest

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")
plt = pytest.importorskip("matplotlib.pyplot")


@pytest.fixture(autouse=True)
def close_figures():
    yield
    plt.close("all")


def labels(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


def inside(ax):
    """Whether the lines of three dimensions lie within the limits of the axes."""
    limits = np.array([ax.get_xlim(), ax.get_ylim(), ax.get_zlim()])
    points = np.hstack([np.array(line.get_data_3d()) for line in ax.lines])
    return (points >= limits[:, :1]).all() and (points <= limits[:, 1:]).all()


@pytest.mark.parametrize("name", ["planar/force", "uvms/lift", "mobile/push", "fixed/push", "dual_arm/bar_wall"])
def test_a_posture(name, tmp_path):
    answer = mw.solve(name, budget=300)
    ax = answer.plot()
    size = np.linalg.norm(answer.h[:3]) or np.linalg.norm(answer.h[3:])
    assert ax.get_title() == f"{name}: {answer.beta:.4g} {answer.unit}"
    assert any(label.startswith(("force", "torque")) and f"{size:.4g}" in label for label in labels(ax))
    assert inside(ax)
    skeleton = [line for line in ax.lines if line.get_marker() == "o"]
    assert len(skeleton) == len(answer.task.robot.joint_names)
    np.testing.assert_allclose(np.array(skeleton[0].get_data_3d())[:, 1], answer.links[1, :3, 3])
    ax.figure.savefig(tmp_path / "posture.png")


def test_force_and_torque_of_any_wrench():
    answer = mw.solve("uvms/valve", wrench="any", budget=300)
    names = [label.split()[0] for label in labels(answer.plot())]
    assert names[:2] == ["force", "torque"]


def test_a_posture_without_value_shows_the_direction():
    ax = mw.evaluate("uvms/valve", [0, 0, 0, 0]).plot()
    assert ax.get_title().endswith("no value") and "direction of the torque" in labels(ax)


def test_without_scipy_bodies_are_points(monkeypatch):
    monkeypatch.setitem(sys.modules, "scipy.spatial", None)
    ax = mw.solve("mobile/push", budget=100).plot()
    assert sum(line.get_marker() == "." for line in ax.lines) == len(mw.load("mobile/push").robot.bodies)


def test_the_polytope_and_the_force_have_one_scale(monkeypatch):
    answer = mw.solve("planar/force", budget=300)
    half = 2 * np.linalg.norm(answer.h)
    square = half * np.array([[1, 0, -1, 0], [0, 1, 0, -1], [0, 0, 0, 0]])
    shape = SimpleNamespace(status="optimal", vertices=square.T, triangles=np.array([[0, 1, 2], [0, 2, 3]]))
    monkeypatch.setattr(mw._core, "polytope", lambda of, directions, wrench: shape, raising=False)
    drawn = []
    monkeypatch.setattr(mw._plot, "_draw_faces", lambda ax, faces, colour, alpha: drawn.append((np.array(faces), alpha)))
    answer.plot()
    p = answer.end_effector[:3, 3]
    corner = max(np.linalg.norm(faces - p, axis=-1).max() for faces, alpha in drawn if alpha == 0.1)
    tip = max(np.linalg.norm(faces - p, axis=-1).max() for faces, alpha in drawn if alpha == 1)
    assert corner == pytest.approx(2 * tip)


def test_torques_have_their_set():
    """The corners of the set of torques, at the tool, with the torque within it: the set reaches as far along c as beta."""
    answer = mw.solve("uvms/valve", budget=300)
    shape = mw.polytope(answer, directions="torque")
    along = shape.vertices @ answer.task.c[3:]
    assert along.max() >= answer.beta - 1e-9
    ax = answer.plot()
    assert "all torques that it can exert" in [text.get_text() for text in ax.get_legend().get_texts()]


def test_curves(tmp_path):
    task = mw.load("uvms/valve_trajectory")
    answer = mw.evaluate(task, task.theta_r_default)
    beta, theta_r, efforts = answer.plot()
    np.testing.assert_array_equal(beta.lines[0].get_ydata(), answer.betas)
    assert beta.get_ylabel() == "beta [N m]" and efforts.get_xlabel() == "time [s]"
    assert labels(theta_r) == task.theta_r_names and labels(efforts) == task.robot.actuator_names
    shares = np.array([line.get_ydata() for line in efforts.lines[:12]])
    # The thrusters' limits are -40 and 50 N; rear_left_vertical is at 50 N, front_right_vertical at -40 N.
    np.testing.assert_allclose([shares[4].min(), shares[7].max()], [-1, 1], atol=1e-9)
    assert len({(line.get_color(), line.get_linestyle()) for line in efforts.lines[:12]}) == 12
    beta.figure.savefig(tmp_path / "motion.png")


def test_given_axes():
    figure = plt.figure()
    ax = figure.add_subplot(projection="3d")
    assert mw.solve("planar/force", budget=100).plot(ax) is ax
    panels = plt.subplots(3)[1]
    task = mw.load("planar/trajectory")
    assert list(mw.evaluate(task, task.theta_r_default).plot(panels)) == list(panels)


def test_wrong_axes():
    task = mw.load("planar/trajectory")
    for call in (
        lambda: mw.solve("planar/force", budget=100).plot(plt.subplots()[1]),
        lambda: mw.evaluate(task, task.theta_r_default).plot(plt.subplots()[1]),
    ):
        with pytest.raises(mw.InputError, match="^ax: got .*, expected .*axes"):
            call()


def test_no_posture():
    with pytest.raises(mw.InputError, match="answer: got no posture"):
        mw.Answer.plot(SimpleNamespace(q=None))


def test_without_matplotlib(monkeypatch):
    answer = mw.evaluate("planar/force", [0, 0])
    monkeypatch.setitem(sys.modules, "matplotlib.pyplot", None)
    with pytest.raises(ImportError, match="^plot needs Matplotlib"):
        answer.plot()


def test_a_value_without_a_wrench():
    ax = mw.solve("fixed/push", measure="manipulability", budget=50).plot()
    assert "direction of the force" in [text.get_text() for text in ax.get_legend().get_texts()]


def test_a_stretched_arm_that_lifts_is_not_seen_from_above(tmp_path):
    link = '<inertial><mass value="1"/><inertia ixx="1e-2" ixy="0" ixz="0" iyy="1e-2" iyz="0" izz="1e-2"/></inertial>'
    joint = '<joint name="{0}" type="{1}"><parent link="{2}"/><child link="{3}"/><origin xyz="0.4 0 0"/>{4}</joint>'
    moves = '<axis xyz="0 1 0"/><limit lower="-3" upper="3" effort="40" velocity="2"/>'
    arm = f'<robot name="arm"><link name="a"/><link name="b">{link}</link><link name="c">{link}</link><link name="d"/>'
    arm += joint.format("j1", "revolute", "a", "b", moves) + joint.format("j2", "revolute", "b", "c", moves)
    (tmp_path / "arm.urdf").write_text(arm + joint.format("j3", "fixed", "c", "d", "") + "</robot>")
    task = mw.Static(mw.Robot.from_urdf(tmp_path / "arm.urdf"), joints={"j1": 0, "j2": 0}, c="z")
    assert mw.evaluate_joints(task, [0, 0]).plot().elev < 80
