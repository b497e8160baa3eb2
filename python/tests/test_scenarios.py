"""Lists of scenarios: several wrenches, uncertain loads, lost actuators, payloads."""

import json
import math
import pathlib
import pickle

import numpy as np
import pytest

import maxwrench as mw
from scenario_tasks import PARAMETERS, at_default, static

TASKS = pathlib.Path(__file__).parents[2] / "examples" / "tasks"
BOTH_SENSES = [[0, 0, 0, 0, 0, 1], [0, 0, 0, 0, 0, -1]]
STEEL = {"com": [0.05, 0, 0.02], "volume_per_kg": 1 / 7850}


def test_the_scenario_that_decides_has_the_value():
    task = mw.load(str(TASKS / "turn_both_ways.toml"))
    answer = at_default(task)
    assert answer.decides == "wrench 1"  # the first of two equal ones
    ends = answer.scenarios()
    assert [each["name"] for each in ends] == ["wrench 1", "wrench 2"]
    assert answer.beta == pytest.approx(min(each["high"] for each in ends), rel=1e-12)
    assert all(each["held"] and each["low"] <= answer.beta for each in ends)
    assert pickle.loads(pickle.dumps(answer)).decides == answer.decides


def test_a_payload_is_a_mass():
    task = mw.load(str(TASKS / "carry_steel.toml"))
    answer = at_default(task)
    assert answer.unit == task.unit == "kg"
    assert answer.beta == pytest.approx(3.0103, abs=1e-3)
    assert answer.decides == "nominal"


def test_an_ordinary_task_has_no_scenarios(rejects):
    answer = mw.evaluate("planar/force", [0, 0])
    assert answer.decides is None
    assert "scenarios: got a task without a list" in str(rejects(answer.scenarios))
    assert "sample: got a task without a list" in str(rejects(answer.sample, 10))


def test_no_scenario_is_without_a_name():
    ends = at_default(mw.load(str(TASKS / "lift_with_a_dead_thruster.toml"))).scenarios()
    assert ends[0]["name"] == "nominal" and len(ends) == 9
    assert all(math.isfinite(each["high"]) for each in ends)


# Values of an independent computation, which solves a program for each scenario.
@pytest.mark.parametrize(
    "like, arguments, beta",
    [
        ("uvms/valve", {"set": BOTH_SENSES}, 9.0),
        ("uvms/valve", {"set": np.array(BOTH_SENSES)}, 9.0),
        ("uvms/valve", {"set": [np.array(BOTH_SENSES[0]), tuple(BOTH_SENSES[1])]}, 9.0),
        ("uvms/valve", {"set": [s * np.eye(6)[i] for i in (0, 1) for s in (1, -1)]}, 30.67224),
        ("uvms/valve", {"ball": (["fx", "fy"], 1)}, 30.67224),
        ("uvms/valve", {"ball": ("fx,fy", np.float64(1))}, 30.67224),
        ("uvms/valve", {"ball": {"axes": ["fx", "fy"], "radius": 1}}, 30.67224),
        ("uvms/valve", {"c": "x", "ball": (["fy", "fz"], math.tan(math.radians(20)))}, 40.64043),
        ("uvms/valve", {"uncertainty": PARAMETERS}, 9.0),
        ("uvms/lift", {"uncertainty": PARAMETERS}, 26.95465),
        ("uvms/lift", {"uncertainty": PARAMETERS | {"thrust": 0.1}}, 23.88186),
        ("uvms/valve", {"uncertainty": {"current": {"speed": 0.3}}}, 8.94623),
        ("uvms/lift", {"uncertainty": {"current": {"speed": 0.3, "directions": 72}}}, 29.81347),
        ("uvms/lift", {"loss": {"any": 1}}, 14.55665),
        ("uvms/lift", {"loss": {"any": 1, "actuators": ["thrusters"]}}, 14.55665),
        ("uvms/lift", {"loss": {"cases": [[name] for name in mw.load("uvms/lift").robot.thruster_names]}}, 14.55665),
        ("uvms/lift", {"payload": STEEL}, 3.010312),
        ("uvms/lift", {"payload": STEEL | {"cob": [0.05, 0, 0.02]}}, 3.010312),
    ],
)
def test_tasks_made_in_code(like, arguments, beta):
    task = static(like, **arguments)
    answer = at_default(task)
    assert answer.beta == pytest.approx(beta, abs=5e-5 if beta > 5 else 5e-7)
    assert answer.decides is not None
    again = pickle.loads(pickle.dumps(task))
    assert at_default(again).beta == answer.beta


@pytest.mark.parametrize(
    "file, like, arguments",
    [
        ("turn_both_ways", "uvms/valve", {"set": BOTH_SENSES}),
        ("carry_steel", "uvms/lift", {"payload": {"com": [0.05, 0, 0.02], "volume_per_kg": 1.274e-4}}),
        ("lift_with_a_dead_thruster", "uvms/lift", {"loss": {"any": 1}}),
    ],
)
def test_a_task_made_in_code_is_that_of_the_file(file, like, arguments):
    made, read = static(like, **arguments), mw.load(TASKS / f"{file}.toml")
    assert made.unit == read.unit
    assert at_default(made).beta == at_default(read).beta
    if "payload" in arguments:
        with pytest.raises(mw.InputError, match="expected pure for a payload"):
            at_default(made, wrench="any")
    else:
        assert at_default(made, wrench="any").beta == at_default(read, wrench="any").beta


def test_a_share_of_the_nominal_mass():
    arguments = [{"uncertainty": {"mass": {"link_4": width}}} for width in ("50%", "0%")]
    weaker, same = (at_default(static(**each)).beta for each in arguments)
    assert weaker < same == pytest.approx(at_default(mw.load("uvms/lift")).beta, rel=1e-9)


def test_hold_adds_the_posture_without_a_wrench():
    ends = at_default(static(c="z", hold=True)).scenarios()
    assert ends[-1]["name"] == "hold" and len(ends) == 2
    assert static(payload=STEEL, hold=False).unit == "kg"


def test_the_value_is_a_factor_of_wrenches_that_keep_their_lengths():
    one, two = (at_default(static("uvms/valve", set=k * np.array(BOTH_SENSES))) for k in (1, 2))
    assert (one.unit, two.unit) == ("N m", "-")
    assert two.beta == pytest.approx(one.beta / 2, rel=1e-9)


# A locked joint, and one that resists 0.5 N m and so decides.
def test_lost_joints():
    joint = ["q1_shoulder_yaw"]
    for how, beta in (({"joints": "locked"}, 30.16518), ({"friction": 0.5}, 0.5)):
        loss = {"cases": [joint]} | how
        lost = [e["high"] for e in at_default(static("uvms/valve", loss=loss)).scenarios() if e["name"] != "nominal"]
        assert lost == [pytest.approx(beta, abs=5e-6)]


@pytest.mark.parametrize(
    "arguments, key, expected",
    [
        ({"uncertainty": {"masss": {"link_4": 0.1}}}, "uncertainty.masss", "mass, com, volume"),
        ({"uncertainty": {"mass": {"link_9": 0.1}}}, "uncertainty.mass.link_9", "link_4"),
        ({"uncertainty": {"mass": {"link_4": -0.1}}}, "uncertainty.mass.link_4", ">= 0"),
        ({"uncertainty": {"mass": {"link_4": "5 percent"}}}, "uncertainty.mass.link_4", "5%"),
        ({"uncertainty": {"mass": {"link_4": math.nan}}}, "uncertainty.mass.link_4", "finite"),
        ({"uncertainty": {"mass": {"link_4": 0.1j}}}, "uncertainty.mass.link_4", "a number"),
        ({"uncertainty": {"mass": {4: 0.1}}}, "uncertainty.mass.keys", "a text"),
        ({"uncertainty": {"com": {"link_4": [0.1, 0]}}}, "uncertainty.com.link_4", "3 finite numbers"),
        ({"uncertainty": {"payload": {"com": [0, 0, 0]}}}, "uncertainty.payload.mass", "finite"),
        ({"uncertainty": {"payload": {"mas": 1}}}, "uncertainty.payload.mas", "mass, com"),
        ({"uncertainty": {"thrust": 1}}, "uncertainty.thrust", "below 1"),
        ({"uncertainty": {"current": {"speed": 0.3, "vectors": [[1, 0, 0]]}}}, "uncertainty.current.speed", "beside"),
        ({"uncertainty": {"current": {"knots": 1}}}, "uncertainty.current.knots", "speed"),
        ({"uncertainty": {}}, "uncertainty", "one or more keys"),
        ({"uncertainty": 0.1}, "uncertainty", "a table"),
        ({"loss": {"most": 1}}, "loss.most", "any, actuators, cases"),
        ({"loss": {"any": 0}}, "loss.any", "a whole number"),
        ({"loss": {"any": 9}}, "loss.any", "1 to 8"),
        ({"loss": {"actuators": ["thrusters"]}}, "loss.any", "finite"),
        ({"loss": {"any": 1, "cases": [["thrusters"]]}}, "loss.any", "beside loss.cases"),
        ({"loss": {"any": 1, "actuators": ["rudder"]}}, "loss.actuators", "front_right_vertical"),
        ({"loss": {"any": 1, "joints": "stuck"}}, "loss.joints", "'limp' or 'locked'"),
        ({"loss": {"any": 1, "joints": "locked", "friction": 1}}, "loss.friction", "locked"),
        ({"payload": {"mass": 1}}, "payload.mass", "com, volume_per_kg"),
        ({"payload": {"volume_per_kg": 0}}, "payload.com", "3 finite numbers"),
        ({"payload": STEEL, "c": "z"}, "wrench", "payload"),
        ({"payload": STEEL, "hold": True}, "wrench", "payload"),
        ({"set": []}, "wrench.set", "6 finite numbers"),
        ({"set": np.zeros((2, 5))}, "wrench.set", "6 finite numbers"),
        ({"set": np.zeros((1, 6))}, "wrench.set[0]", "nonzero length"),
        ({"set": [1, 0, 0, 0, 0, 0]}, "wrench.set", "6 finite numbers"),
        ({"set": "z"}, "wrench.set", "6 finite numbers"),
        ({"set": BOTH_SENSES, "c": "z"}, "wrench.c", "beside wrench.set"),
        ({"ball": (["fx", "tz"], 1)}, "wrench.ball.axes", "not both"),
        ({"ball": (["fx"], 0)}, "wrench.ball.radius", "> 0"),
        ({"ball": (["fx"],)}, "wrench.ball", "(axes, radius)"),
        ({"ball": {"axes": ["fx"], "radius": 1, "centre": 0}}, "wrench.ball.centre", "axes, radius"),
        ({"c": np.zeros(6), "ball": (["fx"], 1)}, "wrench.c", "nonzero length"),
        ({"hold": "yes"}, "wrench.hold", "true or false"),
    ],
)
def test_wrong_arguments(arguments, key, expected, rejects):
    error = rejects(static, **arguments)
    assert error.key == key and expected in str(error) and error.file is None


def test_nested_lists_without_end_are_rejected(rejects):
    endless = []
    endless.append(endless)
    rejects(static, loss={"cases": endless})


def test_lists_in_time():
    """Weaker thrusters, a limp joint and a second sense: each against the wrench alone."""
    task = mw.load("planar/trajectory")
    path = mw.Path.screw(task.pose, 2, angle=0.1)

    def value(**tables):
        wrench = {} if "set" in tables else {"c": "x"}
        return mw.evaluate(mw.Trajectory(task.robot, path, 4, **{**wrench, **tables}), task.theta_r_default)

    alone, other = value(), value(c="-x")
    assert alone.decides is None and alone.decides_at is None
    both = value(set=[[1, 0, 0, 0, 0, 0], [-1, 0, 0, 0, 0, 0]])
    assert both.beta == pytest.approx(min(alone.beta, other.beta), rel=1e-9)
    assert both.decides == "wrench 2" and 0 <= both.decides_at <= 2
    assert both.worst["wrench"] == "wrench 2" and alone.worst is None
    weaker = value(uncertainty={"thrust": 0.1})
    assert weaker.beta < alone.beta and weaker.decides == "weaker actuators"
    limp = value(loss={"cases": [["elbow"]]})  # holds its own link's inertia and no wrench
    assert abs(limp.beta) < 0.01 * alone.beta and limp.decides == "elbow limp"
    assert limp.worst["limp"] == ["elbow"] and limp.worst["deltas"] == {}
    with pytest.raises(mw.InputError, match="loss.friction: got 1, expected 0 in tasks in time"):
        value(loss={"cases": [["elbow"]], "friction": 1})
    assert not value(loss={"any": 1}).has_value
    with pytest.raises(mw.InputError, match="uncertainty.mass"):
        value(uncertainty={"mass": {"link_2": 0.1}})


def test_the_nominal_task():
    lift = mw.load("uvms/lift")
    for task in (static(loss={"any": 1}, uncertainty=PARAMETERS), lift):
        known = mw.nominal(task)
        assert at_default(known).beta == at_default(lift).beta
        assert at_default(known).decides is None
        assert at_default(pickle.loads(pickle.dumps(known))).beta == at_default(known).beta
    turned = mw.nominal(static("uvms/valve", set=BOTH_SENSES, loss={"any": 1}))
    assert [each["name"] for each in at_default(turned).scenarios()] == ["wrench 1", "wrench 2"]
    assert at_default(mw.nominal(static(payload=STEEL, uncertainty=PARAMETERS))).beta == pytest.approx(3.010312, abs=5e-7)
    assert mw.nominal("uvms/lift").digest == lift.digest


def test_proofs_of_lists_are_checked(tmp_path, command):
    name = str(TASKS / "lift_with_a_dead_thruster.toml")
    proof = mw.certify(name, gap=1e-2)
    assert proof.status == "proven" and proof.beta <= proof.bound <= proof.beta * (1 + 1.0001e-2)
    file = tmp_path / "list.proof"
    proof.save(file)
    checked = mw.verify(file)
    assert checked and checked.bound == proof.bound and checked.unit == "N"
    assert json.loads(command("verify", str(file), "--json").stdout)["status"] == "verified"
    intact = mw.verify(file, mw.load("uvms/lift"))
    assert not intact and intact.rejection


def test_a_proof_with_currents_leaves_them_out(tmp_path, rejects):
    proof = mw.certify(static(uncertainty={"current": {"speed": 0.05, "directions": 4}}), gap=0.1, seconds=20)
    assert proof.beta <= proof.bound
    rejects(proof.save, tmp_path / "current.proof")


def test_a_list_in_time_is_the_least_of_its_scenarios():
    push = mw.load("uvms/valve_trajectory")
    wrenches = [[0, 0, 0, 0, 0, 1], [0, 0, 5, 0, 0, 1]]
    path = mw.Path.screw(push.pose, 5, axis=[0, 0, 1], angle=math.pi)
    both = mw.Trajectory(push.robot, path, 4, set=wrenches, loss={"cases": [["front_left_vertical"]]},
                         theta_r=push.theta_r_names, theta_r_default=push.theta_r_default)
    answer = mw.evaluate(both, push.theta_r_default)
    each = answer.scenarios()
    assert len(each) == 4 and all(one["held"] for one in each)
    least = min(each, key=lambda one: one["high"])
    assert answer.beta == pytest.approx(least["high"], abs=1e-6)
    assert answer.decides == least["name"]
    assert 0 <= answer.decides_at <= 5
    assert mw.evaluate(push, push.theta_r_default).decides_at is None


def test_a_proof_in_time_names_the_scenario_that_decides(tmp_path):
    task = mw.load(TASKS / "turn_along_with_a_dead_thruster.toml")
    proof = mw.certify(task, task.theta_r_default)
    proof.save(tmp_path / "turn.cert")
    check = mw.verify(tmp_path / "turn.cert", task=task)
    for each in (proof, check):
        assert "dead" in each.decides and each.scenarios == 3
        again = pickle.loads(pickle.dumps(each))
        assert (again.decides, again.scenarios) == (each.decides, each.scenarios)
    assert check.verified and check.decides == proof.decides
    push = mw.load("planar/trajectory")
    alone = mw.certify(push, push.theta_r_default)
    assert alone.decides is None and alone.scenarios == 0


def test_a_list_in_time_has_no_bound_but_valid_options(rejects):
    task = mw.load(TASKS / "turn_along_with_a_dead_thruster.toml")
    proof = mw.certify(task, budget=20)
    assert proof.status == "proven" and np.isnan(proof.bound) and np.isnan(proof.gap)
    for key, value in {"gap": 0, "seconds": -1, "threads": -1, "search": "none"}.items():
        assert key in str(rejects(mw.certify, task, budget=20, **{key: value}))
