"""Wrenches and Jacobians about other points, in other axes and in other orders."""

import maxwrench as mw
import numpy as np
import pytest

RNG = np.random.default_rng(4)
POSE = mw.Pose([0.3, -1.2, 2.0], rpy=[0.4, -1.1, 2.3])
REFERENCES = ("LOCAL", "LOCAL_WORLD_ALIGNED", "WORLD")


def act(R, p, force):
    """pinocchio.SE3.act of a force [linear; angular]: (R f, R n + p x R f)."""
    f, n = R @ force[:3], R @ force[3:]
    return np.concatenate([f, n + np.cross(p, f)])


def test_moved_follows_the_definition():
    h, at = RNG.normal(size=6), RNG.normal(size=3)
    force, torque = h[:3], h[3:] + np.cross(POSE.p - at, h[:3])
    R = POSE.R
    np.testing.assert_allclose(mw.moved(h, POSE, at=at), [*force, *torque])
    turned = [*(R.T @ force), *(R.T @ torque)]
    for frame in ("end_effector", POSE, R):
        np.testing.assert_allclose(mw.moved(h, POSE, at=at, frame=frame), turned)
    np.testing.assert_array_equal(mw.moved(h, POSE), h)


def test_a_lever():
    # 5 N upwards at x = 2 m: about the origin it turns about -y with 10 N m.
    np.testing.assert_array_equal(mw.moved([0, 0, 5, 0, 0, 0], mw.Pose([2, 0, 0]), at=[0, 0, 0]), [0, 0, 5, 0, -10, 0])


def test_pinocchio_wrenches():
    # Pinocchio's WORLD and LOCAL are related by SE3.act, LOCAL_WORLD_ALIGNED and LOCAL by the rotation.
    h = RNG.normal(size=6)
    local = mw.to_pinocchio(h, POSE, "LOCAL")
    np.testing.assert_allclose(mw.to_pinocchio(h, POSE, "WORLD"), act(POSE.R, POSE.p, local), atol=1e-12)
    np.testing.assert_allclose([*(POSE.R @ local[:3]), *(POSE.R @ local[3:])], h, atol=1e-12)
    np.testing.assert_array_equal(mw.to_pinocchio(h), h)


def test_pinocchio_jacobians():
    # A body turns with w and its end effector moves with v. The point of the body at the world's
    # origin moves with v + w x (0 - p).
    v, w = RNG.normal(size=3), RNG.normal(size=3)
    J = np.concatenate([v, w])[:, None]
    world = mw.to_pinocchio(J, POSE, "WORLD", jacobian=True)[:, 0]
    np.testing.assert_allclose(world, [*(v - np.cross(w, POSE.p)), *w], atol=1e-12)
    local = mw.to_pinocchio(J, POSE, "LOCAL", jacobian=True)[:, 0]
    np.testing.assert_allclose(local, [*(POSE.R.T @ v), *(POSE.R.T @ w)], atol=1e-12)


@pytest.mark.parametrize("reference", REFERENCES)
def test_pinocchio_keeps_power_and_comes_back(reference):
    h, J = RNG.normal(size=(5, 6)), RNG.normal(size=(5, 6, 7))
    poses = np.stack([mw.Pose(RNG.normal(size=3), rpy=RNG.normal(size=3)).matrix for _ in h])
    h_there = mw.to_pinocchio(h, poses, reference)
    J_there = mw.to_pinocchio(J, poses, reference, jacobian=True)
    power = np.einsum("ki,kij->kj", h, J)
    np.testing.assert_allclose(np.einsum("ki,kij->kj", h_there, J_there), power, atol=1e-12)
    np.testing.assert_allclose(mw.from_pinocchio(h_there, poses, reference), h, atol=1e-12)
    np.testing.assert_allclose(mw.from_pinocchio(J_there, poses, reference, jacobian=True), J, atol=1e-12)
    one = mw.to_pinocchio(h[3], poses[3], reference)  # rows do not mix
    np.testing.assert_allclose(one, h_there[3], atol=1e-12)


def test_drake_has_torques_first():
    np.testing.assert_array_equal(mw.to_drake(np.arange(6)), [3, 4, 5, 0, 1, 2])
    J = RNG.normal(size=(2, 6, 6))  # six joints: only the flag tells Jacobians from wrenches
    np.testing.assert_array_equal(mw.to_drake(J, jacobian=True), np.concatenate([J[:, 3:], J[:, :3]], axis=1))
    np.testing.assert_array_equal(mw.from_drake(mw.to_drake(J)), J)
    np.testing.assert_array_equal(mw.from_drake(mw.to_drake(J, jacobian=True), jacobian=True), J)


def test_capability_in_frames_of_pinocchio():
    # The same arm described about its own point or about the world's origin pushes equally hard.
    task = mw.load("fixed/push")
    answer = mw.evaluate(task, task.theta_r_default)
    limits = task.robot.u_min, task.robot.u_max
    J = mw.to_pinocchio(answer.J, task.pose, "WORLD", jacobian=True)
    c = mw.to_pinocchio(task.c, task.pose, "WORLD")
    there = mw.capability(J, answer.tau_d, *limits, c, task.robot.B)
    assert there.beta == pytest.approx(answer.beta * np.linalg.norm(c), rel=1e-9)
    here = mw.capability(mw.from_pinocchio(J, task.pose, "WORLD", jacobian=True), answer.tau_d, *limits, task.c, task.robot.B)
    assert here.beta == pytest.approx(answer.beta, rel=1e-9)


def test_wrench_of_an_answer():
    task = mw.load("uvms/valve")
    answer = mw.evaluate(task, task.theta_r_default)
    p = answer.end_effector[:3, 3]
    np.testing.assert_allclose(answer.wrench_at(), answer.h)
    np.testing.assert_allclose(answer.wrench_at(at=p + [1, 0, 0]), [*answer.h[:3], *(answer.h[3:] - np.cross([1, 0, 0], answer.h[:3]))])
    motion = mw.load("planar/trajectory")
    moving = mw.evaluate(motion, motion.theta_r_default)
    turned = moving.wrench_at("end_effector")
    R = moving.end_effector[-1, :3, :3]
    np.testing.assert_allclose(turned[-1], [*(R.T @ moving.h[-1, :3]), *(R.T @ moving.h[-1, 3:])], atol=1e-12)


@pytest.mark.parametrize(
    "call, key",
    [
        (lambda: mw.to_drake([1, 2, 3]), "wrench"),
        (lambda: mw.to_drake(5.0), "wrench"),
        (lambda: mw.to_drake(["a"] * 6), "wrench"),
        (lambda: mw.to_drake([np.nan] * 6), "wrench"),
        (lambda: mw.to_drake(np.zeros(6), jacobian=True), "jacobian"),
        (lambda: mw.to_pinocchio(np.zeros(6), POSE, "TOOL"), "reference"),
        (lambda: mw.to_pinocchio(np.zeros(6), None, "WORLD"), "pose"),
        (lambda: mw.to_pinocchio(np.zeros(6), np.eye(3), "WORLD"), "pose"),
        (lambda: mw.moved(np.zeros(6), POSE, at=[1, 2]), "at"),
        (lambda: mw.moved(np.zeros(6), POSE, at=[1, 2, np.inf]), "at"),
        (lambda: mw.moved(np.zeros(6), POSE, frame="tool"), "frame"),
        (lambda: mw.moved(np.zeros(6), POSE, frame=2 * np.eye(3)), "pose.rpy"),
        (lambda: mw.evaluate("uvms/valve", [0, 0, 0, 0]).wrench_at(), "answer"),
    ],
)
def test_wrong_arguments(call, key):
    with pytest.raises(mw.InputError) as caught:
        call()
    assert caught.value.key == key and "\n" not in str(caught.value)
