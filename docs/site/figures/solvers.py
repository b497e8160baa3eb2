"""A figure for each solver: how it finds the optimum, and how long an evaluation takes."""

import itertools

import numpy as np

import maxwrench as mw
import results
from figures.style import BLUE, GREEN, GREY, ORANGE, save, two_panels

# A robot of two directions and four actuators, each between -1 and 1.
B = np.array([[1.0, 0.8, 0.2, -0.5], [0.1, 0.6, 1.0, 0.9]])
TAU_D, RAY = np.array([-0.9, -1.2]), np.array([0.9, 0.3])
# The same facets as a program in a wrench of two components, whose first one counts.
TILT = np.array([np.cos(0.35), np.sin(0.35)])


def facets():
    """The pairs n'tau <= b of the zonotope {B u}: each column spans one."""
    normals = np.stack([-B[1], B[0]], axis=1)
    return normals, np.abs(normals @ B).sum(axis=1)


def vertices():
    corners = np.array(list(itertools.product([-1, 1], repeat=B.shape[1]))) @ B.T
    normals, b = facets()
    on = (np.abs(corners @ normals.T) > b - 1e-9).sum(axis=1) >= 2
    hull = corners[on]
    return hull[np.argsort(np.arctan2(hull[:, 1], hull[:, 0]))]


def draw_zonotope(axes):
    hull = vertices()
    axes.fill(*hull.T, color=GREY, alpha=0.2, lw=0)
    axes.plot(*np.vstack([hull, hull[:1]]).T, color="black", lw=1)
    axes.set(aspect="equal", xticks=[], yticks=[])


def draw_ray(axes):
    draw_zonotope(axes)
    normals, b = facets()
    slope, start = normals @ RAY, normals @ TAU_D
    exits = np.maximum((b - start) / slope, (-b - start) / slope)
    for j, x in enumerate(exits):
        axes.plot(*(TAU_D + RAY * x), "o", ms=6, color=ORANGE if j == exits.argmin() else GREY)
    far = TAU_D + RAY * 7
    axes.annotate("", far, TAU_D, arrowprops={"arrowstyle": "->", "color": BLUE})
    axes.plot(*TAU_D, "k+")
    axes.text(*TAU_D, "tau_d ", ha="right", va="top")
    axes.text(*(TAU_D + RAY * exits.min()), "  smallest exit", color=ORANGE, va="top")
    axes.set_xlim(-3.5, 6)
    axes.set_title("a ray leaves {B u}; grey: exits through other facets", fontsize=9)


def simplex_path():
    """Vertices from the worst to the best along edges, as a primal simplex."""
    hull = vertices()
    values = hull @ TILT
    at, path = int(values.argmin()), []
    while True:
        path.append(hull[at])
        ahead = max([(at + 1) % len(hull), (at - 1) % len(hull)], key=lambda k: values[k])
        if values[ahead] <= values[at]:
            return np.array(path)
        at = ahead


def dual_path():
    """Vertices of relaxed programs: the facets enter one after the other, the most violated first."""
    normals, b = facets()
    rows, right = np.vstack([normals, -normals]), np.concatenate([b, b])
    scale = np.linalg.norm(rows, axis=1)
    rows, right = rows / scale[:, None], right / scale
    known, path = [], []
    for bound in [4.0, 4.0]:
        axis = np.eye(2)[len(known)]
        known.append((axis * np.sign(TILT[len(known)]), bound))
    while True:
        corners = [np.linalg.solve([a[0], c[0]], [a[1], c[1]]) for a, c in itertools.combinations(known, 2)
                   if abs(np.linalg.det([a[0], c[0]])) > 1e-9]
        inside = [x for x in corners if all(n @ x <= r + 1e-9 for n, r in known)]
        x = max(inside, key=lambda point: point @ TILT)
        path.append(x)
        excess = rows @ x - right
        if excess.max() <= 1e-9:
            return np.array(path)
        known.append((rows[excess.argmax()], right[excess.argmax()]))


def central_path():
    """Maxima of the objective with logarithmic barriers, by Newton's method, for falling weights."""
    normals, b = facets()
    rows, right = np.vstack([normals, -normals]), np.concatenate([b, b])
    x, path = np.zeros(2), []
    for mu in np.geomspace(20, 1e-3, 25):
        for _ in range(50):
            slack = right - rows @ x
            gradient = TILT - mu * rows.T @ (1 / slack)
            step = np.linalg.solve(mu * rows.T @ (rows / slack[:, None] ** 2), gradient)
            length = 1.0
            while (right - rows @ (x + length * step) <= 0).any():
                length /= 2
            x = x + length * step
        path.append(x)
    return np.array(path)


def draw_path(axes, path, title):
    draw_zonotope(axes)
    axes.plot(*path.T, "o-", color=BLUE, ms=4)
    axes.plot(*path[-1], "o", color=ORANGE, ms=8)
    axes.annotate("", 1.1 * TILT, (0, 0), arrowprops={"arrowstyle": "->", "color": GREEN})
    axes.text(*(1.15 * TILT), "objective", color=GREEN)
    axes.set_title(title, fontsize=9)


def draw_worst_instant(axes):
    """How much of its limit the most loaded actuator takes at each instant."""
    task = mw.load("uvms/jet_trajectory")
    answer, robot = mw.evaluate(task, task.theta_r_default, solver="facets_or_ipm"), task.robot
    load = np.max(np.where(answer.u > 0, answer.u / robot.u_max, answer.u / robot.u_min), axis=1)
    axes.plot(answer.t, load, color=BLUE)
    worst = load > 1 - 1e-6
    axes.plot(answer.t[worst], load[worst], "o", color=ORANGE)
    axes.set(xlabel="time [s]", ylabel="share of its limit", ylim=(0, 1.1))
    axes.set_title("uvms/jet_trajectory: the most loaded actuator, dot: worst instant", fontsize=9)


PATHS = {
    "condensed": (dual_path, "dual simplex: from outside, facet by facet"),
    "glpk": (dual_path, "dual simplex: from outside, facet by facet"),
    "simplex": (simplex_path, "primal simplex: from vertex to vertex along edges"),
    "clp": (simplex_path, "primal simplex: from vertex to vertex along edges"),
    "ipopt": (central_path, "the central path, through the interior"),
    "ipm": (central_path, "the central path, through the interior"),
}


def draw_costs(axes, solver, in_time):
    problem, scheme = ("uvms/valve_trajectory", "ends") if in_time else ("uvms/valve", "")
    shown = {wrench: results.costs(problem, scheme, wrench) for wrench in ["pure", "any"]}
    names = sorted(set().union(*shown.values()), key=lambda name: min(costs.get(name, np.inf) for costs in shown.values()))
    for k, costs in enumerate(shown.values()):
        for row, name in enumerate(names):
            if name in costs:
                axes.barh(row + 0.2 - 0.4 * k, costs[name], height=0.35, color=BLUE if name == solver else GREY, alpha=1 - 0.5 * k)
    axes.set(xscale="log", yticks=range(len(names)), yticklabels=names, xlabel="time of an evaluation [µs]")
    axes.invert_yaxis()
    axes.set_title(f"{problem}{' (ends)' * in_time}: dark pure, light any wrench", fontsize=9)


def draw(solver, path):
    figure, (left, right) = two_panels()
    if solver == "facets":
        draw_ray(left)
    elif solver == "facets_or_ipm":
        draw_worst_instant(left)
    else:
        make, title = PATHS[solver]
        draw_path(left, make(), title)
    draw_costs(right, solver, in_time="ipm" in solver)
    save(figure, path)
