"""How the package behaves in a process: Ctrl-C, callbacks, threads, other processes, memory."""

import gc
import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import threading
import time

import maxwrench as mw
import numpy as np
import pytest

LONG = 100_000_000  # evaluations, minutes
AT_ONCE = 5  # seconds: far from the minutes that the whole would take, so that a busy machine passes


# A sanitizer keeps what was freed for a while.
under_no_sanitizer = pytest.mark.skipif("asan" in os.environ.get("LD_PRELOAD", ""), reason="memory is that of a sanitizer")
slow = pytest.mark.skipif("MAXWRENCH_SLOW" not in os.environ, reason="takes minutes; MAXWRENCH_SLOW=1 runs it")


def resident():
    """The resident memory of this process [bytes]."""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


class Interrupt:
    """Sends SIGINT to this process after `delay` seconds, and keeps the time."""

    def __init__(self, delay):
        self.time = None
        self.timer = threading.Timer(delay, self.send)
        self.timer.start()

    def send(self):
        self.time = time.perf_counter()
        os.kill(os.getpid(), signal.SIGINT)


@pytest.mark.parametrize(
    "task, search",
    [
        ("uvms/valve", ""),
        ("uvms/valve", "cmaes"),
        ("uvms/valve", "crs2"),
        ("uvms/valve", "sample"),
        ("uvms/valve", "slsqp"),
        ("fixed/push", "de"),
        ("mobile/push", "facet_sqp"),
        ("uvms/valve_trajectory", "cmaes"),  # slp may end by itself before
        ("planar/trajectory", "cmaes"),
    ],
)
def test_ctrl_c_returns_the_best_so_far(task, search):
    interrupt = Interrupt(0.4)
    answer = mw.solve(task, search=search, budget=LONG, wrench="any" if task == "uvms/valve" else "pure")
    late = time.perf_counter() - interrupt.time
    assert answer.status == "budget_exhausted" and answer.reason == "interrupted"
    assert answer.has_value and 0 < answer.evaluations < LONG
    assert late < AT_ONCE
    # What is returned is an answer like any other: the same posture has this value.
    again = mw.evaluate(task, answer.theta_r, wrench=answer.wrench)
    assert again.beta == pytest.approx(answer.beta, rel=1e-9)


def test_ctrl_c_ends_a_race():
    interrupt = Interrupt(0.5)
    runs = mw.race("uvms/valve", ["cmaes", "sample"], seeds=50, budget=20_000)
    assert time.perf_counter() - interrupt.time < AT_ONCE
    assert 0 < len(runs["beta"]) < 100 and set(runs["status"]) == {"best_found"}


def test_ctrl_c_ends_rows_that_remain():
    task = mw.load("fixed/push")
    theta_r = np.linspace(-1, 1, 60_000)[:, None]  # several seconds for one thread
    interrupt = Interrupt(0.5)
    rows = mw.evaluate(task, theta_r, threads=1)
    assert time.perf_counter() - interrupt.time < AT_ONCE
    status = np.array(rows.status)
    left = status == "budget_exhausted"
    assert left.any() and not left.all() and len(rows) == 60_000
    assert np.all(np.isnan(rows.beta[left])) and not rows.valid[left].any()
    assert np.isfinite(rows.beta[rows.valid]).all() and rows.valid.any()


def test_ctrl_c_ends_programs_that_remain():
    rng = np.random.default_rng(1)
    J, tau_d = rng.normal(size=(200_000, 6, 12)), np.zeros((200_000, 12))
    interrupt = Interrupt(0.3)
    try:
        limits, free = np.ones(12), np.eye(6)[:, 1:]
        result = mw.capability(J, tau_d, -limits, limits, "x", free=free, solver="simplex", threads=1)
    except KeyboardInterrupt:
        pytest.fail("an interruption is an answer, not an exception")
    assert time.perf_counter() - interrupt.time < AT_ONCE
    assert "budget_exhausted" in repr(result) or np.isnan(result.beta).any()


def test_ctrl_c_during_a_linear_program_is_not_lost():
    # 400 rows take a second or more. It may end early with that status, or raise once it is done.
    rng = np.random.default_rng(1)
    A, c = rng.normal(size=(400, 1200)), rng.normal(size=1200)
    b = A @ rng.uniform(0, 1, 1200)
    Interrupt(0.1)
    try:
        status = mw.linprog(c, A, b, np.zeros(1200), np.full(1200, 2.0)).status
    except KeyboardInterrupt:
        status = "budget_exhausted"
    assert status == "budget_exhausted"


@pytest.mark.parametrize("name, options", [("uvms/valve", {"hold": 1000}), ("uvms/valve_trajectory", {"period": 1e-5})])
def test_ctrl_c_ends_an_experiment(name, options):
    # The whole would take most of a minute or more.
    task = mw.load(name)
    answer = mw.evaluate(task, task.theta_r_default)
    interrupt = Interrupt(1.5)
    experiment = mw.simulate(answer, **options)
    assert time.perf_counter() - interrupt.time < AT_ONCE
    assert (experiment.status, experiment.reason) == ("budget_exhausted", "interrupted")
    assert not experiment.held and "interrupted" in experiment.missed
    assert 0 < len(experiment.t) < 50_000 and np.all(np.diff(experiment.t) > 0)
    # What there is, is the beginning of the whole.
    if "hold" in options:
        whole = mw.simulate(answer, hold=1)
        both = min(len(whole.t), len(experiment.t), 500)  # the ramp, 500 periods, is that of any hold
        np.testing.assert_array_equal(experiment.readings[:both], whole.readings[:both])


def test_more_threads_than_cores_say_nothing():
    program = (
        "import maxwrench as mw;"
        "print([mw.solve('uvms/valve', search='sample', budget=2000, threads=n).beta for n in (1, 4, 64)])"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60)
    one, four, many = eval(done.stdout)
    assert done.stderr == "" and one == four == many


def test_ctrl_c_of_a_terminal():
    # A whole process, as a user runs it: it goes on after the solve and ends by itself.
    program = (
        "import maxwrench as mw, time; print('ready', flush=True);"
        f"answer = mw.solve('uvms/valve', budget={LONG}); print(answer.status, answer.has_value)"
    )
    pipe = subprocess.PIPE
    process = subprocess.Popen([sys.executable, "-c", program], stdout=pipe, stderr=pipe, text=True)
    try:
        assert process.stdout.readline() == "ready\n"
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=10)
    finally:
        process.kill()
    assert (out, err, process.returncode) == ("budget_exhausted True\n", "", 0)


def test_other_signal_handlers_may_raise():
    class Alarm(Exception):
        pass

    def ring(signum, frame):
        raise Alarm

    before = signal.signal(signal.SIGALRM, ring)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.3)
        start = time.perf_counter()
        with pytest.raises(Alarm):
            mw.solve("uvms/valve", budget=LONG)
        assert time.perf_counter() - start < AT_ONCE
    finally:
        signal.signal(signal.SIGALRM, before)


def test_callback_sees_progress_and_ends_the_search():
    seen = []

    def callback(evaluations):
        seen.append(evaluations)
        return len(seen) == 4

    start = time.perf_counter()
    answer = mw.solve("uvms/valve", wrench="any", search="cmaes", budget=LONG, callback=callback)
    assert 0.3 < time.perf_counter() - start  # a call every tenth of a second
    assert len(seen) == 4 and seen == sorted(seen) and seen[-1] > 0 and all(type(count) is int for count in seen)
    assert answer.status == "budget_exhausted" and answer.has_value and answer.evaluations >= seen[-1]


def test_true_of_numpy_ends_the_search():
    # A callback that compares numbers of NumPy returns such a one.
    calls = []

    def callback(evaluations):
        calls.append(evaluations)
        return np.bool_(True) if len(calls) < 10 else True

    mw.solve("uvms/valve", wrench="any", search="cmaes", budget=LONG, callback=callback)
    assert len(calls) == 1


def test_only_true_ends_the_search():
    calls = []
    answer = mw.solve("uvms/valve", search="sample", budget=400_000, callback=lambda count: calls.append(count) or 1)
    assert calls and answer.status == "best_found" and answer.evaluations == 400_000


def test_callback_of_rows():
    task = mw.load("fixed/push")
    seen = []

    def callback(evaluations):
        seen.append(evaluations)
        return len(seen) == 4

    rows = mw.evaluate(task, np.linspace(-1, 1, 60_000)[:, None], threads=1, callback=callback)
    assert "budget_exhausted" in rows.status and rows.valid.any()
    assert seen == sorted(seen) and 0 < seen[-1] <= 60_000  # postures so far


@pytest.mark.parametrize("error", [ZeroDivisionError, KeyboardInterrupt, SystemExit, StopIteration])
def test_an_exception_of_the_callback_reaches_the_caller(error):
    def callback(evaluations):
        raise error("from the callback")

    start = time.perf_counter()
    with pytest.raises(error, match="from the callback"):
        mw.solve("uvms/valve", budget=LONG, callback=callback)
    assert time.perf_counter() - start < AT_ONCE
    assert mw.solve("planar/force", budget=20).has_value  # and the next call works


def test_a_callback_may_call_the_package():
    inner = []

    def callback(evaluations):
        inner.append((mw.evaluate("planar/force", [0, 0]).beta, mw.solve("planar/force", budget=20).has_value))
        return True

    assert mw.solve("uvms/valve", budget=LONG, callback=callback).status == "budget_exhausted"
    assert inner == [(mw.evaluate("planar/force", [0, 0]).beta, True)]


def test_threads_of_python_run_during_a_solve():
    ticks, done = [], threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.005)

    thread = threading.Thread(target=tick)
    thread.start()
    try:
        start = time.perf_counter()
        mw.solve("uvms/valve", search="sample", budget=300_000, threads=1)
        end = time.perf_counter()
    finally:
        done.set()
        thread.join()
    inside = [t for t in ticks if start < t < end]
    assert end - start > 0.05 and len(inside) > 0.2 * (end - start) / 0.005


def test_import_needs_numpy_alone():
    program = (
        "import sys, maxwrench; maxwrench.solve('planar/force', budget=20).summary();"
        "maxwrench.linprog([1], [[1]], [1]);"
        "print([name for name in ('scipy', 'pandas', 'matplotlib', 'pinocchio') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=30)
    assert (done.stdout, done.stderr) == ("[]\n", "")


def run_in_threads(count, function):
    """The results of function(0), function(1), ... in as many Python threads."""
    results = [None] * count

    def work(i):
        results[i] = function(i)

    threads = [threading.Thread(target=work, args=(i,)) for i in range(count)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return results


def test_solves_side_by_side_are_those_one_by_one():
    task = mw.load("uvms/valve")

    def solve(i):
        answer = mw.solve(task, seed=i, budget=300, wrench="any")
        return answer.beta, answer.theta_r.tolist(), answer.evaluations

    assert run_in_threads(4, solve) == [solve(i) for i in range(4)]


def test_calls_of_all_kinds_side_by_side():
    rng = np.random.default_rng(5)
    task = mw.load("uvms/lift")
    rows = task.theta_r_default + rng.uniform(-0.1, 0.1, (200, 4))
    J, tau_d = rng.normal(size=(20, 6, 7)), np.zeros((20, 7))

    def work(i):
        limits = np.full(7, 1.0 + i)  # other limits in each thread: the kept facets are shared
        return (
            mw.evaluate(task, rows).beta.tolist(),
            [mw.capability(J[k], tau_d[k], -limits, limits, "x").beta for k in range(20)],
            mw.linprog([1, 2], [[1, 1]], [1 + i]).objective,
            mw.scale(None, -limits, limits, tau_d[0], np.ones(7)).beta,
        )

    assert repr(run_in_threads(4, work)) == repr([work(i) for i in range(4)])


def evaluate_in_child(arguments):
    task, theta_r = arguments
    return mw.evaluate(task, theta_r).beta


def solve_in_child(arguments):
    task, seed = arguments
    answer = mw.solve(task, seed=seed, budget=60)
    return answer.beta, answer.theta_r.tolist()


def actuators_in_child(robot):
    return robot.u_max.tolist()


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_other_processes(method):
    task = mw.load("fixed/push")
    made = mw.Static(task.robot, pose=task.pose, c="x", theta_r=["joint_7"], theta_r_default=[0])
    expected = [solve_in_child((made, seed)) for seed in (1, 2)]  # threads have run before the fork
    with multiprocessing.get_context(method).Pool(2) as pool:
        betas = pool.map_async(evaluate_in_child, [(task, [0.1 * i]) for i in range(4)]).get(30)
        assert betas == [mw.evaluate(task, [0.1 * i]).beta for i in range(4)]
        assert pool.map_async(solve_in_child, [(made, 1), (made, 2)]).get(30) == expected
        assert pool.map_async(actuators_in_child, [task.robot]).get(30) == [task.robot.u_max.tolist()]


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


def growth(body, warm_up, rounds):
    """How much more memory [bytes] the process has after `rounds` calls that follow `warm_up` ones."""
    for _ in range(warm_up):
        body()  # what is allocated once
    before = resident()
    for _ in range(rounds):
        body()
    gc.collect()
    return resident() - before


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
