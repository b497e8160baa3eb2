"""Arrays and pictures of maps."""

import numpy as np

from ._errors import bad_value


def best_of(found):
    """The cell with the largest value: a dict of its coordinates, ``beta``, ``theta_r`` and ``q``; None: no value."""
    if not np.isfinite(found.beta).any():
        return None
    i = int(np.nanargmax(found.beta))
    return {
        **dict(zip(found.over, found.at[i])),
        "beta": found.beta[i],
        "theta_r": found.theta_r[i],
        "q": found.q[i],
    }


def grid_of(found):
    """The values at the places of the grid, without those between them: an axis for each coordinate. NaN: none."""
    counts = [count for _, _, count in found.over.values()]
    values = np.full(counts, np.nan)
    for index, level, beta in zip(found.index.astype(int), found.level, found.beta):
        if level <= 2:  # the grid is complete in level 2
            place = [i if name == "wrench" else i >> found.refine for i, name in zip(index, found.over)]
            values[tuple(place)] = beta
    return values


def plot_map(found, ax=None):
    """Draws a map with Matplotlib.

    One coordinate gives a curve, or a rose of an azimuth; two give a heat map, three give points in space.

    Args:
        found: a Map.
        ax: where to draw: axes, with ``projection="polar"`` for an azimuth alone and ``projection="3d"`` for three
            coordinates. None: a new figure.

    Returns:
        matplotlib.axes.Axes: the axes.

    Raises:
        InputError: the map has more than three coordinates or no value.
        ImportError: Matplotlib is not installed.

    >>> axes = maxwrench.map("planar/force", {"azimuth": (0, 6, 5)}, budget=50).plot()
    >>> axes.figure.savefig("rose.png")  # doctest: +SKIP
    """
    try:
        import matplotlib.pyplot as plt
    except ImportError:
        raise ImportError("plot needs Matplotlib, which is not installed") from None
    names = list(found.over)
    if len(names) > 3:
        raise bad_value("over", f"{len(names)} coordinates", "at most 3 for a picture")
    if not np.isfinite(found.beta).any():
        raise bad_value("map", "no value", "a map with values")
    rose = names == ["azimuth"]
    if ax is None:
        projection = "polar" if rose else "3d" if len(names) == 3 else None
        ax = plt.figure().add_subplot(projection=projection)
    labels = [f"{name} [{'m' if len(name) == 1 else 'rad'}]" if name != "wrench" else name for name in names]
    at, beta = found.at, found.beta
    if rose:
        ax.plot(at[:, 0], np.fmax(beta, 0), marker=".")
    elif len(names) == 1:
        ax.plot(at[:, 0], beta, marker=".")
        ax.set(xlabel=labels[0], ylabel=f"beta [{found.unit}]")
    elif len(names) == 2:
        lows, highs = zip(*[(low, high) for low, high, _ in found.over.values()])
        counts = found.grid.shape
        halves = [(high - low) / max(count - 1, 1) / 2 for low, high, count in zip(lows, highs, counts)]
        extent = [lows[0] - halves[0], highs[0] + halves[0], lows[1] - halves[1], highs[1] + halves[1]]
        if not all(half > 0 for half in halves):
            raise bad_value("over", "a coordinate with one value", "several values of both for a picture")
        image = ax.imshow(found.grid.T, origin="lower", extent=extent, aspect="auto")
        ax.figure.colorbar(image, ax=ax, label=f"beta [{found.unit}]")
        ax.set(xlabel=labels[0], ylabel=labels[1])
    else:
        has = np.isfinite(beta)
        points = ax.scatter(*at[has].T, c=beta[has])
        ax.figure.colorbar(points, ax=ax, label=f"beta [{found.unit}]", pad=0.15)
        ax.set(xlabel=labels[0], ylabel=labels[1], zlabel=labels[2])
    ax.set_title(found.task.name)
    return ax
