"""The data of the scenario that decides."""

import json
import pickle

import numpy as np
import pytest

import maxwrench as mw

# 64 corners.
PARAMETERS = {
    "trim": 0.2,
    "cob": {"vehicle": [0.005, 0, 0.005]},
    "mass": {"link_2": 0.038, "link_4": 0.1},
    "com": {"link_2": [0.01, 0, 0]},
}


def lift(**tables):
    """The shipped lift with these tables."""
    task = mw.load("uvms/lift")
    return mw.Static(
        task.robot,
        pose=task.pose,
        c=task.c,
        theta_r=task.theta_r_names,
        theta_r_default=task.theta_r_default,
        **tables,
    )


def at_default(task):
    return mw.evaluate(task, task.theta_r_default)


def test_the_data_of_the_scenario_that_decides():
    """A task whose only uncertainty is the worst case has the same value."""
    task = lift(uncertainty=PARAMETERS | {"current": {"speed": 0.3}, "thrust": 0.1}, loss={"any": 1})
    answer = at_default(task)
    worst = answer.worst
    assert worst == json.loads(answer.to_json())["worst"] == pickle.loads(pickle.dumps(answer)).worst
    assert worst["wrench"] is None and worst["c"] == [0, 0, 1, 0, 0, 0]
    assert set(worst["deltas"]) == {"trim", "cob.vehicle", "mass.link_2", "mass.link_4", "com.link_2"}
    assert len(worst["dead"]) == 1 and worst["dead"][0] not in worst["weaker"]
    assert set(worst["weaker"].values()) == {0.1} and len(worst["weaker"]) == 7
    assert np.linalg.norm(worst["current"]) == pytest.approx(0.3)
    alone = lift(
        uncertainty=PARAMETERS | {"current": {"vectors": [worst["current"]]}, "thrust": 0.1},
        loss={"cases": [worst["dead"]]},
    )
    assert at_default(alone).beta == pytest.approx(answer.beta, rel=1e-9)
    assert at_default(mw.load("uvms/lift")).worst is None
