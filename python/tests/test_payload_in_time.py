"""Payloads and tables of wrenches in time."""

import numpy as np
import pytest

import maxwrench as mw


def along(**arguments):
    lift = mw.load("uvms/lift")
    path = mw.Path.screw(lift.pose, 3, displacement=[0.6, 0, 0.4])
    names = {"theta_r": lift.theta_r_names, "theta_r_default": lift.theta_r_default}
    return mw.Trajectory(lift.robot, path, 8, **names, **arguments)


STEEL = {
    "com": [0.05, 0, 0],
    "volume_per_kg": 1 / 7850,
    "inertia_per_kg": [0.002, 0.002, 0.002, 0, 0, 0],
    "added_mass_per_kg": [0.5 * 998 / 7850] * 3 + [0, 0, 0],
}


def test_a_payload_along_a_path():
    task = along(payload=STEEL)
    answer = mw.evaluate(task, task.theta_r_default)
    assert task.unit == answer.unit == "kg"
    assert answer.beta == pytest.approx(2.925898, abs=1e-6)  # an independent model


def test_a_table_of_wrenches():
    constant = along(wrenches=[[0, 0, 0, 4, 0, 0, 0], [3, 0, 0, 4, 0, 0, 0]])
    force = along(c="z")
    theta_r = force.theta_r_default
    assert constant.unit == "-"
    factor = mw.evaluate(constant, theta_r).beta
    assert 4 * factor == pytest.approx(mw.evaluate(force, theta_r).beta, abs=1e-7)


@pytest.mark.parametrize(
    "arguments, message",
    [
        ({"payload": STEEL, "c": "z"}, "wrench: got a table"),
        ({"payload": STEEL, "wrenches": np.zeros((2, 7))}, "wrench.file"),
        ({"payload": STEEL, "scheme": "forward"}, "motion.scheme"),
        ({"payload": {"com": [0, 0, 0], "inertia_per_kg": [-1, 1, 1, 0, 0, 0]}}, "inertia_per_kg"),
        ({"wrenches": [[0, 1, 0, 0, 0, 0, 0], [2, 1, 0, 0, 0, 0, 0]]}, "the duration"),
        ({"wrenches": [[0, 1, 0, 0, 0, 0], [3, 1, 0, 0, 0, 0]]}, "wrenches"),
        ({"wrenches": [[0] * 7, [3] + [0] * 6]}, "wrench.file"),
    ],
)
def test_bad_input(arguments, message):
    with pytest.raises(mw.InputError, match=message):
        along(**arguments)


def test_any_is_rejected():
    task = along(payload=STEEL)
    with pytest.raises(mw.InputError, match="carry the payload"):
        mw.evaluate(task, task.theta_r_default, wrench="any")
