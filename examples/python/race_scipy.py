"""SciPy's global searches against ours on a static task, with the same number of evaluations at most.

python3 race_scipy.py [TASK] [--budget N] [--seeds N]

All maximise the same beta over theta_r; facet_sqp knows the facets of what the actuators reach, too.
"""

import argparse
import contextlib
import time

import maxwrench as mw
import numpy as np
from scipy.optimize import differential_evolution, dual_annealing


class Spent(Exception):
    """The evaluations are used up."""


class Counted:
    """Minus beta at theta_r, one posture or several as columns, for methods that minimise. It counts, and ends them."""

    def __init__(self, task, budget):
        self.task, self.left, self.best = task, budget, -np.inf

    def __call__(self, theta_r):
        rows = np.atleast_2d(theta_r.T)
        values = mw.evaluate(self.task, rows[: self.left]).beta
        self.left -= len(values)
        self.best = max(self.best, np.nanmax(values, initial=-np.inf))
        if len(values) < len(rows):
            raise Spent
        worse = -np.nan_to_num(values, nan=-1e9)  # no value; a finite number, because dual_annealing wants one
        return worse if theta_r.ndim == 2 else worse[0]


def scipy_search(minimise):
    """A search that runs a method of SciPy until it has used its evaluations."""

    def search(task, bounds, budget, seed):
        function = Counted(task, budget)
        with contextlib.suppress(Spent):
            minimise(function, bounds, seed)
        return function.best, budget - function.left

    return search


def by_de(function, bounds, seed):
    endless = {"maxiter": 10**6, "tol": 0, "polish": False}
    differential_evolution(function, bounds, seed=seed, vectorized=True, updating="deferred", **endless)


def by_annealing(function, bounds, seed):
    dual_annealing(function, bounds, maxiter=10**6, seed=seed)


def ours(name):
    def search(task, bounds, budget, seed):
        answer = mw.solve(task, search=name, budget=budget, seed=seed)
        return answer.beta if answer.has_value else -np.inf, answer.evaluations

    return search


SEARCHES = {
    "SciPy differential_evolution": scipy_search(by_de),
    "SciPy dual_annealing": scipy_search(by_annealing),
    **{f"ours {name}": ours(name) for name in ("facet_sqp+cmaes", "cmaes", "de", "annealing+cmaes")},
}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("task", nargs="?", default="uvms/valve")
    parser.add_argument("--budget", type=int, default=10000)
    parser.add_argument("--seeds", type=int, default=5)
    options = parser.parse_args()
    task = mw.load(options.task)
    bounds = list(zip(task.theta_r_min, task.theta_r_max))
    print(f"{task.name} [{task.unit}], {options.budget} evaluations, {options.seeds} seeds\n{'':30}   worst  median    best  s each  evaluations")
    for name, search in SEARCHES.items():
        start = time.perf_counter()
        runs = [search(task, bounds, options.budget, seed) for seed in range(1, options.seeds + 1)]
        each = (time.perf_counter() - start) / options.seeds
        found, used = zip(*runs)
        print(f"{name:<30} {min(found):7.3f} {np.median(found):7.3f} {max(found):7.3f} {each:7.2f} {max(used):12}")


if __name__ == "__main__":
    main()
