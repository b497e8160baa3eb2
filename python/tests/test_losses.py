"""Samples of uncertain models, and what lost actuators cost."""

import math

import numpy as np
import pytest

import maxwrench as mw
from scenario_tasks import PARAMETERS, at_default, static


def test_no_sample_is_below_the_guaranteed_value():
    answer = at_default(static(uncertainty=PARAMETERS | {"thrust": 0.1}))
    sample = answer.sample(200, seed=3)
    assert sample["drawn"] == 200 and sample["infeasible"] == sample["below"] == 0 and sample["unit"] == "N"
    assert sample["guaranteed"] == pytest.approx(answer.beta, rel=1e-9)
    assert sample["guaranteed"] <= sample["least"] <= sample["q01"] <= sample["q05"] <= sample["median"]
    assert answer.sample(n=200, seed=3) == sample != answer.sample(200)
    assert len(sample["values"]) == 200 and min(sample["values"]) == sample["least"]
    # Compared with another value, such as the median: half of the models are below.
    assert answer.sample(200, seed=3, guaranteed=np.median(sample["values"]))["below"] == pytest.approx(100, abs=1)


def test_samples_that_are_rejected(rejects):
    answer = at_default(static(uncertainty={"trim": 0.2}))
    for wrong in (0, 10**12):
        assert "expected 1 to 10000000" in str(rejects(answer.sample, wrong))
    assert "n: " in str(rejects(answer.sample, "many"))
    assert "n: " in str(rejects(answer.sample, 1.5))
    assert "seed: " in str(rejects(answer.sample, 1, seed=-1))


def test_what_a_dead_thruster_costs():
    cost = mw.sensitivity("uvms/valve", actuators="front_right_vertical", budget=8000, callback=False)
    assert [loss.name for loss in cost.losses] == ["", "front_right_vertical dead"]
    intact, dead = cost.losses
    assert intact.at_posture == pytest.approx(9, abs=1e-6) and intact.best == pytest.approx(35.4083, rel=1e-3)
    assert dead.best == pytest.approx(24.8078, rel=1e-3)  # proven to 0.1 %
    assert cost.all.at_posture == pytest.approx(min(intact.at_posture, dead.at_posture), rel=1e-9)
    assert cost.all.best <= dead.best * (1 + 1e-3) and cost.unit == "N m"
    # A dead thruster is worse than the intact robot everywhere, so the best posture is the same.
    listed = static("uvms/valve", loss={"cases": [["front_right_vertical"]]})
    assert mw.evaluate(listed, dead.theta_r).beta == pytest.approx(dead.best, rel=1e-6)
    assert cost.to_dict()["losses"][1]["best"] == dead.best
    assert "front_right_vertical dead" in cost.summary() == str(cost) and "2" not in repr(cost).partition(":")[0]


def test_what_a_joint_costs():
    posture = mw.load("uvms/valve").theta_r_default
    options = {"actuators": ["q1_shoulder_yaw"], "budget": 20, "callback": False}
    locked = mw.sensitivity("uvms/valve", posture, joints="locked", **options)
    assert locked.losses[1].name == "q1_shoulder_yaw locked"
    assert locked.losses[1].at_posture == pytest.approx(30.16518, abs=5e-6)
    limp = mw.sensitivity("uvms/valve", posture, friction=0.5, **options)
    assert limp.losses[1].at_posture == pytest.approx(0.5, abs=1e-6)


def test_a_loss_without_a_value_is_nan():
    # The weight of the arm turns a limp joint, and a torque about the vertical does nothing about its horizontal axis.
    cost = mw.sensitivity(static("fixed/push", c="rz"), actuators="joint_2", budget=10, callback=False)
    assert math.isnan(cost.losses[1].at_posture) and math.isnan(cost.losses[1].best)
    assert cost.losses[1].theta_r is None and cost.to_dict()["losses"][1]["best"] is None
    assert cost.losses[0].theta_r.shape == (1,)


@pytest.mark.parametrize(
    "task, arguments, line",
    [
        ("planar/force", {"actuators": "rudder"}, "loss.actuators: got ['rudder']"),
        ("planar/force", {"actuators": "elbow", "joints": "stuck"}, "joints: got 'stuck', expected limp or locked"),
        ("planar/force", {"actuators": "elbow", "friction": -1}, "loss.friction: got -1"),
        ("planar/force", {"actuators": "elbow", "joints": "locked", "brake": 0}, "loss.brake: got 0"),
        ("planar/force", {"theta_r": [0]}, "theta_r: got"),
        ("planar/force", {"theta_r": [0, math.nan]}, "theta_r: got"),
        ("planar/force", {"actuators": 1}, "actuators: got a int"),
        ("planar/force", {"friction": "none"}, "friction: got 'none', expected a number"),
        ("planar/trajectory", {}, "a task in time, expected a static task"),
        ("dual_arm/two_arms", {"actuators": "joints"}, "expected a static task with one contact"),
    ],
)
def test_sensitivity_rejects(task, arguments, line, rejects):
    assert line in str(rejects(mw.sensitivity, task, **arguments))
