"""What results/ has of a measure, a solver or a search, as a section at the end of its page; nothing where it has none."""

import maxwrench as mw
import results

STAGES = ["facet_sqp+cmaes", "crs2+cmaes", "crs2+pagmo_cmaes", "de+cmaes", "sample+slsqp+cmaes"]
SEEDS = range(1, 21)


def section(title, text, head, rows):
    if not rows:
        return ""
    lines = [" | ".join(map(str, line)) for line in [head, ["---"] * len(head), *rows]]
    return "\n".join([f"\n## {title}", "", text, "", *(f"| {line} |" for line in lines), ""])


def digits(value):
    return f"{float(value):.3g}" if value not in ("", None) else "-"


def measure(name):
    rows = [[f"`{task}`", *map(digits, times)] for task, times in results.times(name).items()]
    return section("Time of an evaluation", "The wall time of an evaluation [µs] of static tasks by the fastest solver, in the [benchmark's](../../benchmarks.md) "
                   "run of `grid` on the machine of [results/machine.txt](../../../results/machine.txt).", ["task", "pure", "any wrench"], rows)


def solver(name):
    rows = [[row["benchmark_set"], f"{row['solved']} of {row['instances']}", digits(row["us"]), digits(row["times"] or 1), f"`{row['reference']}`"]
            for row in results.table("solvers") if row["solver"] == name]
    return section("In the benchmark", "*Solved* are the cases with a value; a case that the solver does not support has none. *Time* is the median processor "
                   "time of an evaluation [µs], where a case without a value counts as infinite. *Times* is the median ratio to that of the reference, case by case "
                   "([benchmarks](../../benchmarks.md#reports)).", ["cases", "solved", "time", "times", "reference"], rows)


def search(name):
    row = results.standing(name)
    if row is None:
        return ""
    shares = [f"{100 * float(row[f'reached_{part}']):.0f}" for part in ["tenth", "hundredth", "thousandth", "ten_thousandth"]]
    return section("In the comparison of all static tasks", "*Typical* and *worst* compare the expected time to 0.1 % below the best with that of the best "
                   "search of each task. The other columns are the share of tasks and seeds [%] that came that near "
                   "([benchmarks](../../benchmarks.md#the-searches)).", ["tasks", "typical", "worst", "10 %", "1 %", "0.1 %", "0.01 %"],
                   [[row["supported"], digits(row["typical"]), digits(row["worst"]), *shares]])


def stages():
    """How often stages reach the best value, computed now."""
    def reached(task, search):
        values = [mw.solve(task, search=search, seed=seed, budget=20000, callback=False).beta for seed in SEEDS]
        return sum(value >= 0.999 * results.best(task) for value in values)

    tasks = ["uvms/valve", "uvms/lift"]
    rows = [[f"`{search}`", *(reached(task, search) for task in tasks)] for search in STAGES]
    return section("Stages compared", f"How many of {len(SEEDS)} seeds come within 0.1 % of the best known value in 20,000 evaluations.",
                   ["search", *(f"`{task}`" for task in tasks)], rows)


SECTIONS = {"measures": measure, "solvers": solver, "searches": search}
