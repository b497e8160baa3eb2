"""The package gives the numbers of the command, bit for bit: JSON prints doubles so that they read back unchanged."""

import json

import maxwrench as mw
import numpy as np
import pytest

# task, measure, wrench, solver, search, budget
SOLVED = [
    ("planar/force", "linf_polytope", "pure", "", "", 60),
    ("planar/force", "linf_polytope", "any", "condensed", "cmaes", 80),
    ("planar/force", "ellipsoid", "pure", "", "crs2", 60),
    ("planar/force", "l2_polytope", "pure", "simplex", "grid", 49),
    ("planar/two_arms", "linf_polytope", "pure", "", "crs2+cmaes", 80),
    ("uvms/valve", "linf_polytope", "any", "", "", 100),
    ("uvms/valve", "linf_polytope", "pure", "clp", "sample", 60),
    ("uvms/valve", "ellipsoid", "any", "", "slsqp", 60),
    ("uvms/valve", "l2_polytope", "any", "glpk", "de", 60),
    ("uvms/lift", "saturating_wrench", "pure", "", "bobyqa", 60),
    ("uvms/lift", "manipulability", "pure", "", "annealing", 60),
    ("fixed/push", "linf_polytope", "pure", "facets", "mma", 40),
    ("fixed/push", "least_effort", "pure", "", "direct_l", 40),
    ("mobile/push", "linf_polytope", "any", "simplex", "sade", 80),
    ("mobile/push_any_height", "linf_polytope", "pure", "", "facet_sqp", 60),
    ("dual_arm/two_arms", "linf_polytope", "any", "", "cmaes", 60),
    ("dual_arm/bar_wall", "linf_polytope", "pure", "ipopt", "sample", 5),
    ("planar/trajectory", "linf_polytope", "pure", "", "", 40),
    ("planar/trajectory", "linf_polytope", "any", "ipm", "slp", 20),
    ("mobile/trajectory", "linf_polytope", "pure", "clp", "cmaes", 15),
    ("uvms/lift_impulse", "linf_polytope", "pure", "", "sample", 12),  # finds no value
    ("uvms/lift_impulse", "linf_polytope", "any", "", "slp", 12),
    ("uvms/valve_trajectory", "linf_polytope", "pure", "facets_or_ipm", "crs2", 20),
]
EVALUATED = [
    ("planar/force", "linf_polytope", "any", ""),
    ("uvms/valve", "weighted_transmission_ratio", "pure", ""),
    ("uvms/lift", "ellipsoid_trace", "pure", ""),
    ("fixed/push", "l2_polytope", "any", "condensed"),
    ("mobile/push", "transmission_ratio", "pure", ""),
    ("dual_arm/bar_alone", "linf_polytope", "any", "glpk"),
    ("uvms/jet_trajectory", "linf_polytope", "pure", ""),
    ("uvms/valve_impulse", "linf_polytope", "any", ""),
]


def per_instant(printed, name):
    """A member of the printed answer: of the task, or a row of each instant."""
    if "instants" in printed:
        return [instant[name] for instant in printed["instants"]]
    return printed[name]


def numbers_of(array):
    """The numbers of an array; None: there is none."""
    return None if array is None else array.tolist()


def assert_same(answer, printed):
    """The answer has the numbers that the command printed."""
    for name in ("status", "unit", "evaluations", "residual", "measure", "wrench"):
        assert getattr(answer, name) == printed[name], name
    assert answer.solver == (printed["solver"] or "none")  # none: a closed form
    if printed["beta"] is None:
        assert np.isnan(answer.beta) and not answer.has_value
        assert answer.u is None and answer.h is None and answer.reason == printed["reason"]
        return
    assert answer.beta == printed["beta"]
    assert numbers_of(answer.theta_r) == printed["theta_r"]
    assert numbers_of(answer.u) == per_instant(printed, "u")
    assert numbers_of(answer.h) == per_instant(printed, "h")
    assert numbers_of(answer.gradient) == printed["gradient"]


@pytest.mark.parametrize("task, measure, wrench, solver, search, budget", SOLVED)
def test_solve(command, task, measure, wrench, solver, search, budget):
    words = ["solve", task, "--measure", measure, "--wrench", wrench, "--budget", budget, "--seed", 7, "--json"]
    words += ["--solver", solver] if solver else []
    words += ["--search", search] if search else []
    result = command(*words)
    assert result.stderr == ""
    printed = json.loads(result.stdout)
    for threads in (1, 2, 8):
        answer = mw.solve(
            task, measure=measure, wrench=wrench, solver=solver, search=search, budget=budget, seed=7, threads=threads
        )
        assert_same(answer, printed)
        assert answer.search == printed["search"] and answer.seed == 7
        assert answer.evaluations <= budget


@pytest.mark.parametrize("task, measure, wrench, solver", EVALUATED)
def test_evaluate(command, task, measure, wrench, solver):
    words = ["eval", task, "--measure", measure, "--wrench", wrench, "--json"]
    words += ["--solver", solver] if solver else []
    printed = json.loads(command(*words).stdout)
    theta_r = printed["theta_r"]
    assert_same(mw.evaluate(task, theta_r, measure=measure, wrench=wrench, solver=solver), printed)


def test_json_and_summary_are_those_of_the_command(command):
    answer = mw.evaluate("planar/force", [0, 0])
    printed = json.loads(command("eval", "planar/force", "--json").stdout)
    own = answer.to_dict()
    assert own == json.loads(answer.to_json())
    assert set(own) == set(printed)
    for name in set(own) - {"wall_s", "version"}:
        assert own[name] == printed[name], name
    assert answer.summary() == str(answer)
    assert answer.summary().splitlines()[0] == command("eval", "planar/force").stdout.splitlines()[0]


def test_posture_without_a_value(command):
    # The elbow at 1.2 rad is beyond its limit of pi/3 = 1.047 rad.
    printed = json.loads(command("eval", "planar/force", "--theta-r", "0,1.2", "--json").stdout)
    answer = mw.evaluate("planar/force", [0, 1.2])
    assert answer.status == "invalid_posture" and np.isnan(answer.beta)
    assert_same(answer, printed)


def test_all_joints(command):
    printed = json.loads(
        command("eval", "fixed/push", "--joints", "joint_2=0.4,joint_4=-1.2,joint_6=-0.6", "--json").stdout
    )
    answer = mw.evaluate_joints("fixed/push", [0, 0.4, 0, -1.2, 0, -0.6, 0])
    assert answer.beta == printed["beta"]
    assert answer.u.tolist() == printed["u"] and answer.h.tolist() == printed["h"]


def test_names_are_those_of_the_command(command):
    listed = command("list").stdout
    for table in (mw.measures(), mw.solvers(), mw.searches(), mw.integrators()):
        assert table
        for name, line in table.items():
            assert any(row.split(None, 1) == [name, line] for row in listed.splitlines()), name
    assert mw.tasks() == [row.split()[0] for row in listed.splitlines() if "/" in row.split()[0]]
