"""A figure for each search: which postures of planar/force it evaluates, and how it approaches the best value of uvms/valve."""

import numpy as np

import maxwrench as mw
import results
from figures.style import BLUE, GREY, TASK, landscape, save, two_panels

BUDGETS = [20, 40, 80, 160, 320, 640, 1280, 2560]
SEEDS = range(1, 6)
SHORTFALL = 1e-6  # what counts as none


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


def shortfalls(search):
    """How far below the best value each run ends: seeds × budgets, as shares of it."""
    runs = [[mw.solve("uvms/valve", search=search, seed=seed, budget=budget, threads=1, callback=False).beta for budget in BUDGETS]
            for seed in SEEDS]
    return np.array(runs, dtype=float)


def draw_facets(axes):
    """The regions of planar/force in which one facet pair limits the force."""
    n = 241
    side = [np.linspace(low, high, n) for low, high in zip(TASK.theta_r_min, TASK.theta_r_max)]
    grid = np.stack(np.meshgrid(*side), axis=-1).reshape(-1, 2)
    found = mw.evaluate(TASK, grid, callback=False)
    normals = np.round(found.lambda_ / np.abs(found.lambda_).max(axis=1, keepdims=True), 6)
    known = found.valid
    _, region = np.unique(normals[known], axis=0, return_inverse=True)
    shown = np.full(len(grid), np.nan)
    shown[known] = region.ravel() % 20
    axes.pcolormesh(*side, shown.reshape(n, n), cmap="tab20", shading="nearest", alpha=0.5, rasterized=True)
    axes.contour(*side, found.beta.reshape(n, n), levels=12, colors="black", linewidths=0.5)
    best = mw.solve(TASK, callback=False)
    axes.plot(*best.theta_r, "*", ms=12, mfc="white", mec="black", clip_on=False, zorder=5)
    axes.set(xlabel="first joint [rad]", ylabel="second joint [rad]")
    axes.set_title("facet that limits the force (colour); star: the best", fontsize=9)


def draw_instants(axes, search):
    """The wrench at each instant of planar/trajectory: a constant posture, and what the search finds."""
    task = mw.load("planar/trajectory")
    fixed = mw.evaluate(task, task.theta_r_default)
    found = mw.solve(task, search=search, budget=300, callback=False)
    for answer, colour, name in [(fixed, GREY, "default posture throughout"), (found, BLUE, search)]:
        axes.plot(answer.t, answer.betas, color=colour, label=name)
        axes.axhline(answer.beta, color=colour, lw=0.7, ls="--")
    axes.set(xlabel="time [s]", ylabel="largest force along c [N]", ylim=(0, None))
    axes.set_title("planar/trajectory: each instant, and the least", fontsize=9)
    axes.legend(frameon=False)


def draw(search, path):
    figure, (left, right) = two_panels()
    postures = visited(search)
    if postures is not None:
        landscape(left)
        shown = left.scatter(*postures.T, c=np.arange(len(postures)), cmap="autumn_r", s=5, lw=0)
        figure.colorbar(shown, ax=left, label="evaluation")
        left.set_title("the postures of planar/force that it evaluates", fontsize=9)
    elif "facet" in search:
        draw_facets(left)
    else:
        draw_instants(left, search)
    best = results.best("uvms/valve")
    for name, colour in [("sample", GREY), (search, BLUE)]:
        short = np.maximum(1 - shortfalls(name) / best, SHORTFALL)
        right.loglog(BUDGETS, np.nanmedian(short, axis=0), "o-", ms=3, color=colour, label=name)
        right.fill_between(BUDGETS, np.nanmin(short, axis=0), np.nanmax(short, axis=0), color=colour, alpha=0.2, lw=0)
    right.set(xlabel="budget [evaluations]", ylabel="share below the best known value")
    right.set_title("uvms/valve: median and range of five seeds", fontsize=9)
    right.legend(frameon=False)
    save(figure, path)
