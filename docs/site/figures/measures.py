"""A figure for each measure: its set of forces at one posture, and its value over all postures of planar/force."""

import numpy as np

import maxwrench as mw
from figures.style import BLUE, GREEN, GREY, ORANGE, TASK, landscape, save, two_panels

THETA_R = np.array([0.3, -0.7])
PLANE = np.eye(6)[:, :2]  # forces along c and across it
ACCELERATIONS = ("dynamic_manipulability", "dynamic_capability")


class Maps:
    """What the closed forms are made of, at one posture: forces f in the plane to efforts u = U f + u_0."""

    def __init__(self):
        robot, posture = TASK.robot, mw.evaluate(TASK, THETA_R)
        self.limits, self.J = np.minimum(robot.u_max, -robot.u_min), posture.J
        self.forces = posture.J.T @ PLANE
        inverse = np.linalg.pinv(robot.B)
        weighted = np.diag(self.limits) @ np.linalg.pinv(robot.B * self.limits)
        self.efforts, self.load = inverse @ self.forces, inverse @ posture.tau_d
        self.weighted_efforts, self.weighted_load = weighted @ self.forces, weighted @ posture.tau_d

    def gauge(self, measure, f):
        """At most 1 within the set of a measure, for forces f (2×N)."""
        if measure == "transmission_ratio":
            return np.linalg.norm(self.forces @ f, axis=0)
        if measure == "manipulability":  # velocities: A v with |v| <= 1
            A = PLANE.T @ self.J
            return np.sqrt(np.einsum("in,ij,jn->n", f, np.linalg.inv(A @ A.T), f))
        if measure == "saturating_wrench":
            return np.max(np.abs(self.weighted_efforts @ f + self.weighted_load[:, None]) / self.limits[:, None], axis=0)
        load = 0 if measure in ("weighted_transmission_ratio", "ellipsoid_trace") else self.load[:, None]
        u = self.efforts @ f + load
        if measure == "l2_polytope":
            return np.max(np.abs(u) / self.limits[:, None], axis=0)
        if measure == "least_effort":
            return np.linalg.norm(u, axis=0)
        return np.linalg.norm(u / self.limits[:, None], axis=0)


def polytope():
    """The vertices of the polytope of any efforts in order: for each direction, the farthest force."""
    hull = mw.polytope(TASK, THETA_R, directions=PLANE).vertices
    middle = hull.mean(axis=0)
    return hull[np.argsort(np.arctan2(*(hull - middle).T[::-1]))]


def draw_set(axes, measure):
    maps, hull = Maps(), polytope()
    reach = 1.25 * np.abs(hull).max()
    axes.fill(*hull.T, color=GREY, alpha=0.25, label="any efforts within their limits", lw=0)
    side = np.linspace(-reach, reach, 401)
    x, y = np.meshgrid(side, side)
    level = maps.gauge(measure, np.stack([x.ravel(), y.ravel()])).reshape(x.shape)
    if measure == "linf_polytope":
        axes.plot(*np.vstack([hull, hull[:1]]).T, color=BLUE)
    elif measure == "least_effort":
        axes.contour(x, y, level, levels=[0.5, 1, 1.5, 2], colors=BLUE, linewidths=[0.7, 1, 1.3, 1.6])
    else:
        axes.contour(x, y, level, levels=[1], colors=BLUE)
    mark(axes, maps, measure, hull)
    axes.set(xlabel="force along c [N]", ylabel="force across c [N]", aspect="equal", xlim=(-reach, reach), ylim=(-reach, reach))
    axes.plot(0, 0, "k+", ms=6)


def reaches(measure, turns):
    """The value with c at these angles [rad] from its own direction in the plane."""
    tasks = [mw.Static(TASK.robot, pose=TASK.pose, c=[np.cos(turn), np.sin(turn), 0, 0, 0, 0], any=["fx", "fy", "tz"], theta_r=TASK.theta_r_names)
             for turn in turns]
    return np.array([mw.evaluate(task, THETA_R, measure=measure).beta for task in tasks])


def draw_accelerations(axes, measure):
    """Both sets: the ellipsoid of accelerations, and the circle of those that are possible in every direction."""
    turns = np.linspace(0, 2 * np.pi, 73)
    for name in ACCELERATIONS:
        own, values = name == measure, reaches(name, turns)
        axes.plot(values * np.cos(turns), values * np.sin(turns), color=BLUE if own else GREY, ls="-" if own else "--")
        assert name != "dynamic_capability" or np.ptp(values) < 1e-9 * values[0], f"{name}: its value depends on the direction"
    value = reaches(measure, [0])[0]
    axes.annotate("", (value, 0), (0, 0), arrowprops={"arrowstyle": "->", "color": ORANGE, "lw": 2})
    axes.text(value, 0, f" {value:.2f}", color=ORANGE, va="top")
    axes.plot(0, 0, "k+", ms=6)
    axes.set(xlabel="acceleration along c [m/s²]", ylabel="acceleration across c [m/s²]", aspect="equal")


def mark(axes, maps, measure, hull):
    """The value as a length, where it is one."""
    if measure in ("least_effort", "manipulability", "ellipsoid_trace"):
        return
    value = mw.evaluate(TASK, THETA_R, measure=measure).beta
    axes.annotate("", (value, 0), (0, 0), arrowprops={"arrowstyle": "->", "color": ORANGE, "lw": 2})
    axes.text(value, -0.12, f" {value:.2f}", color=ORANGE, va="top")
    assert measure == "linf_polytope" or abs(maps.gauge(measure, np.array([[value], [0.0]]))[0] - 1) < 1e-6, f"{measure}: the figure shows another set"
    if measure == "linf_polytope":
        farthest = hull[np.argmax(hull[:, 0])]
        axes.plot(*farthest, "o", color=GREEN)
        axes.text(farthest[0], farthest[1], " beta_3 if forces across\n c are free", color=GREEN, va="bottom", ha="right")


def draw(measure, path):
    figure, (left, right) = two_panels()
    if measure in ACCELERATIONS:
        draw_accelerations(left, measure)
        other = "all directions alike" if measure == ACCELERATIONS[0] else "the ellipsoid of efforts"
        left.set_title(f"blue: its set of accelerations; grey: {other}", fontsize=9)
    else:
        draw_set(left, measure)
        names = {"least_effort": "sums of squared efforts", "manipulability": "velocities, not forces"}
        left.set_title("blue: " + names.get(measure, "its set of forces") + "; grey: any efforts", fontsize=9)
    best, _ = landscape(right, measure)
    right.plot(*best, "*", ms=11, mfc="white", mec="black", clip_on=False, zorder=5)
    right.plot(*THETA_R, "o", ms=5, mfc=ORANGE, mec="black")
    right.set_title("its value over all postures; star: best, dot: left figure", fontsize=9)
    save(figure, path)
