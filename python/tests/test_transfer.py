"""Transfers: the largest mass from one posture to another."""

import pathlib
import pickle

import numpy as np
import pytest

import maxwrench as mw

TASK = pathlib.Path(__file__).parents[2] / "examples/tasks/two_link/lift.toml"
DOWN, UP = {"q1": -np.pi / 3, "q2": 0}, {"q1": np.pi / 3, "q2": 0}


def lift(**arguments):
    given = {"start": DOWN, "end": UP, "T": 1.5, "knots": 8, "payload": {"com": [0, 0, 0]}}
    return mw.Transfer(mw.load(str(TASK)).robot, **{**given, **arguments})


@pytest.mark.skipif(not TASK.exists(), reason="the sources are not here")
class TestTransfer:
    def test_the_straight_line(self):
        task = lift()
        assert task.default_knots.shape == (6, 2) and task.knots == 6
        answer = mw.evaluate(task, task.default_knots)
        assert answer.beta == pytest.approx(3.79329, abs=5e-6)  # an independent model
        assert answer.unit == "kg"

    def test_is_that_of_its_file(self):
        file = mw.load(str(TASK))
        assert np.allclose(file.default_knots, lift().default_knots)

    def test_is_pickled(self):
        task = pickle.loads(pickle.dumps(lift()))
        assert np.array_equal(task.default_knots, lift().default_knots)

    @pytest.mark.parametrize(
        "arguments, message",
        [
            ({"start": {"q1": 0}}, "from"),
            ({"end": {"q1": 0, "elbow": 0}}, "to.elbow"),
            ({"end": {"q1": 0, "q2": 3}}, "to"),
            ({"T": 0}, "motion.T"),
            ({"T": float("nan")}, "motion.T"),
            ({"knots": 2}, "motion.k"),
            ({"payload": {"com": [0, 0, 0], "inertia_per_kg": [-1, 1, 1, 0, 0, 0]}}, "inertia_per_kg"),
        ],
    )
    def test_bad_input(self, arguments, message):
        with pytest.raises(mw.InputError, match=message):
            lift(**arguments)
