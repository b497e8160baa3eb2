"""Postures that are good for every model, beside those that are good for the nominal one.

python3 robust_postures.py [TASK ...] [--draws N] [--seeds N] [--budget N] [--out FOLDER]

Each TASK has uncertain data. The first posture is the best for the worst model, the second one the best for the nominal
model. Both are evaluated with the nominal model, with the worst one, and with models that are drawn at random.
"""

import argparse
import pathlib

import matplotlib
import maxwrench as mw
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

matplotlib.rcParams["svg.hashsalt"] = "maxwrench"  # the same file each time
TASKS = pathlib.Path(__file__).parents[1] / "tasks"
SAMPLE_SEED = 1


def best(task, seeds, budget):
    """The best answer of searches from several seeds."""
    return max((mw.solve(task, seed=seed, budget=budget) for seed in range(1, seeds + 1)), key=lambda answer: answer.beta)


def rows_of(task, options):
    """The name of each posture, its numbers, and the drawn values."""
    nominal = mw.nominal(task)
    robust = best(task, options.seeds, options.budget)
    for name, posture in (("robust", robust), ("nominal", best(nominal, options.seeds, options.budget))):
        worst = mw.evaluate(task, posture.theta_r)
        drawn = worst.sample(options.draws, seed=SAMPLE_SEED, guaranteed=robust.beta)
        yield name, posture.theta_r, mw.evaluate(nominal, posture.theta_r).beta, worst.beta, drawn


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("tasks", nargs="*", default=[str(TASKS / f"{name}_guaranteed.toml") for name in ("turn", "lift")])
    parser.add_argument("--draws", type=int, default=10000)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--budget", type=int, default=0, help="evaluations of each search; 0: until another optimum is unlikely")
    parser.add_argument("--out", default=".")
    options = parser.parse_args()

    lines = []
    figure, axes = plt.subplots(1, len(options.tasks), figsize=(4.2 * len(options.tasks), 3.2), constrained_layout=True, squeeze=False)
    for path, ax in zip(options.tasks, axes[0]):
        task, name = mw.load(path), pathlib.Path(path).stem
        guaranteed = None
        for posture, theta_r, nominal, worst, drawn in rows_of(task, options):
            guaranteed = drawn["guaranteed"]
            print(
                f"{name}, {posture:<8}  {nominal:9.4f}  {worst:9.4f}  {drawn['below']:6d}  {drawn['least']:9.4f}  "
                f"{drawn['median']:9.4f}  {drawn['unit']}"
            )
            numbers = [nominal, worst, drawn["drawn"], SAMPLE_SEED, guaranteed, drawn["below"], drawn["infeasible"]]
            numbers += [drawn["least"], drawn["q01"], drawn["q05"], drawn["median"]]
            theta = " ".join(f"{x:.17g}" for x in theta_r)
            lines.append(",".join([name, posture, theta, *(f"{x:.6g}" for x in numbers), drawn["unit"]]))
            values = np.quantile(drawn["values"], np.linspace(0, 1, 201))
            ax.plot(values, np.linspace(0, 100, 201), label=f"{posture} posture")
        ax.axvline(guaranteed, color="#555555", linestyle="--", linewidth=1, label="guaranteed")
        ax.set(xlabel=f"largest wrench of a drawn model [{drawn['unit']}]", ylabel="models with less [%]", title=name.replace("_", " "))
        ax.grid(alpha=0.3)
        ax.legend(fontsize=8)

    out = pathlib.Path(options.out)
    head = "task,posture,theta_r,nominal,worst,drawn,seed,guaranteed,below,infeasible,least,q01,q05,median,unit"
    (out / "robust_postures.csv").write_text("\n".join([head, *lines]) + "\n")
    figure.savefig(out / "robust_postures.svg", metadata={"Date": None})
    print("written:", out / "robust_postures.csv", out / "robust_postures.svg")


if __name__ == "__main__":
    main()
