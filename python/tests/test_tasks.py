"""Tasks, robots, poses and paths: what is loaded, made in code and pickled."""

import pickle

import maxwrench as mw
import numpy as np
import pytest
from scipy.spatial.transform import Rotation


@pytest.mark.parametrize("name", mw.tasks())
def test_shipped_tasks(name):
    task = mw.load(name)
    robot = task.robot
    r, joints = len(task.theta_r_names), len(robot.joint_names)
    velocities, actuators = len(robot.base) + joints, len(robot.actuator_names)
    assert task.name == name and task.type in ("static", "trajectory", "impulse") and task.unit in ("N", "N m")
    assert task.c.shape == (6,) and np.linalg.norm(task.c) == pytest.approx(1)
    for array in (task.theta_r_min, task.theta_r_max, task.theta_r_default):
        assert array.shape == (r,)
    assert np.all(task.theta_r_min <= task.theta_r_default) and np.all(task.theta_r_default <= task.theta_r_max)
    basis = task.W_any
    np.testing.assert_allclose(basis.T @ basis, np.eye(basis.shape[1]), atol=1e-12)
    np.testing.assert_allclose(basis @ basis.T @ task.c, task.c, atol=1e-12)  # c is among the wrenches
    assert robot.B.shape == (velocities, actuators)
    assert robot.u_min.shape == robot.u_max.shape == (actuators,) and np.all(robot.u_min < robot.u_max)
    for array in (robot.q_min, robot.q_max, robot.velocity_max):
        assert array.shape == (joints,)
    assert len(robot.link_names) == joints + 1 and set(task.dependent) <= set(robot.joint_names)
    # Thrusters come first, then one direct drive for each joint of these robots.
    assert robot.actuator_names == robot.thruster_names + robot.joint_names
    answer = mw.evaluate(task, task.theta_r_default)
    assert answer.status == "optimal" and answer.has_value and answer.reason == ""
    rows = () if task.type == "static" else answer.t.shape
    assert answer.q.shape == rows + (joints,) and answer.theta.shape == rows + (6 + joints,)
    assert answer.u.shape == rows + (actuators,) and answer.h.shape == rows + (6,)
    assert answer.tau_d.shape == answer.velocity.shape == rows + (velocities,)
    if task.type == "static":
        assert answer.theta_r.shape == answer.gradient.shape == (r,) and task.knots == 1
        assert answer.J.shape == (6, velocities) and answer.lambda_.shape == (velocities,) and answer.t is None
    else:
        assert answer.gradient.shape == (task.knots, r) and answer.J is None and answer.lambda_ is None
        assert answer.t[0] == 0 and np.all(np.diff(answer.t) > 0)


def test_files_may_be_paths(problems):
    path = problems / "fixed" / "push.toml"
    assert mw.evaluate(path, [0.2]).beta == mw.evaluate(str(path), [0.2]).beta == mw.evaluate("fixed/push", [0.2]).beta
    robot = mw.Robot.from_toml(problems / "fixed" / "arm.toml")
    assert robot.name == mw.load("fixed/push").robot.name and robot.base == []


def test_static_task_in_code_is_that_of_the_file():
    robot = mw.load("fixed/push").robot
    made = mw.Static(
        robot,
        pose=mw.Pose([0.6, 0.1, 0.5], rpy=[0, np.pi / 2, 0]),
        c=[1, 0, -0.5, 0, 0, 0],
        theta_r=["joint_7"],
        theta_r_default=[0],
        guess={"joint_1": 0.1, "joint_2": 0.2, "joint_4": -2, "joint_6": -0.6},
    )
    assert made.digest == "" and made.theta_r_names == ["joint_7"] and made.dependent == robot.joint_names[:6]
    for theta_r in (-0.4, 0, 0.3):
        for wrench in ("pure", "any"):
            mine, of_file = (mw.evaluate(task, [theta_r], wrench=wrench) for task in (made, "fixed/push"))
            assert mine.beta == of_file.beta and np.array_equal(mine.u, of_file.u) and np.array_equal(mine.q, of_file.q)


def test_static_task_with_a_free_pose():
    of_file = mw.load("mobile/push_any_height")
    made = mw.Static(
        of_file.robot,
        pose=mw.Pose([0, 0, 0.9]),
        c="x",
        range={"z": [-0.4, 0.3], "yaw": [-0.7, 0.7]},
        theta_r=["shoulder_yaw", "shoulder_pitch"],
    )
    assert made.theta_r_names == of_file.theta_r_names == ["shoulder_yaw", "shoulder_pitch", "pose_z", "pose_yaw"]
    theta_r = of_file.theta_r_default + [0.05, 0.02, 0.1, -0.2]
    assert mw.evaluate(made, theta_r).beta == mw.evaluate(of_file, theta_r).beta
    joints = "shoulder_yaw,shoulder_pitch"
    named = mw.Static(of_file.robot, pose=mw.Pose([0, 0, 0.9]), c="x", free="roll", theta_r=joints)
    assert named.theta_r_names == ["shoulder_yaw", "shoulder_pitch", "pose_roll"]


def test_static_task_at_joint_positions():
    # The joints put the tool somewhere, and are one of the IK solutions there; the task takes the best one.
    robot = mw.load("fixed/push").robot
    at = {"joint_2": 0.4, "joint_4": -1.2, "joint_6": -0.6}
    made = mw.Static(robot, joints=at, c="z", theta_r=["joint_7"])
    q = [at.get(name, 0) for name in robot.joint_names]
    at_joints, best = mw.evaluate_joints(made, q), mw.evaluate(made, made.theta_r_default)
    assert made.theta_r_default.tolist() == [0] and np.array_equal(at_joints.q, q)
    assert best.beta >= at_joints.beta - 1e-9
    assert mw.evaluate_joints(made, best.q).beta == pytest.approx(best.beta, rel=1e-9)


def test_trajectories_in_code_are_those_of_the_files():
    of_file = mw.load("planar/trajectory")
    path = mw.Path.screw(mw.Pose(rpy=[0, 0, np.deg2rad(10)]), 10, axis=[0, 0, 3], angle=np.pi / 2)
    made = mw.Trajectory(
        of_file.robot,
        path,
        8,
        c="x",
        any="fx, fy, tz",
        theta_r=["shoulder", "elbow"],
        theta_r_default=[0, 0],
        instants_per_interval=4,
    )
    knots = np.linspace(0, 0.1, 16).reshape(8, 2)
    for wrench in ("pure", "any"):
        mine, theirs = (mw.evaluate(task, knots, wrench=wrench) for task in (made, of_file))
        assert mine.beta == theirs.beta and np.array_equal(mine.u, theirs.u) and np.array_equal(mine.t, theirs.t)

    of_file = mw.load("mobile/trajectory")
    arc = mw.Path.screw(mw.Pose([0, 0, 0.9], rpy=[0, 0, 0.7]), 3, centre=[0, 0.9, 0.9], angle=np.pi / 3)
    made = mw.Trajectory(
        of_file.robot,
        arc,
        8,
        c=[0.7648421872844885, -0.644217687237691, 0, 0, 0, 0],
        frame="end_effector",
        theta_r=["shoulder_yaw", "shoulder_pitch"],
        theta_r_default=[0, -1],
        guess={"elbow": 1, "wrist_pitch": 0, "wrist_roll": 0},
        instants_per_interval=4,
    )
    assert mw.evaluate(made, [0, -1]).beta == mw.evaluate(of_file, [0, -1]).beta


def test_impulse_in_code_is_that_of_the_file():
    of_file = mw.load("uvms/lift_impulse")
    start = [1.6426219953509538, 2.514254535592615, 0.4287960474510716, -1.098856960424253]
    made = mw.Impulse(
        of_file.robot, mw.Pose(), 2.5, 4, t_h=3, start="static", theta_0=start, theta_r=of_file.theta_r_names, c="z"
    )
    assert made.type == "impulse" and made.knots == 4
    mine, theirs = (mw.evaluate(task, start) for task in (made, of_file))
    assert mine.status == theirs.status == "optimal"
    assert mine.beta == theirs.beta and np.array_equal(mine.u, theirs.u)
    # Both reject an acceleration at the start, with the same line.
    moving = np.array(start) + np.outer([0, 0.01, 0.03, 0.02], [1, 0, 0, 0])
    mine, theirs = (mw.evaluate(task, moving) for task in (made, of_file))
    assert mine.status == theirs.status == "invalid_posture" and mine.reason == theirs.reason != ""


def test_one_direction_in_different_forms():
    robot = mw.load("fixed/push").robot
    at = {"joint_2": 0.4, "joint_4": -1.2, "joint_6": -0.6}
    for name, c in [("-z", [0, 0, -2, 0, 0, 0]), ("ry", [0, 0, 0, 0, 5, 0]), ("+x", [1, 0, 0, 0, 0, 0])]:
        one, other = (mw.Static(robot, joints=at, c=form, theta_r=["joint_7"]) for form in (name, c))
        assert np.array_equal(one.c, other.c)
        assert mw.evaluate(one, [0]).beta == mw.evaluate(other, [0]).beta


def test_a_force_in_the_axes_of_the_end_effector():
    # The tool's z axis is along the world's x in fixed/push, so z of the tool is x of the world.
    robot = mw.load("fixed/push").robot
    named = {"pose": mw.load("fixed/push").pose, "theta_r": ["joint_7"], "theta_r_default": [0]}
    of_tool = mw.Static(robot, c="z", frame="end_effector", **named)
    of_world = mw.Static(robot, c="x", **named)
    assert mw.evaluate(of_tool, [0]).beta == pytest.approx(mw.evaluate(of_world, [0]).beta, rel=1e-9)


def test_robot_from_a_urdf(problems):
    robot = mw.Robot.from_urdf(problems / "fixed" / "arm.urdf")
    assert robot.base == [] and robot.end_effectors == ["link_7"]
    np.testing.assert_array_equal(robot.u_max, mw.load("fixed/push").robot.u_max)
    parked = mw.Robot.from_urdf(problems / "fixed" / "arm.urdf", base="yaw, x, y", tool="link_5")
    assert parked.base == ["x", "y", "yaw"] and parked.end_effectors == ["link_5"]


def test_joints_without_effort_stay_where_they_are_put(tmp_path):
    # An arm along x, with 3 kg on a flap 0.3 m from a joint at 0.6 m. The motor bears 100 N m about y.
    (tmp_path / "arm.urdf").write_text("""<robot name='arm'>
      <link name='base'/><link name='rod'/><link name='tool'/>
      <link name='flap'><inertial><origin xyz='0.3 0 0'/><mass value='3'/>
        <inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>
      <joint name='a' type='revolute'><parent link='base'/><child link='rod'/><axis xyz='0 1 0'/>
        <limit lower='-2' upper='2' effort='100' velocity='1'/></joint>
      <joint name='t' type='fixed'><parent link='rod'/><child link='tool'/><origin xyz='1 0 0'/></joint>
      <joint name='flap' type='revolute'><parent link='rod'/><child link='flap'/><origin xyz='0.6 0 0'/>
        <axis xyz='0 1 0'/><limit lower='-2' upper='2' velocity='1'/></joint></robot>""")
    robot = mw.Robot.from_urdf(tmp_path / "arm.urdf", tool="tool", joints={"a": 0, "flap": 1.2})
    assert robot.joint_names == ["a"]
    lift = mw.Static(robot, joints={"a": 0}, c="z")
    assert mw.evaluate_joints(lift, [0]).beta == pytest.approx(100 - 3 * 9.81 * (0.6 + 0.3 * np.cos(1.2)), rel=1e-9)
    assert pickle.loads(pickle.dumps(lift)).robot.joint_names == ["a"]
    with pytest.raises(mw.InputError, match="flap = 3"):
        mw.Robot.from_urdf(tmp_path / "arm.urdf", tool="tool", joints={"flap": 3})


def test_pickled_objects_are_made_again():
    robot = mw.load("fixed/push").robot
    path = mw.Path.screw(mw.Pose(rpy=[0, 0, 0.2]), 10, angle=1.0, timing="quintic")
    vehicle = mw.load("planar/force").robot
    tasks = [
        mw.load("uvms/valve"),
        mw.Static(robot, pose=mw.load("fixed/push").pose, c="x", theta_r=["joint_7"], theta_r_default=[0]),
        mw.Trajectory(vehicle, path, 4, c="x", any=["fx", "fy", "tz"]),
    ]
    for task in tasks:
        again = pickle.loads(pickle.dumps(task))
        assert repr(again) == repr(task) and again.digest == task.digest
        theta_r = task.theta_r_default
        assert mw.evaluate(again, theta_r).beta == mw.evaluate(task, theta_r).beta
    again = pickle.loads(pickle.dumps(robot))
    assert repr(again) == repr(robot) and np.array_equal(again.B, robot.B)
    pose = mw.Pose([1, 2, 3], rpy=[0.1, 0.2, 0.3])
    assert pickle.loads(pickle.dumps(pose)) == pose
    assert pickle.loads(pickle.dumps(path)).at(3.3) == path.at(3.3)
    times, poses = [0, 1, 3], [pose, mw.Pose([1, 1, 1]), mw.Pose()]
    spline = mw.Path.spline(times, poses)
    assert pickle.loads(pickle.dumps(spline)).at(1.7) == spline.at(1.7)


def test_pickled_answers_have_the_same_numbers():
    for answer in (
        mw.evaluate("uvms/valve", mw.load("uvms/valve").theta_r_default, wrench="any"),
        mw.evaluate("planar/force", [0, 1.2]),
        mw.evaluate("planar/trajectory", [0.1, 0.1]),
        mw.solve("planar/force", budget=60, seed=4),
        mw.evaluate_joints("fixed/push", [0, 0.4, 0, -1.2, 0, -0.6, 0]),
    ):
        again = pickle.loads(pickle.dumps(answer))
        assert repr(again) == repr(answer) and again.status == answer.status
        for name in ("beta", "theta_r", "q", "u", "h", "gradient", "t"):
            mine, stored = getattr(again, name), getattr(answer, name)
            assert mine is None if stored is None else np.array_equal(mine, stored, equal_nan=True), name


def test_a_recipe_keeps_its_own_arguments():
    # What is changed after the call does not change what is made again.
    direction, guess = np.array([1.0, 0, 0, 0, 0, 0]), {"joint_4": -2.0}
    robot = mw.load("fixed/push").robot
    made = mw.Static(robot, pose=mw.load("fixed/push").pose, c=direction, theta_r=["joint_7"], guess=guess)
    stored = mw.evaluate(made, [0]).beta
    direction[:] = [0, 0, 1, 0, 0, 0]
    guess["joint_4"] = 50.0
    assert mw.evaluate(pickle.loads(pickle.dumps(made)), [0]).beta == stored
    axis = np.array([0.0, 0, 1])
    path = mw.Path.screw(mw.Pose([1, 0, 0]), 1, axis=axis, centre=[0, 0, 0], angle=1.0)
    axis[:] = [1, 0, 0]
    assert pickle.loads(pickle.dumps(path)).at(1) == path.at(1)


def test_a_pickled_task_whose_files_have_changed_is_rejected(problems, tmp_path, rejects):
    for name in ("push.toml", "arm.toml", "arm.urdf"):
        (tmp_path / name).write_bytes((problems / "fixed" / name).read_bytes())
    stored = pickle.dumps(mw.load(tmp_path / "push.toml"))
    assert pickle.loads(stored).unit == "N"
    text = (tmp_path / "push.toml").read_text()
    (tmp_path / "push.toml").write_text(text.replace("xyz = [0.6, 0.1, 0.5]", "xyz = [0.6, 0.1, 0.4]"))
    assert rejects(pickle.loads, stored).key == "digest"
    (tmp_path / "push.toml").unlink()
    with pytest.raises(mw.MissingFileError):
        pickle.loads(stored)


def test_poses_are_rigid_transformations():
    rng = np.random.default_rng(1)
    for _ in range(20):
        rotations = Rotation.random(2, random_state=rng)
        ps = rng.normal(size=(2, 3))
        a, b = (mw.Pose(p, R=R) for p, R in zip(ps, rotations.as_matrix()))
        np.testing.assert_allclose((a * b).R, (rotations[0] * rotations[1]).as_matrix(), atol=1e-14)
        np.testing.assert_allclose((a * b).p, ps[0] + rotations[0].apply(ps[1]), atol=1e-14)
        np.testing.assert_allclose((a * b).matrix, a.matrix @ b.matrix, atol=1e-14)
        np.testing.assert_allclose(a.inverse().matrix, np.linalg.inv(a.matrix), atol=1e-13)
        np.testing.assert_allclose((a * a.inverse()).matrix, np.eye(4), atol=1e-14)
        # R = Rz(yaw) Ry(pitch) Rx(roll): extrinsic rotations about x, y, z.
        np.testing.assert_allclose(a.rpy, rotations[0].as_euler("xyz"), atol=1e-12)
        np.testing.assert_allclose(mw.Pose(rpy=a.rpy).R, a.R, atol=1e-13)
        wxyz = np.roll(rotations[0].as_quat(), 1)
        np.testing.assert_allclose(a.quaternion, wxyz * np.sign(wxyz @ a.quaternion), atol=1e-13)
        np.testing.assert_allclose(mw.Pose(quaternion=-wxyz).R, a.R, atol=1e-13)
        assert mw.Pose.from_matrix(a.matrix) == a


def test_poses_compare():
    a = mw.Pose([1, 2, 3])
    assert a == mw.Pose([1, 2, 3]) and a != mw.Pose([1, 2, 4]) and mw.Pose() == mw.Pose([0, 0, 0], rpy=[0, 0, 0])
    assert a != 5 and not a == None and a not in [None, "a"]  # noqa: E711: the comparison is what is tested
    with pytest.raises(TypeError):
        a * 5


def test_arrays_of_a_pose_are_copies():
    pose = mw.Pose([1, 2, 3])
    pose.p[0] = 9
    pose.R[0, 0] = 9
    assert pose.p.tolist() == [1, 2, 3] and pose.R[0, 0] == 1
    task = mw.load("planar/force")
    task.c[:] = 9
    assert task.c.tolist() == [1, 0, 0, 0, 0, 0]


@pytest.mark.parametrize(
    "timing, progress",
    [
        ("linear", lambda x: x),
        ("cubic", lambda x: 3 * x**2 - 2 * x**3),  # zero slope at 0 and 1
        ("quintic", lambda x: 10 * x**3 - 15 * x**4 + 6 * x**5),  # and zero second derivative
    ],
)
def test_screw(timing, progress):
    # x(t) = centre + R(s angle) (start - centre) + s displacement, with s the progress.
    start = mw.Pose([0.5, 0.1, 0.3], rpy=[0.2, -0.1, 0.4])
    axis, angle = np.array([1, 2, -2]) / 3, 1.3
    centre, displacement = np.array([0.1, 0.2, 0.3]), np.array([0.1, 0, -0.2])
    path = mw.Path.screw(
        start, 2.5, axis=5 * axis, centre=centre, angle=angle, displacement=displacement, timing=timing
    )
    assert path.duration == 2.5
    for t in np.linspace(0, 2.5, 11):
        s = progress(t / 2.5)
        turn = Rotation.from_rotvec(axis * angle * s)
        np.testing.assert_allclose(path.at(t).R, turn.as_matrix() @ start.R, atol=1e-13)
        np.testing.assert_allclose(path.at(t).p, centre + turn.apply(start.p - centre) + s * displacement, atol=1e-13)


def test_screw_about_its_own_origin_by_default():
    path = mw.Path.screw(mw.Pose([1, 2, 3]), 1, angle=np.pi)
    np.testing.assert_allclose(path.at(1).R, np.diag([-1, -1, 1]), atol=1e-15)
    assert path.at(1).p.tolist() == [1, 2, 3]


def test_spline():
    # A cubic spline at rest at t = 0 and 3, with a knot at 1. Its slope v there follows from equal second
    # derivatives: 2 (h_0 + h_1) v = 3 (h_1 d_0 + h_0 d_1), h = 1 and 2, d the mean slopes of the parts.
    # x: 0, 1, 1: d = 1, 0, v = 1.   y: 0, 0, 2: d = 0, 1, v = 0.5.
    path = mw.Path.spline([0, 1, 3], [mw.Pose(), mw.Pose([1, 0, 0]), mw.Pose([1, 2, 0])])
    # Hermite's form in the middle of a part: (a + b) / 2 + h (v_a - v_b) / 8.
    np.testing.assert_allclose(path.at(0.5).p, [0.5 - 1 / 8, 0 - 0.5 / 8, 0], atol=1e-14)
    np.testing.assert_allclose(path.at(2).p, [1 + 2 / 8, 1 + 2 * 0.5 / 8, 0], atol=1e-14)
    for t, p in [(0, [0, 0, 0]), (1, [1, 0, 0]), (3, [1, 2, 0])]:
        np.testing.assert_allclose(path.at(t).p, p, atol=1e-14)
    assert path.duration == 3
    # At rest at both ends: a step of dt moves it by the order of dt^2.
    assert np.abs(path.at(1e-4).p - path.at(0).p).max() < 1e-6
    assert np.abs(path.at(3 - 1e-4).p - path.at(3).p).max() < 1e-6


def test_spline_of_rotations():
    # Poses that turn about one axis stay rotations about it, and pass through their knots.
    rng = np.random.default_rng(2)
    axis = np.array([2, -1, 2]) / 3
    angles = [0, 1.2, 0.4, 2.0]
    times = [0, 0.5, 1.5, 2]
    path = mw.Path.spline(times, [mw.Pose(R=Rotation.from_rotvec(axis * a).as_matrix()) for a in angles])
    for t, angle in zip(times, angles):
        np.testing.assert_allclose(path.at(t).R, Rotation.from_rotvec(axis * angle).as_matrix(), atol=1e-13)
    for t in rng.uniform(0, 2, 20):
        vector = Rotation.from_matrix(path.at(t).R).as_rotvec()
        np.testing.assert_allclose(np.cross(vector, axis), 0, atol=1e-12)
