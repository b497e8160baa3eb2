"""Experiments and proofs, against the command."""

import json

import maxwrench as mw
import numpy as np
import pytest


def test_a_posture_is_held(command):
    task = mw.load("planar/force")
    run = mw.simulate(mw.evaluate(task, task.theta_r_default), hold=2)
    theirs = json.loads(command("simulate", "planar/force", "--hold", "2", "--json").stdout)
    assert run.held is theirs["held"] and run.reading == theirs["mean"] and run.planned == theirs["planned"]
    assert run.t.shape == run.readings.shape and run.u.shape == (len(run.t), len(task.robot.u_max))
    assert (run.u <= task.robot.u_max + 1e-3).all() and run.h.shape == (len(run.t), 6)


def test_a_trajectory_is_held(command):
    task = mw.load("planar/trajectory")
    run = mw.simulate(mw.evaluate(task, task.theta_r_default))
    theirs = json.loads(command("simulate", "planar/trajectory", "--json").stdout)
    assert run.held is theirs["held"] and run.planned == theirs["planned"]
    assert run.reading == pytest.approx(run.readings.min(), abs=1e-12)
    assert run.csv().count("\n") == len(run.t) + 1


def test_weak_thrusters_do_not_hold():
    answer = mw.solve("planar/force")
    run = mw.simulate(answer, thrust_efficiency=0.5, hold=1)
    assert not run.held and run.missed


def test_a_thruster_that_dies(command):
    task = mw.load("uvms/lift")
    answer = mw.evaluate(task, task.theta_r_default)
    run = mw.simulate(answer, planned=14.5, dies={"front_left_vertical": 5.5})
    words = "simulate uvms/lift --planned 14.5 --dies front_left_vertical=5.5 --json".split()
    theirs = json.loads(command(*words).stdout)
    assert run.held is theirs["held"] is True and run.reading == theirs["mean"]
    assert not mw.simulate(answer, planned=20, dies={"front_left_vertical": 5.5}).held


def test_each_scenario_is_carried_out(rejects):
    task = mw.load("uvms/lift")
    where = dict(pose=task.pose, theta_r=task.theta_r_names, theta_r_default=task.theta_r_default)
    both = mw.Static(task.robot, set=[[0, 0, 2, 0, 0, 0], [0, 0, -2, 0, 0, 0]], **where)
    answer = mw.evaluate(both, both.theta_r_default)
    runs = mw.simulate_scenarios(answer, hold=1)
    assert list(runs) == ["wrench 1", "wrench 2"] and all(run.held for run in runs.values())
    assert runs["wrench 2"].reading == pytest.approx(2 * answer.beta, rel=0.02)
    assert rejects(mw.simulate, answer).key == "answer"
    alone = mw.evaluate(task, task.theta_r_default)
    assert rejects(mw.simulate_scenarios, alone).key == "answer"
    assert rejects(mw.simulate, alone, dies=["front_left_vertical"]).key == "dies"
    rejects(mw.simulate, alone, dies={"rudder": 1})


def test_bad_experiments(rejects):
    answer = mw.evaluate("planar/force", [0, 0])
    assert rejects(mw.simulate, answer, "arkode").key == "integrator"
    rejects(mw.simulate, answer, ramp=0)
    rejects(mw.simulate, answer, ramp=float("nan"))
    assert rejects(mw.simulate, answer, ramp="a").key == "ramp"
    rejects(mw.simulate, mw.evaluate("planar/force", [9, 9]))
    rejects(mw.simulate, mw.evaluate("planar/force", [0, 0], measure="manipulability"))
    with pytest.raises(TypeError, match="colour"):
        mw.simulate(answer, colour=3)


def test_a_proof_is_verified_by_independent_code(tmp_path, command):
    proof = mw.certify("planar/force", gap=1e-3)
    assert proof.status == "proven" and proof.beta <= proof.bound <= proof.beta * (1 + 1.0001e-3)
    assert proof.answer.beta == proof.beta and proof.boxes > 0
    file = tmp_path / "p.proof"
    proof.save(file)
    checked = mw.verify(file)
    assert checked and checked.verified and checked.bound == proof.bound and checked.rejection == ""
    assert np.array_equal(checked.theta_r, proof.answer.theta_r)
    assert json.loads(command("verify", str(file), "--json").stdout)["status"] == "verified"


def test_a_proof_of_another_task_is_rejected(tmp_path):
    task = mw.load("planar/force")
    file = tmp_path / "p.proof"
    mw.certify(task).save(file)
    weaker = task.with_limits(0.9 * task.robot.u_min, 0.9 * task.robot.u_max)
    checked = mw.verify(file, weaker)
    assert not checked and checked.rejection


def test_a_trajectory_is_proven_at_every_instant(tmp_path, command):
    proof = mw.certify("planar/trajectory", [0.3, 0.1])
    assert proof.status == "proven" and proof.reason == "" and np.isnan(proof.t)
    between = proof.answer.to_dict()["value_between_knots"]
    assert between * (1 - 5e-4) <= proof.guaranteed <= between
    file = tmp_path / "t.proof"
    proof.save(file)
    checked = mw.verify(file)
    assert checked and checked.guaranteed == proof.guaranteed and checked.knots.shape == (8, 2)
    assert json.loads(command("verify", str(file), "--json").stdout)["status"] == "verified"
    task = mw.load("planar/trajectory")
    weaker = task.with_limits(0.9 * task.robot.u_min, 0.9 * task.robot.u_max)
    assert not mw.verify(file, weaker)


def test_a_trajectory_is_found_and_proven():
    proof = mw.certify("planar/trajectory", budget=200, seed=2)
    assert proof.status == "proven" and proof.answer.status == "best_found"
    assert 0 < proof.guaranteed <= proof.answer.beta <= proof.bound < np.inf
    assert proof.gap == pytest.approx((proof.bound - proof.answer.beta) / proof.answer.beta)
    given = mw.certify("planar/trajectory", [0.3, 0.1])
    assert np.isnan(given.bound) and np.isnan(given.gap)
    assert np.isnan(given.searched) and given.rejection == "" and not given.held
    first = mw.solve("planar/trajectory", budget=200, seed=2)
    refused = mw.certify("planar/trajectory", first.theta_r)
    assert proof.searched == first.to_dict()["value_between_knots"] and not proof.held
    assert refused.status != "proven" and proof.rejection == f"{refused.status}: {refused.reason}"


def test_an_unprovable_trajectory_says_when(tmp_path, rejects):
    knots = np.zeros((8, 2))
    knots[4] = 1.4  # beyond a limit
    proof = mw.certify("planar/trajectory", knots)
    assert proof.status == "invalid_posture" and proof.reason.startswith("t = ") and proof.t > 0
    rejects(proof.save, tmp_path / "t.proof")
    rejects(mw.certify, "planar/trajectory", np.zeros((3, 2)))
    rejects(mw.certify, "planar/trajectory", [0, 0], wrench="any")
    rejects(mw.certify, "planar/trajectory", [0, 0], gap=1e-4)
    rejects(mw.certify, "planar/trajectory", [0, 0], seconds=5)
    rejects(mw.certify, "planar/trajectory", gap=0)
    rejects(mw.certify, "planar/trajectory", gap=float("nan"))
    rejects(mw.certify, "planar/trajectory", seconds=-1)
    rejects(mw.certify, "planar/force", [0, 0])


def test_bad_proofs(tmp_path, rejects):
    assert isinstance(rejects(mw.verify, tmp_path / "none.proof"), FileNotFoundError)
    (tmp_path / "bad.proof").write_text("nonsense")
    rejects(mw.verify, tmp_path / "bad.proof")
    rejects(mw.certify, "planar/force", gap=-1)
    rejects(mw.certify, "planar/force", gap=float("nan"))
    rejects(mw.certify, "planar/force", seconds=-1)
    rejects(mw.certify, "mobile/trajectory", wrench="any")
    rejects(mw.certify, "planar/force", measure="manipulability")


def test_a_callback_ends_a_proof():
    proof = mw.certify("uvms/lift", gap=1e-8, seconds=30, callback=lambda evaluations: True)
    assert proof.status == "bracket" and proof.seconds < 10
