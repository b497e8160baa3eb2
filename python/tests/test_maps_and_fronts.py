"""Maps and fronts."""

import numpy as np
import pytest

import maxwrench as mw


def test_a_map_has_a_value_for_each_cell():
    found = mw.map("planar/force", {"yaw": (-0.5, 0.5, 3), "azimuth": (0, 3, 4)}, budget=200)
    assert found.grid.shape == (3, 4)
    assert len(found) == 12 and found.at.shape == (12, 2)
    assert np.array_equal(found.grid.ravel(), found.beta)
    i = int(found.beta.argmax())
    assert found.best["beta"] == found.beta[i]
    assert np.array_equal(found.best["theta_r"], found.theta_r[i])
    assert found.statuses == ["best_found"] * 12
    assert "azimuth [rad]" in found.figure()
    assert found.to_dict()["cells"] == 12


def test_refined_cells_are_outside_the_grid():
    found = mw.map("planar/force", {"azimuth": (0, 3, 4)}, budget=100, refine=1, tolerance=0)
    assert len(found) == 7 and found.grid.shape == (4,)
    assert np.array_equal(found.grid, found.beta[::2])


def test_a_map_is_drawn():
    pytest.importorskip("matplotlib").use("Agg")
    assert mw.map("planar/force", {"azimuth": (0, 3, 4)}, budget=50).plot().name == "polar"
    over = {"yaw": (-0.5, 0.5, 3), "azimuth": (0, 3, 4)}
    assert mw.map("planar/force", over, budget=50).plot().get_xlabel() == "yaw [rad]"


@pytest.mark.parametrize(
    "over",
    [{}, [1], {"x": (0, 1)}, {"x": (1, 0, 3)}, {"x": (0, 1, 2.5)}, {"x": (np.nan, 1, 2)}, {"x": (0, 1, 1e12)}, {"w": (0, 1, 2)}],
)
def test_a_bad_grid_is_rejected(over):
    with pytest.raises(mw.InputError, match="over"):
        mw.map("planar/force", over)


def test_a_front_has_no_dominated_point():
    front = mw.pareto("uvms/valve", "uvms/lift", points=3, budget=200)
    assert front.beta.shape == (len(front), 2)
    for row in front.beta:
        assert not (front.beta > row).all(axis=1).any()
    share = (front.compromise["beta"] / front.own).min()
    assert front.compromise["share"] == pytest.approx(share, rel=1e-12)
    assert front.csv().count("\n") == len(front) + 2


def test_tasks_of_two_robots_have_no_front():
    with pytest.raises(mw.InputError, match="against"):
        mw.pareto("uvms/valve", "planar/force")
