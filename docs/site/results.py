"""The tables of results/, as lists of rows."""

import csv
import functools
import gzip
import pathlib

RESULTS = pathlib.Path(__file__).resolve().parents[2] / "results"


@functools.cache
def table(name):
    with open(RESULTS / "report" / f"{name}.csv", newline="") as file:
        return list(csv.DictReader(file))


def best(task, measure="linf_polytope", wrench="pure"):
    """The best value of a task that any search found; None without one."""
    values = [float(row["best"]) for row in table("tasks")
              if (row["problem"], row["measure"], row["wrench"]) == (task, measure, wrench) and row["best"]]
    return max(values, default=None)


def standing(search):
    """How a search did in the comparison of all static tasks; None where it did not take part."""
    return next((row for row in table("race_standings") if row["group"] == "all static tasks" and row["search"] == search), None)


def costs(problem, scheme, wrench):
    """The median time of an evaluation by solver [us]."""
    rows = [row for row in table("costs") if (row["problem"], row["scheme"], row["wrench"]) == (problem, scheme, wrench)]
    return {row["solver"]: float(row["us"]) for row in rows if row["solver"] != "none"}


@functools.cache
def times(measure):
    """The time of an evaluation of each static task [us], with a pure wrench and with any, by `grid` and the fastest solver; None without one."""
    found = {}
    with gzip.open(RESULTS / "times.csv.gz", "rt", newline="") as file:
        for row in csv.DictReader(file):
            if (row["measure"], row["search"], row["scheme"]) == (measure, "grid", ""):
                found.setdefault(row["problem"], {}).setdefault(row["wrench"], []).append(float(row["us_per_evaluation"]))
    return {task: [min(by_wrench.get(wrench, []), default=None) for wrench in ["pure", "any"]] for task, by_wrench in found.items()}
