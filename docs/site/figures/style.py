"""The look of the explaining figures, and the task of two coordinates on which they show things."""

import matplotlib
import numpy as np

import maxwrench as mw

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

plt.rcParams.update({
    "font.family": "DejaVu Sans", "font.size": 9, "axes.spines.top": False, "axes.spines.right": False, "figure.constrained_layout.use": True,
    "svg.fonttype": "path", "svg.hashsalt": "maxwrench",
})
BLUE, ORANGE, GREY, GREEN = "#2166ac", "#d6604d", "#8a8a8a", "#1b7837"
TASK = mw.load("planar/force")


def two_panels():
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.6))
    return figure, axes


def save(figure, path):
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)


def landscape(axes, measure="linf_polytope", bar=True, n=121):
    """Draws the value of a measure over both coordinates, with its best posture on this grid."""
    side = [np.linspace(low, high, n) for low, high in zip(TASK.theta_r_min, TASK.theta_r_max)]
    grid = np.stack(np.meshgrid(*side), axis=-1)
    values = mw.evaluate(TASK, grid.reshape(-1, 2), measure=measure, callback=False).beta.reshape(n, n)
    shown = axes.pcolormesh(*side, values, cmap="viridis", shading="nearest", rasterized=True)
    if bar:
        axes.figure.colorbar(shown, ax=axes, label="value")
    axes.set(xlabel="first joint [rad]", ylabel="second joint [rad]")
    best = grid.reshape(-1, 2)[np.nanargmax(values)]
    return best, np.nanmax(values)
