"""Answers as messages of ROS."""

import json
import sys
from types import SimpleNamespace

import maxwrench as mw
import numpy as np
import pytest


def static():
    task = mw.load("uvms/valve")
    return mw.evaluate(task, task.theta_r_default)


def in_time():
    task = mw.load("uvms/valve_trajectory")
    return mw.evaluate(task, task.theta_r_default)


def test_joint_state():
    answer = static()
    message = mw.joint_state(answer, stamp=12.25, frame_id="map")
    assert list(message) == ["header", "name", "position", "velocity", "effort"]
    assert message["header"] == {"stamp": {"sec": 12, "nanosec": 250000000}, "frame_id": "map"}
    assert message["name"] == ["q1_shoulder_yaw", "q2_shoulder_pitch", "q3_elbow", "q4_wrist_roll"]
    assert message["position"] == answer.q.tolist() and message["velocity"] == [0] * 4
    assert message["effort"] == answer.u[8:].tolist()  # direct drives behind eight thrusters
    assert json.loads(json.dumps(message, allow_nan=False)) == message


def test_efforts_behind_gears():
    # Two motors drive joint 1 by gears of 10 and 20, a thruster pushes at both joints and the base.
    robot = SimpleNamespace(
        joint_names=["a", "b"],
        thruster_names=["t"],
        B=np.array([[5.0, 0, 0, 0], [7, 10, 20, 0], [9, 0, 0, 1]]),
    )
    answer = SimpleNamespace(
        t=None, q=np.zeros(2), velocity=np.array([9.0, 1, 2]), u=np.array([100.0, 1, 2, 3]), task=SimpleNamespace(robot=robot)
    )
    message = mw.joint_state(answer)
    assert message["effort"] == [50, 3] and message["velocity"] == [1, 2]


def test_a_posture_without_value_has_no_efforts():
    message = mw.joint_state(mw.evaluate("uvms/valve", [0, 0, 0, 0]))
    assert message["effort"] == [] and len(message["position"]) == 4


def test_joint_trajectory():
    answer = in_time()
    message = mw.joint_trajectory(answer, stamp=3)
    assert list(message) == ["header", "joint_names", "points"] and len(message["points"]) == len(answer.t)
    last = message["points"][-1]
    assert list(last) == ["positions", "velocities", "accelerations", "effort", "time_from_start"]
    assert last["time_from_start"] == {"sec": 5, "nanosec": 0}
    assert last["positions"] == answer.q[-1].tolist() and last["effort"] == answer.u[-1, 8:].tolist()
    json.dumps(message, allow_nan=False)


def test_wrench_stamped():
    answer = static()
    message = mw.wrench_stamped(answer, frame_id="world", frame="world", stamp=0.5)
    assert list(message) == ["header", "wrench"] and list(message["wrench"]) == ["force", "torque"]
    about_origin = answer.h[3:] + np.cross(answer.end_effector[:3, 3], answer.h[:3])
    np.testing.assert_allclose(list(message["wrench"]["torque"].values()), about_origin, atol=1e-12)
    at_tool = mw.wrench_stamped(answer, frame_id="tool")["wrench"]
    np.testing.assert_allclose(list(at_tool["force"].values()), answer.end_effector[:3, :3].T @ answer.h[:3], atol=1e-12)
    json.dumps(message, allow_nan=False)


def test_time_carries():
    assert mw.joint_state(static(), stamp=1.9999999999)["header"]["stamp"] == {"sec": 2, "nanosec": 0}


@pytest.mark.parametrize(
    "call, key",
    [
        (lambda: mw.joint_state(in_time()), "answer"),
        (lambda: mw.joint_trajectory(static()), "answer"),
        (lambda: mw.wrench_stamped(in_time(), frame_id="world"), "answer"),
        (lambda: mw.wrench_stamped(mw.evaluate("uvms/valve", [0, 0, 0, 0]), frame_id="world"), "answer"),
        (lambda: mw.joint_state(static(), stamp=np.nan), "stamp"),
        (lambda: mw.joint_state(static(), stamp=-1), "stamp"),
    ],
)
def test_wrong_arguments(call, key):
    with pytest.raises(mw.InputError) as caught:
        call()
    assert caught.value.key == key and "\n" not in str(caught.value)


def test_yaml(monkeypatch):
    yaml = pytest.importorskip("yaml")
    message = mw.joint_trajectory(in_time())
    assert yaml.safe_load(mw.to_yaml(message)) == message
    monkeypatch.setitem(sys.modules, "yaml", None)
    with pytest.raises(ImportError, match="PyYAML"):
        mw.to_yaml(message)
