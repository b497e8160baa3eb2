"""Balls of wrenches, with and without other wrenches beside them, and the losses and margins of such tasks."""

import maxwrench as mw
import numpy as np
import pytest

SOLVERS = ["condensed", "simplex", "clp", "glpk", "ipopt"]


def lift(**arguments):
    """The shipped lift with another wrench."""
    task = mw.load("uvms/lift")
    return mw.Static(task.robot, pose=task.pose, theta_r=task.theta_r_names, theta_r_default=task.theta_r_default, **arguments)


def value(task, theta_r=None, **options):
    at = task.theta_r_default if theta_r is None else theta_r
    return mw.evaluate(task, at, check_collision=False, **options)


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_ball_of_two_axes_with_any_wrench_has_the_reference_value(solver):
    # Of an independent model.
    answer = value(lift(ball=(["fx", "fy"], 1)), wrench="any", solver=solver)
    assert answer.status == "optimal" and answer.beta == pytest.approx(88.01163, abs=6e-6)
    (ends,) = answer.scenarios()
    assert ends["high"] == pytest.approx(answer.beta, abs=1e-6) and ends["low"] == 0 and ends["held"]


@pytest.mark.parametrize(
    "axes, radius, free",
    [(["fx", "fy"], 2.0, None), (["tx", "tz"], 0.5, ["fx", "tx", "tz"]), (["fz"], 3.0, None), (["ty"], 0.25, ["fx", "ty"])],
)
def test_a_ball_with_any_wrench_is_the_worst_of_its_wrenches(axes, radius, free):
    options = {} if free is None else {"any": free}
    ball = lift(ball={"axes": axes, "radius": radius}, **options)
    names = ["fx", "fy", "fz", "tx", "ty", "tz"]
    basis = np.eye(6)[[names.index(axis) for axis in axes]]
    found = value(ball, wrench="any")
    assert found.status == "optimal" and found.beta > 0
    # A wrench that keeps its length, with the components of the ball as the free ones.
    angles = np.linspace(0, 2 * np.pi, 17)[:-1] if len(axes) == 2 else [0, np.pi]
    options.setdefault("any", [n for n, row in zip(names, ball.W_any) if np.abs(row).max() > 1e-9])
    betas = []
    for angle in angles:
        c = radius * (np.array([np.cos(angle), np.sin(angle)])[: len(axes)] @ basis)
        betas.append(value(lift(set=[c], **options), wrench="any").beta)
    assert min(betas) >= found.beta - 1e-8 * (1 + found.beta)
    if len(axes) == 1:  # the ball is its two ends
        assert min(betas) == pytest.approx(found.beta, rel=1e-9)


def test_a_ball_of_one_axis_without_other_wrenches_is_its_two_ends():
    ball = value(lift(ball=(["fz"], 2)))
    ends = [value(lift(set=[sign * 2 * np.eye(6)[2]])).beta for sign in (1, -1)]
    assert ball.beta == pytest.approx(min(ends), rel=1e-9)
    assert value(lift(ball=(["fz"], 1))).beta == pytest.approx(2 * ball.beta, rel=1e-9)  # a factor of the ball


def test_a_ball_of_three_axes_is_the_inscribed_radius_of_the_polytope():
    task = lift(ball=(["fx", "fy", "fz"], 1))
    forces = mw.polytope(mw.load("uvms/lift"), task.theta_r_default, directions="force")
    assert value(task).beta == pytest.approx(forces.offsets.min(), rel=1e-8)  # normals of length one


def test_gradients_of_balls_are_those_of_differences():
    task = lift(ball=(["fx", "fy"], 1), loss={"cases": [["rear_left_vertical"]]})
    at, step = task.theta_r_default + [0.05, 0.03, -0.04, 0.02], 1e-6
    for wrench in ("pure", "any"):
        exact = value(task, at, wrench=wrench).gradient
        for i, slope in enumerate(exact):
            ahead, behind = (value(task, at + s * np.eye(4)[i], wrench=wrench).beta for s in (step, -step))
            assert slope == pytest.approx((ahead - behind) / (2 * step), rel=1e-4, abs=1e-4)


def test_a_ball_that_cannot_be_held_without_a_wrench():
    task = lift(ball=(["fx", "fy"], 1), any=["fx", "fy", "tz"], uncertainty={"payload": {"mass": 60}})
    answer = value(task, wrench="any")
    assert answer.status == "infeasible" and "payload" in answer.reason


@pytest.mark.parametrize("arguments", [{"ball": (["fx", "fy", "fz"], 1)}, {"c": "x", "ball": (["fy", "fz"], 0.3)}])
def test_balls_without_any_wrench(arguments, rejects):
    rejects(value, lift(**arguments), wrench="any")


@pytest.mark.parametrize("ball", [(["fx"], 0), (["fx"], -1), (["fx"], np.nan), (["fx", "tz"], 1), ([], 1), (["up"], 1), "fx", {"axes": ["fx"]}])
def test_what_is_no_ball(ball, rejects):
    assert "ball" in str(rejects(lift, ball=ball))


def test_losses_of_a_ball():
    cases = [["front_left_vertical"], ["q2_shoulder_pitch"]]
    loss = {"cases": cases, "friction": 0.3}
    both = value(lift(ball=(["fx", "fy"], 1), loss=loss), wrench="any")
    each = [value(lift(ball=(["fx", "fy"], 1), loss={**loss, "cases": [case]}), wrench="any").beta for case in cases]
    intact = value(lift(ball=(["fx", "fy"], 1)), wrench="any").beta
    assert both.beta == pytest.approx(min(each + [intact]), rel=1e-9)
    assert both.decides in [end["name"] for end in both.scenarios()]


def test_the_nominal_task_of_a_ball_has_no_loss():
    task = lift(ball=(["fx", "fy"], 1), loss={"any": 1, "actuators": ["thrusters"]})
    assert value(mw.nominal(task)).beta == pytest.approx(value(lift(ball=(["fx", "fy"], 1))).beta, rel=1e-12)
    assert value(task).beta < value(mw.nominal(task)).beta


def test_a_margin_at_rest_is_the_value_of_a_ball():
    # At rest, tau_d is that of the posture.
    task = mw.load("planar/force")
    ball = mw.Static(task.robot, pose=task.pose, theta_r=task.theta_r_names, ball=(["fx", "fy"], 1))
    postures = np.array([[-0.8, 1], [-0.7, 0.9], [-0.75, 0.95]])
    still = {name + end: [0] * 3 for name in task.theta_r_names for end in ("_dot", "_ddot")}
    motion = {"t": [0, 1, 2], **dict(zip(task.theta_r_names, postures.T)), **still}
    margin = mw.margin(task, motion, ball=["fx", "fy"])
    assert margin.margin == pytest.approx([mw.evaluate(ball, at).beta for at in postures], rel=1e-8)


def test_a_motion_beyond_the_limits_has_a_negative_margin():
    fast = {"t": [0, 0.05, 0.1], "shoulder": [-0.8, 0.4, -0.8], "elbow": [1, 0, 1]}
    margin = mw.margin("planar/force", fast, ball=["fx", "fy"])
    assert margin.status == "infeasible" and margin.least < 0 and "more than the actuators can exert" in margin.reason
