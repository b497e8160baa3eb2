"""SciPy's global searches against ours on a static task, with the same number of evaluations.

python3 race_scipy.py [TASK] [--budget N] [--seeds N]

All maximise the same beta over theta_r; facet_sqp knows the facets of what the actuators reach, too.
"""

import argparse
import time

import maxwrench as mw
import numpy as np
from scipy.optimize import differential_evolution, dual_annealing


def beta(task, theta_r):
    """Values of postures in rows, or of one; 0 where there is none."""
    return np.nan_to_num(mw.evaluate(task, theta_r).beta, nan=0.0)


def by_de(task, bounds, budget, seed):
    r, people = len(bounds), 15
    rounds = max(1, budget // (people * r) - 1)  # beside the first population
    options = {"popsize": people, "maxiter": rounds, "tol": 0, "polish": False, "updating": "deferred"}
    return -differential_evolution(lambda x: -beta(task, x.T), bounds, seed=seed, vectorized=True, **options).fun


def by_annealing(task, bounds, budget, seed):
    return -dual_annealing(lambda x: -beta(task, x), bounds, maxfun=budget, maxiter=budget, seed=seed).fun


def ours(search):
    return lambda task, bounds, budget, seed: mw.solve(task, search=search, budget=budget, seed=seed).beta


SEARCHES = {
    "SciPy differential_evolution": by_de,
    "SciPy dual_annealing": by_annealing,
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
    print(f"{task.name} [{task.unit}], {options.budget} evaluations, {options.seeds} seeds\n{'':30}   worst  median    best  s each")
    for name, search in SEARCHES.items():
        start = time.perf_counter()
        found = [search(task, bounds, options.budget, seed) for seed in range(1, options.seeds + 1)]
        each = (time.perf_counter() - start) / options.seeds
        print(f"{name:<30} {min(found):7.3f} {np.median(found):7.3f} {max(found):7.3f} {each:7.2f}")


if __name__ == "__main__":
    main()
