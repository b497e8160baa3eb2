"""Ctrl-C in every call that computes: the best so far where there is one, KeyboardInterrupt elsewhere.

No computation here would end by itself within minutes, so that a call that returns has seen the signal.
"""

import os
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


def test_ctrl_c_of_a_linear_program_with_another_solver_is_not_lost():
    # 400 rows take seconds. It raises once the solver, which knows no interruption, is done.
    rng = np.random.default_rng(1)
    A, c = rng.normal(size=(400, 1200)), rng.normal(size=1200)
    Interrupt(0.1)
    with pytest.raises(KeyboardInterrupt):
        mw.linprog(c, A, A @ rng.uniform(0, 1, 1200), np.zeros(1200), np.full(1200, 2.0), solver="clp")


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


def press(after=0):
    """A callback that lets Ctrl-C be pressed, once, while the call computes and that many evaluations are done."""
    pressed = []

    def callback(evaluations):
        if evaluations >= after and not pressed:
            pressed.append(Interrupt(0.01))

    return callback


def test_ctrl_c_ends_a_map():
    # A million cells.
    over = {"x": (-0.1, 0.1, 1000), "y": (-0.1, 0.1, 1000)}
    found = mw.map("planar/force", over, budget=50, callback=press(1))
    assert found.status == "budget_exhausted" and 0 < len(found) < 1_000_000
    assert set(found.statuses) <= {"best_found", "none_found"}  # what there is, is complete


def test_ctrl_c_ends_the_proofs_of_a_map():
    over = {"x": (-0.1, 0.1, 900), "y": (-0.1, 0.1, 900)}
    found = mw.map("planar/force", over, budget=50, certify=True, gap=1e-7, callback=press(1))
    assert found.status == "budget_exhausted" and len(found) < 810_000
    assert (found.bound >= found.beta)[np.isfinite(found.beta)].all()


def test_ctrl_c_ends_a_front():
    front = mw.pareto("uvms/valve", "uvms/lift", points=1000, budget=LONG, callback=press())
    assert front.status == "budget_exhausted" and len(front) < 1000


def test_ctrl_c_ends_a_comparison_of_losses():
    cost = mw.sensitivity("uvms/valve", budget=LONG, callback=press())
    assert len(cost.losses) > 1 and np.isnan(cost.losses[-1].best)  # the last search has not begun
    assert np.isfinite(cost.losses[0].at_posture) and np.isnan(cost.all.best)


def test_ctrl_c_ends_a_proof():
    proof = mw.certify("uvms/valve", budget=1000, gap=1e-8, seconds=1e6, callback=press())
    assert (proof.status, proof.reason) == ("bracket", "interrupted")
    assert proof.beta <= proof.bound and mw.evaluate("uvms/valve", proof.answer.theta_r).beta == pytest.approx(proof.beta, rel=1e-9)


def test_ctrl_c_ends_the_search_of_a_proof_in_time():
    proof = mw.certify("uvms/valve_trajectory", budget=LONG, search="cmaes", callback=press())
    assert proof.answer.evaluations < LONG and proof.answer.has_value


def test_ctrl_c_ends_a_search_for_what_a_task_holds():
    held = mw.solve_held("uvms/valve_trajectory", budget=LONG, simulations=1000, callback=press())
    assert held.status == "budget_exhausted"


def test_ctrl_c_ends_a_million_rows():
    rows = np.random.default_rng(1).uniform(-1, 1, (1_000_000, 2))
    found = mw.evaluate("planar/force", rows, threads=1, callback=press(1))
    left = np.array(found.status) == "budget_exhausted"
    assert left.any() and not left.all() and np.isnan(found.beta[left]).all()


def uncertain():
    push = mw.load("fixed/push")
    task = mw.Static(push.robot, uncertainty={"torque": 0.1})
    return mw.evaluate(task, task.theta_r_default)


def program(rows):
    rng = np.random.default_rng(1)
    A, c = rng.normal(size=(rows, 3 * rows)), rng.normal(size=3 * rows)
    return c, A, A @ rng.uniform(0, 1, 3 * rows), np.zeros(3 * rows), np.full(3 * rows, 2.0)


def table(rows):
    t = np.linspace(0, 100, rows)
    return {"t": t, "shoulder": -0.8 + 0.1 * np.sin(t), "elbow": 1 + 0.1 * np.cos(t)}


def again(function, *arguments, **options):
    """Calls a short function until the user ends it."""
    while True:
        function(*arguments, **options)


@pytest.fixture(scope="module")
def certificates(tmp_path_factory):
    folder = tmp_path_factory.mktemp("proofs")
    mw.certify("planar/force", gap=1e-6).save(folder / "force.proof")
    turn = mw.load("uvms/valve_trajectory")
    mw.certify(turn, budget=500).save(folder / "turn.proof")
    return folder


ALL_OR_NOTHING = {
    "sample": lambda folder: lambda a=uncertain(): a.sample(10_000_000),
    "linprog": lambda folder: lambda p=program(2000): mw.linprog(*p),
    "margin": lambda folder: lambda t=table(200_000): again(mw.margin, "planar/force", t, ball=["fx", "fy"]),
    "verify": lambda folder: lambda: again(mw.verify, folder / "force.proof"),
    "verify in time": lambda folder: lambda: again(mw.verify, folder / "turn.proof"),
    "polytope": lambda folder: lambda: again(mw.polytope, "uvms/valve", mw.load("uvms/valve").theta_r_default, wrench="any"),
    "ellipsoid": lambda folder: lambda: again(mw.ellipsoid, "uvms/valve", mw.load("uvms/valve").theta_r_default),
    "explain": lambda folder: lambda a=mw.evaluate("planar/trajectory", [0, 0]): again(a.explain),
    "scenarios": lambda folder: lambda a=uncertain(): again(a.scenarios),
    "evaluate": lambda folder: lambda: again(mw.evaluate, "planar/force", [0, 0]),
    "evaluate in time": lambda folder: lambda: again(mw.evaluate, "planar/trajectory", [0, 0]),
    "scale": lambda folder: lambda: again(mw.scale, [[1, 1]], [-1, -1], [1, 1], [0], [4]),
    "load": lambda folder: lambda: again(mw.load, "gallery/ur10/lift"),
}


@pytest.mark.parametrize("name", ALL_OR_NOTHING)
def test_ctrl_c_is_a_keyboard_interrupt_where_there_is_no_best_so_far(name, certificates):
    call = ALL_OR_NOTHING[name](certificates)
    Interrupt(0.2)
    with pytest.raises(KeyboardInterrupt):
        call()
    assert mw.evaluate("planar/force", [0, 0]).has_value  # nothing is left behind


def test_another_handler_ends_what_has_no_best_so_far():
    class Alarm(Exception):
        pass

    def ring(signum, frame):
        raise Alarm

    before = signal.signal(signal.SIGALRM, ring)
    answer = uncertain()
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.2)
        with pytest.raises(Alarm):
            answer.sample(10_000_000)
    finally:
        signal.signal(signal.SIGALRM, before)


def test_a_handler_that_returns_ends_nothing():
    calls = []
    before = signal.signal(signal.SIGALRM, lambda *_: calls.append(1))
    answer = uncertain()
    whole = answer.sample(20_000)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.03, 0.01)
        while not calls:
            assert answer.sample(20_000) == whole
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
