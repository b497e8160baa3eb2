"""Pictures of answers by Matplotlib."""

import numpy as np

from . import _core
from ._errors import bad_value

# Okabe and Ito's colours, which colour-blind readers tell apart.
BLACK, ORANGE, SKY, GREEN, BLUE, VERMILION, PURPLE = (
    "#000000", "#E69F00", "#56B4E9", "#009E73", "#0072B2", "#D55E00", "#CC79A7")  # fmt: skip
CURVES = (BLUE, ORANGE, GREEN, VERMILION, PURPLE, SKY, BLACK)
STYLES = ("-", "--", ":")
WRENCH = (VERMILION, BLUE)  # force and torque
SETS = {"force": GREEN, "torque": PURPLE}


def plot_answer(answer, ax=None):
    """Draws an answer with Matplotlib.

    A static answer is a robot in three dimensions: its bodies, its skeleton from joint to joint, and
    the force and the torque that it exerts within the sets of all that it can exert, or their
    direction if there is no value. An answer in time is three panels over time: beta, theta_r, and
    the efforts as shares of their limits.

    Args:
        answer: an Answer with a posture.
        ax: where to draw: axes with ``projection="3d"`` for a static answer, three axes for one in
            time. None: a new figure.

    Returns:
        matplotlib.axes.Axes: the axes, or an array of three.

    Raises:
        InputError: the answer has no posture, or ax does not suit it.
        ImportError: Matplotlib is not installed.

    >>> axes = maxwrench.solve("planar/force").plot()
    >>> axes.figure.savefig("posture.png")  # doctest: +SKIP
    """
    try:
        import matplotlib.pyplot as plt
    except ImportError:
        raise ImportError("plot needs Matplotlib, which is not installed") from None
    if answer.q is None:
        raise bad_value("answer", "no posture", "an answer with a posture")
    return _draw_posture(answer, ax, plt) if answer.t is None else _draw_curves(answer, ax, plt)


def _draw_posture(answer, ax, plt):
    if ax is None:
        ax = plt.figure(figsize=(8, 6.5)).add_subplot(projection="3d")
    elif getattr(ax, "name", "") != "3d":
        raise bad_value("ax", type(ax).__name__, 'axes with projection="3d"')
    robot, links, tool = answer.task.robot, answer.links, answer.end_effector
    bodies = [_around(points @ links[i, :3, :3].T + links[i, :3, 3], r) for i, points, r in robot.bodies]
    for body, (link, _, _) in zip(bodies, robot.bodies):
        _draw_hull(ax, body, SKY if link == 0 else "0.6", 0.25)
    for child, parent in enumerate(robot.parents, 1):
        ax.plot(*links[[parent, child], :3, 3].T, color=BLACK, marker="o", markersize=4, linewidth=2)
    carrier = robot.end_effector_links[robot.end_effectors.index(answer.task.end_effector)]
    ax.plot(*np.stack([links[carrier, :3, 3], tool[:3, 3]]).T, color=BLACK, linewidth=2)
    drawn = np.vstack([*bodies, links[:, :3, 3], tool[None, :3, 3]])
    size = np.linalg.norm(np.ptp(drawn, axis=0)) or 1.0
    wrench = _draw_wrench(ax, answer, tool[:3, 3], 0.3 * size)
    drawn = np.vstack([drawn, *wrench, _draw_axes(ax, tool, 0.08 * size)])
    in_plane = np.abs(answer.task.c[[2, 3, 4]]).max() < 1e-9  # seen from above, c is not a point
    _frame(ax, drawn, flat=in_plane and np.ptp(np.append(links[:, 2, 3], tool[2, 3])) < 1e-9)
    value = f"{answer.beta:.4g} {answer.unit}" if answer.has_value else "no value"
    ax.set_title(f"{answer.task.name}: {value}")
    ax.legend(loc="upper left", bbox_to_anchor=(-0.12, 1.0), fontsize="small", frameon=False)
    return ax


def _around(points, radius):
    """Points that span all that is within the radius of the hull of some points."""
    polar, around = np.meshgrid(np.linspace(0, np.pi, 7), np.linspace(0, 2 * np.pi, 13)[:-1])
    ball = np.stack([np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around), np.cos(polar)], -1)
    if not radius > 0:
        return points
    return (points[:, None, :] + radius * ball.reshape(1, -1, 3)).reshape(-1, 3)


def _draw_hull(ax, points, colour, alpha):
    """The faces of the hull; without SciPy, or for a hull without volume, the points."""
    try:
        from scipy.spatial import ConvexHull

        _draw_faces(ax, points[ConvexHull(points).simplices], colour, alpha)
    except (ImportError, RuntimeError):  # QhullError is a RuntimeError
        ax.plot(*points.T, color=colour, marker=".", markersize=2, linestyle="none")


def _draw_wrench(ax, answer, p, length):
    """Force and torque as arrows of that length, each with the set of those that are possible.

    Returns what was drawn, as points.
    """
    known = answer.h is not None
    wrench = answer.h if known else answer.task.c
    drawn, sets = [], []
    for kind, part, colour, unit in zip(("force", "torque"), np.split(np.asarray(wrench), 2), WRENCH, ("N", "N m")):
        size = np.linalg.norm(part)
        if size < 1e-9 * np.linalg.norm(wrench):
            continue
        scale = length / size
        shape = _core.polytope(answer, directions=kind, wrench=answer.wrench) if known else None
        if shape is not None and shape.status == "optimal" and shape.triangles.size:
            scale = 1.5 * length / np.linalg.norm(shape.vertices, axis=1).max()
            corners = p + scale * shape.vertices
            _draw_faces(ax, corners[shape.triangles], SETS[kind], 0.1)
            sets.append(kind)
            drawn.append(corners)
        label = f"{kind} {size:.4g} {unit}" if known else f"direction of the {kind}"
        _draw_arrow(ax, p, scale * part, 0.06 * length, colour, label)
        drawn.append(np.stack([p, p + scale * part]))
        if kind == "torque":
            drawn.append(_draw_turn(ax, p + 0.5 * scale * part, part / size, 0.3 * length, colour))
    for kind in sets:
        ax.plot([], [], color=SETS[kind], alpha=0.4, linewidth=8, label=f"all {kind}s that it can exert")
    return drawn


def _draw_faces(ax, faces, colour, alpha):
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    ax.add_collection3d(Poly3DCollection(faces, facecolor=colour, edgecolor="none", alpha=alpha))


def _draw_turn(ax, centre, axis, radius, colour):
    """Three quarters of a circle with a head: the sense of a torque."""
    across = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    across /= np.linalg.norm(across)
    angle = np.linspace(0, 1.5 * np.pi, 40)[:, None]
    circle = centre + radius * (np.cos(angle) * across + np.sin(angle) * np.cross(axis, across))
    ax.plot(*circle.T, color=colour, linewidth=1.5)
    ahead = np.cross(axis, circle[-1] - centre)
    _draw_arrow(ax, circle[-1], 0.4 * ahead, 0.13 * radius, colour)
    return circle


def _draw_arrow(ax, start, arrow, width, colour, label=None):
    """A line with a cone at its end, which shows from all sides."""
    tip, length = start + arrow, np.linalg.norm(arrow)
    neck = tip - min(1, 4 * width / length) * arrow
    across = np.cross(arrow, np.eye(3)[np.argmin(np.abs(arrow))])
    across *= width / np.linalg.norm(across)
    angle = np.linspace(0, 2 * np.pi, 13)[:, None]
    rim = neck + np.cos(angle) * across + np.sin(angle) * np.cross(arrow / length, across)
    ax.plot(*np.stack([start, neck]).T, color=colour, linewidth=2.5, label=label)
    _draw_faces(ax, [[tip, *side] for side in zip(rim, rim[1:])], colour, 1)


def _draw_axes(ax, pose, length):
    """The axes of the end effector: x is solid, y dashed, z dotted. Returns their tips."""
    p, tips = pose[:3, 3], pose[:3, 3] + length * pose[:3, :3].T
    for tip, name, style in zip(tips, "xyz", STYLES):
        line = np.stack([p, tip]).T
        ax.plot(*line, color=PURPLE, linestyle=style, linewidth=1.5, label=f"end effector {name}")
    return tips


def _frame(ax, points, flat):
    """Equal scales about all points; a robot in a plane is seen from above."""
    low, high = points.min(axis=0), points.max(axis=0)
    margin = 0.03 * np.linalg.norm(high - low)
    extent = np.maximum(high - low + 2 * margin, 1e-9)
    for setter, middle, width in zip((ax.set_xlim, ax.set_ylim, ax.set_zlim), (low + high) / 2, extent):
        setter(middle - width / 2, middle + width / 2)
    ax.set_box_aspect(extent)
    for axis, name in zip((ax.xaxis, ax.yaxis, ax.zaxis), "xyz"):
        axis.set_major_locator(_few_ticks())
        axis.set_tick_params(labelsize="small")
        axis.set_label_text(f"{name} [m]")
    if flat:
        ax.view_init(elev=90, azim=-90)
        ax.set_proj_type("ortho")
        ax.xaxis.labelpad = 12
        ax.set_zticks([])
        ax.set_zlabel("")


def _few_ticks():
    from matplotlib.ticker import MaxNLocator

    return MaxNLocator(4)


def _draw_curves(answer, ax, plt):
    if ax is None:
        _, ax = plt.subplots(3, 1, sharex=True, figsize=(9, 8), constrained_layout=True)
    axes = np.ravel(ax)
    if axes.size != 3:
        raise bad_value("ax", f"{axes.size} axes", "three axes")
    task, robot = answer.task, answer.task.robot
    if answer.betas is not None:
        axes[0].plot(answer.t, answer.betas, color=BLACK)
        axes[0].set_ylim(bottom=min(0, 1.1 * np.nanmin(answer.betas)))
    axes[0].set_ylabel(f"beta [{answer.unit}]")
    columns = [robot.joint_names.index(name) for name in task.theta_r_names]
    _draw_set(axes[1], answer.t, answer.q[:, columns], task.theta_r_names)
    axes[1].set_ylabel("theta_r [rad or m]")
    if answer.u is not None:
        limits = np.where(answer.u >= 0, robot.u_max, -robot.u_min)
        share = np.divide(answer.u, limits, out=np.zeros_like(answer.u), where=limits > 0)
        _draw_set(axes[2], answer.t, share, robot.actuator_names)
    axes[2].set_ylabel("effort / limit")
    axes[2].set_ylim(-1.1, 1.1)
    for limit in (-1, 1):
        axes[2].axhline(limit, color="0.5", linewidth=0.8)
    axes[2].set_xlabel("time [s]")
    axes[0].set_title(f"{task.name}: {answer.beta:.4g} {answer.unit}" if answer.has_value else task.name)
    for panel in axes:
        panel.grid(alpha=0.3)
    return axes


def _draw_set(ax, t, columns, names):
    for i, name in enumerate(names):
        style = STYLES[i // len(CURVES) % len(STYLES)]
        ax.plot(t, columns[:, i], color=CURVES[i % len(CURVES)], linestyle=style, label=name)
    ax.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), fontsize="small", frameon=False)
