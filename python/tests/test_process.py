"""How the package behaves in a process: callbacks, threads, other processes."""

import multiprocessing
import subprocess
import sys
import threading
import time

import maxwrench as mw
import numpy as np
import pytest

LONG = 100_000_000  # evaluations, minutes
AT_ONCE = 5  # seconds: far from the minutes that the whole would take, so that a busy machine passes


def test_more_threads_than_cores_say_nothing():
    program = (
        "import maxwrench as mw;"
        "print([mw.solve('uvms/valve', search='sample', budget=2000, threads=n).beta for n in (1, 4, 64)])"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60)
    one, four, many = eval(done.stdout)
    assert done.stderr == "" and one == four == many


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
