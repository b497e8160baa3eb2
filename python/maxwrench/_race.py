"""Races of searches on tasks, with equal budgets and seeds."""

import itertools

import numpy as np

from . import _core


def race(tasks, searches, *, seeds=5, budget=2000, measure="linf_polytope", wrench="pure", threads=0):
    """Solves each task with each search and each seed, at equal budgets.

    Args:
        tasks: a Task, the name of one, or a list of them.
        searches: the name of a search or a list of names, of the package or added by ``add_search``.
        seeds: number of seeds, 1 to ``seeds``.
        budget: largest number of evaluations of each run.
        measure, wrench, threads: as of ``solve``.

    Returns:
        dict: arrays with one entry for each run: task, search, seed, beta, gap, evaluations,
        seconds, status. gap is how far beta is below the best of all runs of the task, as a
        share of that; NaN without a value. ``pandas.DataFrame(...)`` makes a table of it.
        Ctrl-C ends the race: the runs that were complete are returned.

    Raises:
        InputError: as ``solve``.

    >>> runs = maxwrench.race(["planar/force"], ["sample", "cmaes"], seeds=2, budget=200)
    >>> runs["beta"].shape
    (4,)
    """
    columns = {name: [] for name in ("task", "search", "seed", "beta", "evaluations", "seconds", "status")}
    searches = [searches] if isinstance(searches, str) else searches
    tasks = [tasks] if isinstance(tasks, (str, _core.Task)) else tasks
    loaded = [task if isinstance(task, _core.Task) else _core.load(task) for task in tasks]
    try:
        for task, search, seed in itertools.product(loaded, searches, range(1, seeds + 1)):
            answer = _core.solve(
                task, measure=measure, wrench=wrench, search=search, seed=seed, budget=budget, threads=threads
            )
            if answer.stopped == "interrupted":
                break
            run = (task.name, search, seed, answer.beta, answer.evaluations, answer.seconds, answer.status)
            for column, value in zip(columns.values(), run):
                column.append(value)
    except KeyboardInterrupt:  # between two runs
        columns = {name: column[: len(columns["status"])] for name, column in columns.items()}
    runs = {name: np.array(column) for name, column in columns.items()}
    runs["gap"] = np.full(len(runs["beta"]), np.nan)
    for name in dict.fromkeys(columns["task"]):
        of_task = runs["task"] == name
        best = np.nanmax(runs["beta"][of_task], initial=-np.inf)
        if np.isfinite(best):
            runs["gap"][of_task] = (best - runs["beta"][of_task]) / abs(best)
    return runs
