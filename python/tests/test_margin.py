"""Margins of motions."""

import numpy as np
import pytest

import maxwrench as mw

MOTION = {"t": [0, 1, 2, 3], "shoulder": [-0.8, -0.7, -0.75, -0.8], "elbow": [1, 0.9, 0.95, 1]}


def test_a_motion_has_a_margin_at_each_instant():
    left = mw.margin("planar/force", MOTION, ball=["fx", "fy"], instants_per_interval=4)
    assert len(left) == 13 and left.t[4] == 1
    assert left.status == "optimal" and left.unit == "N"
    assert left.least == left.margin.min() == left.margin[left.worst]
    assert np.linalg.norm(left.wrench, axis=1) == pytest.approx(1)
    assert left.difference < 1e-8
    assert all(side in ("min", "max") for limits in left.binding for _, side in limits)
    assert left.csv().count("\n") == 14 and "fx fy" in left.figure()
    assert left.to_dict()["margin"] == left.least and str(left) == left.summary()


def test_a_file_and_an_answer_are_motions(tmp_path):
    file = tmp_path / "motion.csv"
    file.write_text("t,shoulder,elbow\n" + "".join(f"{t},{a},{b}\n" for t, a, b in zip(*MOTION.values())))
    assert mw.margin("planar/force", file).margin == pytest.approx(mw.margin("planar/force", MOTION).margin, abs=1e-12)
    task = mw.load("uvms/valve_trajectory")
    answer = mw.evaluate(task, task.theta_r_default)
    own = mw.margin(task, answer, task_wrench=True)
    assert own.least == pytest.approx(answer.beta, rel=1e-6)


def test_derivatives_are_columns():
    """With the shoulder and the elbow at rest in the table, it is the posture at rest."""
    at_rest = {**MOTION, **{name + end: [0] * 4 for name in ("shoulder", "elbow") for end in ("_dot", "_ddot")}}
    rest = mw.margin("planar/force", at_rest, task_wrench=True)
    task = mw.load("planar/force")
    values = [mw.evaluate(task, [a, b]).beta for a, b in zip(MOTION["shoulder"], MOTION["elbow"])]
    assert rest.margin == pytest.approx(values, rel=1e-9)


@pytest.mark.parametrize(
    "change",
    [
        {"t": [0, 1, 1, 2]},
        {"t": [0, 1, np.nan, 2]},
        {"elbow": [1, 2, 3]},
        {"elbow": [1, np.inf, 1, 1]},
        {"elbow": "here"},
        {"wrist": [1, 1, 1, 1]},
        {"elbow_dot": [0, 0, 0, 0]},
    ],
)
def test_a_bad_motion_is_rejected(change):
    with pytest.raises(mw.InputError) as error:
        mw.margin("planar/force", {**MOTION, **change})
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("motion", [None, 3, [1, 2], {}, {"t": [0]}])
def test_what_is_no_motion_is_rejected(motion):
    with pytest.raises(mw.InputError):
        mw.margin("planar/force", motion)


def test_a_bad_set_is_rejected():
    for wrong in ({"ball": ["fx", "tx"]}, {"ball": []}, {"ball": ["up"]}, {"ball_frame": "tool"}):
        with pytest.raises(mw.InputError):
            mw.margin("planar/force", MOTION, **wrong)
