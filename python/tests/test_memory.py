"""Memory: what calls leave behind, and what objects keep."""

import gc
import os
import pickle

import maxwrench as mw
import numpy as np
import pytest

# A sanitizer keeps what was freed for a while.
under_no_sanitizer = pytest.mark.skipif("asan" in os.environ.get("LD_PRELOAD", ""), reason="memory is that of a sanitizer")
slow = pytest.mark.skipif("MAXWRENCH_SLOW" not in os.environ, reason="takes minutes; MAXWRENCH_SLOW=1 runs it")


def resident():
    """The resident memory of this process [bytes]."""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def growth(body, warm_up, rounds):
    """How much more memory [bytes] the process has after `rounds` calls that follow `warm_up` ones."""
    for _ in range(warm_up):
        body()  # what is allocated once
    before = resident()
    for _ in range(rounds):
        body()
    gc.collect()
    return resident() - before


def exercise(task, theta_r, J):
    """Calls of all kinds, a hundred at a time."""
    for row in theta_r:
        answer = mw.evaluate(task, row)
        answer.u, answer.J, answer.residual  # noqa: B018
    rows = mw.evaluate(task, theta_r)
    rows.beta, rows.u, rows.status  # noqa: B018
    mw.capability(J, np.zeros((len(J), 7)), -np.ones(7), np.ones(7), "x").status  # noqa: B018
    mw.linprog([1, 2], [[1, 1]], [1]).x  # noqa: B018
    for seed in range(10):
        mw.solve(task, budget=20, seed=seed, callback=lambda count: None)
    for wrong in ([0, 0, 0], None, ["a", "b"]):
        with pytest.raises(mw.InputError):
            mw.evaluate(task, wrong)
    mw.load("planar/force").robot.B  # noqa: B018
    mw.Static(task.robot, pose=task.pose, c="x", any=["fx", "fy", "tz"])


@under_no_sanitizer
def test_memory_does_not_grow():
    rng = np.random.default_rng(6)
    task = mw.load("planar/force")
    theta_r, J = rng.uniform(-1, 1, (100, 2)), rng.normal(size=(50, 6, 7))
    assert growth(lambda: exercise(task, theta_r, J), 8, 30) < 4e6  # 3000 evaluations, 300 solves


@under_no_sanitizer
def test_robots_and_tasks_are_dropped():
    link = mw.Link("link", 1, inertia=[1, 1, 1])
    joint = mw.Joint("tilt", q_min=-1, q_max=1, effort_max=1)
    tool = [mw.EndEffector("tool", 1)]

    def body():
        robot = mw.make_robot([mw.Link("base"), link], [joint], end_effectors=tool, shapes=[mw.Shape("link", radius=1)])
        pickle.loads(pickle.dumps(mw.Static(robot, joints={"tilt": 0.1}, c="rz")))
        mw.load("uvms/valve").with_limits(-np.ones(12), np.ones(12))

    # A task alone holds some 20 kB.
    assert growth(body, 50, 300) < 3e6


@slow
@under_no_sanitizer
@pytest.mark.parametrize("name", ["planar/force", "fixed/push"])
def test_memory_after_10000_solves(name):
    task = mw.load(name)
    assert growth(lambda: mw.solve(task, search="cmaes", budget=20, threads=1, callback=False), 500, 10_000) < 3e6


@slow
@under_no_sanitizer
def test_memory_after_100000_evaluations():
    task, joints = mw.load("planar/force"), mw.load("fixed/push")
    q = [0, 0.3, 0, -1.5, 0, -0.6, 0]

    def body():
        answer = mw.evaluate(task, [0.1, 0.2])
        answer.u, answer.to_dict(), answer.links  # noqa: B018
        mw.evaluate_joints(joints, q)

    assert growth(body, 2000, 50_000) < 3e6


@slow
@under_no_sanitizer
def test_memory_after_100000_rows_of_a_measure_in_python():
    class Load(mw.Measure):
        name, unit = "load_in_memory_test", "N^2"

        def value(self, posture):
            return -posture.tau_d @ posture.tau_d if posture.theta_r[0] > 0 else np.nan

    mw.add_measure(Load())
    task = mw.load("uvms/lift")
    theta_r = task.theta_r_default + np.random.default_rng(1).uniform(-0.1, 0.1, (1000, 4))
    assert growth(lambda: mw.evaluate(task, theta_r, measure="load_in_memory_test"), 10, 100) < 3e6


def test_an_object_keeps_what_it_needs():
    # The robot of a task that is gone, the task of an answer that is gone.
    robot = mw.load("fixed/push").robot
    task = mw.evaluate("fixed/push", [0]).task
    mw.solve("planar/force", budget=50)
    assert len(robot.joint_names) == 7 and robot.B.shape == (7, 7)
    assert mw.evaluate(task, [0]).has_value and task.robot.u_max.shape == (7,)
