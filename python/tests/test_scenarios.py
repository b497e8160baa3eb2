"""Lists of scenarios: several wrenches, uncertain loads, lost actuators."""

import math
import pathlib
import pickle

import pytest

import maxwrench as mw

TASKS = pathlib.Path(__file__).parents[2] / "examples" / "tasks"


def test_the_scenario_that_decides_has_the_value():
    task = mw.load(str(TASKS / "turn_both_ways.toml"))
    answer = mw.evaluate(task, task.theta_r_default)
    assert answer.decides == "wrench 1"
    ends = answer.scenarios()
    assert [each["name"] for each in ends] == ["wrench 1", "wrench 2"]
    assert answer.beta == pytest.approx(min(each["high"] for each in ends), rel=1e-12)
    assert all(each["held"] and each["low"] <= answer.beta for each in ends)
    assert pickle.loads(pickle.dumps(answer)).decides == answer.decides


def test_a_payload_is_a_mass():
    task = mw.load(str(TASKS / "carry_steel.toml"))
    answer = mw.evaluate(task, task.theta_r_default)
    assert answer.unit == "kg"
    assert answer.beta == pytest.approx(3.0103, abs=1e-3)
    assert answer.decides == "nominal"


def test_an_ordinary_task_has_no_scenarios():
    answer = mw.evaluate("planar/force", [0, 0])
    assert answer.decides is None
    with pytest.raises(mw.InputError, match="scenarios: got a task without a list"):
        answer.scenarios()


def test_no_scenario_is_without_a_name():
    task = mw.load(str(TASKS / "lift_with_a_dead_thruster.toml"))
    ends = mw.evaluate(task, task.theta_r_default).scenarios()
    assert ends[0]["name"] == "nominal" and len(ends) == 9
    assert all(math.isfinite(each["high"]) for each in ends)
