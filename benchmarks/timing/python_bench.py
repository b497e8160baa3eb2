#!/usr/bin/env python3
"""Times the Python package beside the library and beside NumPy with SciPy's HiGHS.

usage: PYTHONPATH=build/python benchmarks/timing/python_bench.py [EVAL_BENCH]

EVAL_BENCH is build/eval_bench, which times the same call in C++ in the same run.
"""

import re
import subprocess
import sys
import time

import maxwrench as mw
import numpy as np
from scipy.optimize import linprog

TASK = mw.load("uvms/valve")
RANDOM = np.random.default_rng(1)
ROWS = RANDOM.uniform(TASK.theta_r_min, TASK.theta_r_max, (100_000, len(TASK.theta_r_min)))


def fastest(function, count, repeats=5):
    """The least mean time of a call [s]."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        for i in range(count):
            function(i)
        times.append((time.perf_counter() - start) / count)
    return min(times)


def in_cpp(program):
    """The least CPU time of the call in C++ [s], from the table that the program prints."""
    words = [program, "--benchmark_filter=^uvms/valve/evaluate$", "--benchmark_repetitions=5"]
    table = subprocess.run(words, capture_output=True, text=True, check=True).stdout
    table = re.sub("\x1b\\[[0-9;]*m", "", table)  # colours
    return min(map(int, re.findall(r"^uvms/valve/evaluate +(\d+) ns", table, re.MULTILINE))) * 1e-9


def by_highs(answer):
    """The same program by SciPy: max x with B u - J'c x = tau_d."""
    robot = TASK.robot
    a = np.column_stack([robot.B, -answer.J.T @ TASK.c])
    bounds = [*zip(robot.u_min, robot.u_max), (None, None)]
    objective = np.zeros(a.shape[1])
    objective[-1] = -1
    return linprog(objective, A_eq=a, b_eq=answer.tau_d, bounds=bounds, method="highs")


def main():
    rows = ROWS[mw.evaluate(TASK, ROWS[:1000]).valid.nonzero()[0]]
    one = fastest(lambda i: mw.evaluate(TASK, rows[i % len(rows)]), 2000)
    print(f"one posture           {1e6 * one:8.2f} us")
    if len(sys.argv) > 1:
        cpp = in_cpp(sys.argv[1])
        print(f"  the same in C++     {1e6 * cpp:8.2f} us on postures of which some are invalid")
        mixed = fastest(lambda i: mw.evaluate(TASK, ROWS[i % 1000]), 2000)
        print(f"  here on such        {1e6 * mixed:8.2f} us, {1e6 * (mixed - cpp):.2f} us more")
    times = [fastest(lambda i, n=n: mw.evaluate(TASK, ROWS, threads=n), 1, 5) for n in (1, 2)]
    print(f"100,000 postures      {times[0]:8.3f} s on one core, {times[1]:.3f} s on two: {times[0] / times[1]:.2f} times")
    answer = mw.evaluate(TASK, rows[0])
    limits = TASK.robot.u_min, TASK.robot.u_max
    ours = fastest(lambda i: mw.capability(answer.J, answer.tau_d, *limits, TASK.c, TASK.robot.B), 2000)
    theirs = fastest(lambda i: by_highs(answer), 50)
    assert abs(-by_highs(answer).fun - answer.beta) < 1e-8 * abs(answer.beta)
    print(f"capability of arrays  {1e6 * ours:8.2f} us, SciPy's HiGHS {1e6 * theirs:.0f} us: {theirs / ours:.0f} times")
    zeros, wish = np.zeros(len(answer.tau_d)), np.eye(len(answer.tau_d))[0]
    scale = fastest(lambda i: mw.scale(TASK.robot.B, *limits, zeros, wish), 2000)
    print(f"scale                 {1e6 * scale:8.2f} us")


if __name__ == "__main__":
    main()
