"""What binds: Answer.explain, and how it is shown."""

import math

import maxwrench as mw
import numpy as np
import pytest

LIFT = mw.load("uvms/lift")


def test_limits_of_a_posture():
    answer = mw.evaluate(LIFT, LIFT.theta_r_default)
    what = answer.explain()
    assert [(limit.name, limit.side, limit.limit, limit.unit) for limit in what.limits] == [
        ("front_right_vertical", "min", -40, "N"),
        ("front_left_vertical", "min", -40, "N"),
    ]
    for limit in what.limits:  # an independent model gives these values
        assert limit.rate == pytest.approx(-0.38410, abs=5e-6)
        assert limit.rate_up == limit.rate_down == pytest.approx(limit.rate)
        assert limit.down == pytest.approx(1.48353, abs=5e-6)
        assert limit.gain == pytest.approx(-limit.rate * limit.down, rel=1e-6)  # then another one takes over
    assert sum(what.budget.values()) == pytest.approx(answer.beta, rel=1e-12)
    assert what.beta == answer.beta and what.unit == "N" and not what.kink
    assert what.best == [] and "no local optimum" in what.missing["best"]
    assert what.missing["limits"] == what.missing["ranges"] == what.missing["u"] == ""
    assert what.to_dict()["kink"] is False


def test_rates_of_the_best_posture():
    best = mw.solve("uvms/valve").explain().best
    rates = {(limit.name, limit.side): limit.rate for limit in best}
    known = {"front_right_vertical": -0.4173, "rear_right_vertical": -0.4014, "q1_shoulder_yaw": -0.2622}
    for name, rate in known.items():
        assert rates[name, "min"] == pytest.approx(rate, abs=5e-5)
    assert rates["rear_left_vertical", "max"] == pytest.approx(0.0159, abs=5e-5)
    assert all(math.isnan(limit.gain) for limit in best)


def test_least_efforts_hold_a_share_of_the_wrench():
    answer = mw.evaluate(LIFT, LIFT.theta_r_default)
    norms = []
    for share in (1, 0.9, 0.5):
        u = answer.explain(share=share).u
        held = LIFT.robot.B @ u - answer.tau_d
        assert held == pytest.approx(share * answer.J.T @ answer.h, abs=1e-6)
        assert np.all(u >= LIFT.robot.u_min - 1e-9) and np.all(u <= LIFT.robot.u_max + 1e-9)
        norms.append(np.linalg.norm(u))
    assert norms[0] > norms[1] > norms[2]


def test_instants_of_a_task_in_time():
    task = mw.load("planar/trajectory")
    what = mw.evaluate(task, task.theta_r_default).explain()
    assert what.instants and what.limits == [] and what.u is None
    assert all(limits for _, limits in what.instants)
    assert what.missing["u"] == "the task is in time"


@pytest.mark.parametrize("measure", ["manipulability", "saturating_wrench", "dynamic_capability"])
def test_measures_without_limits(measure):
    what = mw.evaluate(LIFT, LIFT.theta_r_default, measure=measure).explain()
    assert what.limits == [] and measure in what.missing["limits"]


@pytest.mark.parametrize("share", [-0.1, 1.5, float("nan")])
def test_bad_share(share):
    with pytest.raises(mw.InputError, match="share: got .*, expected a number from 0 to 1"):
        mw.evaluate("planar/force", [0, 0]).explain(share=share)


def test_share_that_is_no_number():
    with pytest.raises(mw.InputError, match="share: got 'half', expected a number"):
        mw.evaluate("planar/force", [0, 0]).explain(share="half")


def test_shown():
    shown = {
        "posture": mw.evaluate(LIFT, LIFT.theta_r_default).explain(),
        "best posture": mw.solve("planar/force", budget=500).explain(),
        "no value": mw.evaluate("uvms/valve", [0, 0, 0, 0]).explain(),
        "in time": mw.evaluate("planar/trajectory", [0, 0]).explain(),
    }
    for what in shown.values():
        assert len(repr(what).splitlines()) == 1 and repr(what).startswith("<Explanation ")
        assert str(what) == what.summary() and "binds" in str(what)
        assert what._repr_html_().startswith("<table>") and ">nan" not in what._repr_html_()
    assert "there is no value" in repr(shown["no value"])
    assert repr(shown["posture"].limits[0]) == "<Limit front_right_vertical min: at -40 N, rate -0.3841>"
