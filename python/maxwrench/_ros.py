"""Answers as messages of ROS: dicts whose keys are the fields. Nothing of ROS is needed.

``json.dumps`` and ``to_yaml`` write them; ``ros2 topic pub`` reads the YAML.
"""

import numpy as np

from . import _frames
from ._errors import bad_value


def joint_state(answer, *, stamp=0.0, frame_id=""):
    """Returns a static answer as sensor_msgs/JointState.

    The message has joints only. A floating base and thrusters are not in it.

    Args:
        answer: an Answer of a static task.
        stamp: the time [s].
        frame_id: of the header.

    Returns:
        dict: header, name, position [rad or m], velocity [rad/s or m/s] and effort [N m or N]; each
        list has J entries. The efforts are those of the joints, behind any gears; the list is empty
        if the answer has no value.

    Raises:
        InputError: the answer is of a task in time, or has no posture; the stamp is not finite.

    >>> maxwrench.joint_state(maxwrench.evaluate("planar/force", [0, 0]))["name"]
    ['shoulder', 'elbow']
    """
    _require(answer, in_time=False)
    return {
        "header": _header(stamp, frame_id),
        "name": list(answer.task.robot.joint_names),
        "position": answer.q.tolist(),
        "velocity": _of_joints(answer, answer.velocity).tolist(),
        "effort": _efforts(answer).tolist(),
    }


def joint_trajectory(answer, *, stamp=0.0, frame_id=""):
    """Returns an answer in time as trajectory_msgs/JointTrajectory.

    The message has joints only. A floating base and thrusters are not in it.

    Args:
        answer: an Answer of a trajectory or an impulse.
        stamp: the time at which the motion begins [s]; 0: at once.
        frame_id: of the header.

    Returns:
        dict: header, joint_names and points. Each of the N points has positions, velocities, effort,
        each with J entries, accelerations (empty) and time_from_start.

    Raises:
        InputError: the answer is of a static task, or has no posture; the stamp is not finite.

    >>> task = maxwrench.load("planar/trajectory")
    >>> motion = maxwrench.joint_trajectory(maxwrench.evaluate(task, task.theta_r_default))
    >>> motion["points"][0]["time_from_start"]
    {'sec': 0, 'nanosec': 0}
    """
    _require(answer, in_time=True)
    velocities, efforts = _of_joints(answer, answer.velocity), _efforts(answer)
    points = [
        {
            "positions": answer.q[i].tolist(),
            "velocities": velocities[i].tolist(),
            "accelerations": [],
            "effort": efforts[i].tolist() if len(efforts) else [],
            "time_from_start": _time("t", t),
        }
        for i, t in enumerate(answer.t)
    ]
    names = list(answer.task.robot.joint_names)
    return {"header": _header(stamp, frame_id), "joint_names": names, "points": points}


def wrench_stamped(answer, *, frame_id, frame="end_effector", stamp=0.0):
    """Returns the wrench of a static answer as geometry_msgs/WrenchStamped.

    The message says that the wrench acts at the origin of a frame, in its axes.

    Args:
        answer: an Answer of a static task with a value.
        frame_id: the name of the frame.
        frame: which frame that is: "end_effector", or "world": the wrench is then moved to the origin
            of the world.
        stamp: the time [s].

    Returns:
        dict: header and wrench, with force [N] and torque [N m] that the robot exerts, each with x, y
        and z.

    Raises:
        InputError: the answer is of a task in time, or has no value; a value is wrong.

    >>> answer = maxwrench.evaluate("planar/force", [0, 0])
    >>> message = maxwrench.wrench_stamped(answer, frame_id="tool")
    >>> round(message["wrench"]["force"]["x"], 3)
    2.276
    """
    _require(answer, in_time=False)
    numbers = _frames.wrench(answer, frame, np.zeros(3) if frame == "world" else None)
    force, torque = (dict(zip("xyz", part.tolist())) for part in np.split(numbers, 2))
    return {"header": _header(stamp, frame_id), "wrench": {"force": force, "torque": torque}}


def to_yaml(message):
    """Returns a message as YAML, with its fields in their order.

    Args:
        message: a dict of lists, dicts, numbers and texts.

    Raises:
        ImportError: PyYAML is not installed.

    >>> print(maxwrench.to_yaml({"frame_id": "tool", "stamp": {"sec": 1, "nanosec": 0}}), end="")
    frame_id: tool
    stamp:
      sec: 1
      nanosec: 0
    """
    try:
        import yaml
    except ImportError:
        raise ImportError("to_yaml needs PyYAML; json.dumps needs nothing") from None
    return yaml.safe_dump(message, sort_keys=False)


def _require(answer, in_time):
    if (answer.t is not None) != in_time:
        kinds = ("a static task", "a task in time")
        raise bad_value("answer", f"one of {kinds[not in_time]}", f"one of {kinds[in_time]}")
    if answer.q is None:
        raise bad_value("answer", "no posture", "an answer with a posture")


def _time(key, seconds):
    if not np.isfinite(seconds) or seconds < 0:
        raise bad_value(key, seconds, "a time >= 0 in seconds")
    sec, nanosec = divmod(round(float(seconds) * 1e9), 10**9)
    return {"sec": sec, "nanosec": nanosec}


def _header(stamp, frame_id):
    return {"stamp": _time("stamp", stamp), "frame_id": frame_id}


def _of_joints(answer, numbers):
    """The joints' part of generalised forces or velocities (..., n): the last J."""
    return numbers[..., numbers.shape[-1] - len(answer.task.robot.joint_names) :]


def _efforts(answer):
    """Forces and torques of the joints' own actuators (..., J); empty without a value."""
    if answer.u is None:
        return np.empty(0)
    robot = answer.task.robot
    motors = slice(len(robot.thruster_names), None)
    return _of_joints(answer, answer.u[..., motors] @ robot.B[:, motors].T)
