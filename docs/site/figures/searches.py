"""A figure for each search: which postures of planar/force it evaluates, and how it approaches the best value of uvms/valve."""

import functools
import pathlib

import numpy as np

import maxwrench as mw
import results
from figures.style import BLUE, GREY, TASK, landscape, save, two_panels

BUDGETS = [20, 40, 80, 160, 320, 640, 1280, 2560]
SEEDS = range(1, 4)
SHORTFALL = 1e-6  # what counts as none
ROOT = pathlib.Path(__file__).resolve().parents[3]
TURNS = ["planar/trajectory", "mobile/trajectory"]
TRANSFER = str(ROOT / "examples/tasks/two_link/luus.toml")
LONG = 1000  # evaluations that a search for tasks in time alone may make


class Recorded(mw.Measure):
    """beta_2, with a list of the postures at which it was asked for."""

    name = "recorded"

    def __init__(self):
        self.postures = []

    def answer(self, posture):
        return mw.capability(posture.J, posture.tau_d, posture.u_min, posture.u_max, posture.c, posture.B)

    def value(self, posture):
        self.postures.append(posture.theta_r)
        return float(self.answer(posture).beta)

    def derivatives(self, posture):
        answer = self.answer(posture)
        return answer.lambda_, np.outer(answer.h, answer.lambda_)


def visited(search, budget=1000):
    """The postures of planar/force that a search evaluates, in order; None if it evaluates no measure of others."""
    recorded = Recorded()
    mw.add_measure(recorded)
    try:
        mw.solve(TASK, measure="recorded", search=search, budget=budget, threads=1, callback=False)
    except mw.InputError:
        return None
    return np.array(recorded.postures)


@functools.cache  # `sample` stands in each figure
def values_found(search):
    """The value with which each run ends: seeds × budgets."""
    runs = [[mw.solve("uvms/valve", search=search, seed=seed, budget=budget, threads=1, callback=False).beta for budget in BUDGETS]
            for seed in SEEDS]
    return np.array(runs, dtype=float)


def draw_facets(axes, n=81):
    """The regions of planar/force in which one facet pair limits the force: the multipliers are its normal."""
    side = [np.linspace(low, high, n) for low, high in zip(TASK.theta_r_min, TASK.theta_r_max)]
    values, regions, known = np.full((n, n), np.nan), np.full((n, n), np.nan), {}
    for row, column in np.ndindex(n, n):
        answer = mw.evaluate(TASK, [side[0][column], side[1][row]])
        if answer.has_value:
            values[row, column] = answer.beta
            normal = tuple(np.round(answer.lambda_ / np.abs(answer.lambda_).max(), 6) + 0.0)
            regions[row, column] = known.setdefault(normal, len(known))
    axes.pcolormesh(*side, regions, cmap="Set3", shading="nearest", rasterized=True)
    axes.contour(*side, values, levels=12, colors="black", linewidths=0.5)
    best = mw.solve(TASK, callback=False)
    axes.plot(*best.theta_r, "*", ms=12, mfc="white", mec="black", clip_on=False, zorder=5)
    axes.set(xlabel="first joint [rad]", ylabel="second joint [rad]")
    axes.set_title("colour: the facet that limits the force; star: the best", fontsize=9)


def supports(search, task):
    try:
        mw.solve(task, search=search, budget=1, callback=False)
    except mw.InputError:
        return False
    return True


@functools.cache
def solved(search, name, budget):
    return mw.solve(mw.load(name), search=search, budget=budget, callback=False)


def draw_knots(axes, search, name="planar/trajectory", budget=300):
    """The knots of a task in time, as they are by default and as the search leaves them."""
    task = mw.load(name)
    fixed = mw.evaluate(task, task.theta_r_default)
    found = solved(search, name, budget)
    for answer, colour, label in [(fixed, GREY, "default"), (found, BLUE, search)]:
        knots = np.broadcast_to(answer.theta_r, (task.knots, len(task.theta_r_names)))
        times = np.linspace(answer.t[0], answer.t[-1], len(knots))
        for joint, style in zip(knots.T, ["o-", "o--"]):
            axes.plot(times, joint, style, ms=3, color=colour)
        axes.plot([], [], color=colour, label=f"{label}: {answer.beta:.2f} {answer.unit} throughout")
    axes.set(xlabel="time [s]", ylabel="joints at the knots [rad]")
    axes.set_title(f"{name} (first joint solid, second dashed)", fontsize=9)
    axes.legend(frameon=False)


def draw_transfer(left, right, search):
    """Joints and efforts of a transfer over time."""
    found = solved(search, TRANSFER, LONG)
    for axes, curves, what in ((left, found.theta[:, -2:], "joints [rad]"), (right, found.u, "efforts [N m]")):
        for curve, style in zip(np.transpose(curves), ["-", "--"]):
            axes.plot(found.t, curve, style, color=BLUE)
        axes.set(xlabel="time [s]", ylabel=what)
    left.set_title(f"luus: {found.beta:.3f} {found.unit} (first joint solid, second dashed)", fontsize=9)
    right.set_title("its efforts", fontsize=9)


def draw(search, path):
    figure, (left, right) = two_panels()
    if not supports(search, "uvms/valve"):
        if supports(search, TURNS[0]):
            for axes, task in zip((left, right), TURNS):
                draw_knots(axes, search, task, LONG)
        else:
            draw_transfer(left, right, search)
        save(figure, path)
        return
    postures = visited(search)
    if postures is not None:
        landscape(left, bar=False)
        shown = left.scatter(*postures.T, c=np.arange(len(postures)), cmap="autumn_r", s=5, lw=0)
        figure.colorbar(shown, ax=left, label="evaluation")
        left.set_title("the postures of planar/force that it evaluates", fontsize=9)
    elif "facet" in search:
        draw_facets(left)
    else:
        draw_knots(left, search)
    best = results.best("uvms/valve")
    for name, colour in [("sample", GREY), (search, BLUE)]:
        short = np.maximum(np.nan_to_num(1 - values_found(name) / best, nan=1), SHORTFALL)
        right.loglog(BUDGETS, np.median(short, axis=0), "o-", ms=3, color=colour, label=name)
        right.fill_between(BUDGETS, np.min(short, axis=0), np.max(short, axis=0), color=colour, alpha=0.2, lw=0)
    right.set(xlabel="budget [evaluations]", ylabel="share below the best known value")
    right.set_title("uvms/valve: median and range of three seeds", fontsize=9)
    right.legend(frameon=False)
    save(figure, path)
