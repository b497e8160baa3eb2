"""Tables that notebooks show for the objects of this package."""

from html import escape

import numpy as np

from ._dict import attributes


def answer_html(answer):
    """Returns an Answer as an HTML table: value, status, posture, efforts and residuals.

    >>> "best_found" in maxwrench.solve("planar/force")._repr_html_()
    True
    """
    value = _number(answer.beta, answer.unit) if answer.has_value else f"none: {answer.reason}"
    rows = [
        ("beta", value),
        ("status", answer.status),
        ("measure", f"{answer.measure}, wrench {answer.wrench}, solver {answer.solver}"),
    ]
    if answer.t is None and answer.theta_r is not None:
        rows += [(f"theta_r {n}", _number(v)) for n, v in zip(answer.task.theta_r_names, answer.theta_r)]
        rows += _efforts(answer)
    if answer.t is not None and answer.t.size:
        rows.append(("time", f"{len(answer.t)} instants, {answer.t[-1]:g} s"))
        rows.append(("between knots", _number(answer.between_knots, answer.unit)))
    rows.append(("search", f"{answer.search or 'none'}, {answer.evaluations:,} evaluations, {answer.seconds:.3g} s"))
    if answer.has_value:
        rows.append(("residuals", ", ".join(f"{k} {v:.1e}" for k, v in answer.residual.items())))
    return _table(answer.task.name, rows)


def explanation_html(explanation):
    """Returns an Explanation as an HTML table: the limits that bind, the budget and what is missing.

    >>> "rate" in maxwrench.solve("planar/force").explain()._repr_html_()
    True
    """
    rows = [] if np.isnan(explanation.beta) else [("beta", _number(explanation.beta, explanation.unit))]
    rows += [(f"{limit.name} {limit.side}", _limit(limit)) for limit in explanation.limits]
    if explanation.limits:
        rows += [(f"share of {name}", _number(v, explanation.unit)) for name, v in explanation.budget.items()]
    rows += [(f"best posture: {limit.name} {limit.side}", _limit(limit)) for limit in explanation.best]
    for t, limits in explanation.instants:
        rows += [(f"{t:g} s: {limit.name} {limit.side}", _limit(limit)) for limit in limits]
    if explanation.u is not None:
        rows.append(("least efforts", _numbers(explanation.u)))
    rows += [(f"no {name}", why) for name, why in explanation.missing.items() if why]
    return _table(explanation.task.name, rows)


def robot_html(robot):
    """Returns a Robot as an HTML table: base, limits of joints and actuators, warnings.

    >>> "shoulder" in maxwrench.load("uvms/valve").robot._repr_html_()
    True
    """
    rows = [
        ("base", ", ".join(robot.base) or "fixed"),
        ("end effectors", ", ".join(robot.end_effectors)),
    ]
    joints = zip(robot.joint_names, robot.q_min, robot.q_max, robot.velocity_max)
    rows += [(f"joint {n}", f"{low:.4g} .. {high:.4g}, speed {speed:.4g}") for n, low, high, speed in joints]
    actuators = zip(robot.actuator_names, robot.u_min, robot.u_max)
    rows += [(f"actuator {n}", f"{low:.4g} .. {high:.4g}") for n, low, high in actuators]
    rows += [("warning", line) for line in robot.warnings]
    return _table(robot.name, rows)


def task_html(task):
    """Returns a Task as an HTML table: type, direction, pose and limits of theta_r.

    >>> "static" in maxwrench.load("uvms/valve")._repr_html_()
    True
    """
    rows = [
        ("type", task.type),
        ("robot", task.robot.name),
        ("c [force; torque]", _numbers(task.c)),
        ("unit", task.unit),
        ("end effector xyz [m]", _numbers(task.pose.p)),
        ("end effector rpy [rad]", _numbers(task.pose.rpy)),
        ("knots", str(task.knots)),
    ]
    limits = zip(task.theta_r_names, task.theta_r_min, task.theta_r_max, task.theta_r_default)
    rows += [(f"theta_r {n}", f"{low:.4g} .. {high:.4g}, default {usual:.4g}") for n, low, high, usual in limits]
    return _table(task.name, rows)


def evaluations_html(evaluations):
    """Returns Evaluations as an HTML table: how many have a value, and the best one.

    >>> "of 2 postures" in maxwrench.evaluate("planar/force", [[0, 0], [1, 0]])._repr_html_()
    True
    """
    task, beta = evaluations.task, evaluations.beta
    valid = int(np.count_nonzero(evaluations.valid))
    rows = [("with a value", f"{valid} of {len(evaluations)} postures")]
    if valid:
        best = int(np.nanargmax(beta))
        rows += [
            ("largest beta", f"{_number(beta[best], evaluations.unit)}, row {best}"),
            ("median beta", _number(np.nanmedian(beta), evaluations.unit)),
            ("smallest beta", _number(np.nanmin(beta), evaluations.unit)),
        ]
    return _table(task.name, rows)


def polytope_html(polytope):
    """Returns a Polytope as an HTML table: status, size and the range along each direction.

    >>> task = maxwrench.load("uvms/valve")
    >>> "vertices" in maxwrench.polytope(task, task.theta_r_default)._repr_html_()
    True
    """
    rows = _verdict(polytope)
    if polytope.status == "optimal":
        rows += [
            ("dimension", str(polytope.dimension)),
            ("vertices", str(len(polytope.vertices))),
            ("facets", str(len(polytope.offsets))),
            ("volume", _number(polytope.volume)),
        ]
        low, high = polytope.vertices.min(axis=0), polytope.vertices.max(axis=0)
        rows += [(f"direction {i}", f"{a:.6g} .. {b:.6g}") for i, (a, b) in enumerate(zip(low, high))]
    return _table("Polytope", rows)


def ellipsoid_html(ellipsoid):
    """Returns an Ellipsoid as an HTML table: status, centre, and each radius with its axis.

    >>> task = maxwrench.load("uvms/valve")
    >>> "radius" in maxwrench.ellipsoid(task, task.theta_r_default)._repr_html_()
    True
    """
    rows = _verdict(ellipsoid)
    if ellipsoid.status == "optimal":
        rows += [("centre", _numbers(ellipsoid.centre)), ("volume", _number(ellipsoid.volume))]
        radii = zip(ellipsoid.radii, ellipsoid.axes.T)
        rows += [(f"radius {i}", f"{_number(r)} along {_numbers(axis)}") for i, (r, axis) in enumerate(radii)]
    return _table("Ellipsoid", rows)


def lp_html(answer):
    """Returns an LpAnswer as an HTML table: status, objective, the numbers x and residuals.

    >>> "objective" in maxwrench.linprog([1, 2], [[1, 1]], [1])._repr_html_()
    True
    """
    rows = _verdict(answer)
    if answer.status == "optimal":
        rows += [("objective", _number(answer.objective)), ("x", _shortened_numbers(answer.x))]
        rows.append(("residuals", ", ".join(f"{k} {v:.1e}" for k, v in answer.residual.items())))
    rows.append(("iterations", f"{answer.iterations:,}"))
    return _table("LpAnswer", rows)


def capability_html(result):
    """Returns a Capability as an HTML table: the value of one program, or how many have one.

    >>> "beta" in maxwrench.scale([[1, 1]], [-1, -1], [1, 1], [0], [4])._repr_html_()
    True
    """
    beta = np.asarray(result.beta)
    if beta.ndim == 0:
        rows = _verdict(result)
        if result.status == "optimal":
            rows += [("beta", _number(result.beta)), ("u", _shortened_numbers(result.u))]
        return _table("Capability", rows)
    valid = np.asarray(result.status) == "optimal"
    rows = [("shape", str(beta.shape)), ("with a value", f"{int(valid.sum())} of {beta.size} programs")]
    if valid.any():
        largest, least = np.nanargmax(beta), np.nanargmin(beta)
        for name, i in (("largest beta", largest), ("smallest beta", least)):
            at = ", ".join(str(k) for k in np.unravel_index(i, beta.shape))
            rows.append((name, f"{_number(beta.flat[i])} at [{at}]"))
    return _table("Capability", rows)


def attributes_html(thing):
    """Returns any other object as an HTML table of its attributes.

    >>> "rpy" in maxwrench.Pose([1, 2, 3])._repr_html_()
    True
    """
    return _table(type(thing).__name__, [(name, _brief(value)) for name, value in attributes(thing).items()])


def _brief(value):
    """A value of an attribute in one line."""
    if isinstance(value, np.ndarray):
        if value.dtype.kind != "f" or value.ndim != 1:
            return f"array of shape {value.shape}" if value.ndim else str(value)
        return _shortened_numbers(value)
    if isinstance(value, float):
        return _number(value)
    if isinstance(value, dict):
        return ", ".join(f"{name} {_brief(item)}" for name, item in value.items())
    if isinstance(value, (list, tuple)):
        shown = ", ".join(_brief(item) for item in value[:12])
        return shown if len(value) <= 12 else f"{shown}, ... ({len(value)})"
    return "none" if value is None else str(value)


def _verdict(result):
    """The rows of a status, with its reason if there is one."""
    return [("status", result.status)] + ([("reason", result.reason)] if result.reason else [])


def _shortened_numbers(values):
    return _numbers(values) if len(values) <= 12 else f"{_numbers(values[:12])}, ... ({len(values)} numbers)"


def _efforts(answer):
    if answer.u is None:
        return []
    robot = answer.task.robot
    efforts = zip(robot.actuator_names, answer.u, robot.u_min, robot.u_max)
    return [(f"u {n}", f"{u:.4g} of {low:.4g} .. {high:.4g}") for n, u, low, high in efforts]


def _limit(limit):
    """A limit with its rate and, where they are known, what more of it gives and where the rate holds."""
    text = f"at {limit.limit:.4g} {limit.unit}, rate {limit.rate:.5g}"
    if np.isfinite(limit.gain):
        text += f", 10 % more adds {limit.gain:.5g}"
    if not np.isnan(limit.up):
        text += f", holds from {limit.limit - limit.down:.5g} to {limit.limit + limit.up:.5g}"
    return text


def _number(value, unit=""):
    return f"{value:.6g} {unit}".rstrip()


def _numbers(values):
    return ", ".join(f"{value:.4g}" for value in values)


def _table(caption, rows):
    """A table of names and texts, which are escaped."""
    body = "".join(
        f"<tr><th style='text-align:left'>{escape(name)}</th>"
        f"<td style='text-align:left'>{escape(text)}</td></tr>"
        for name, text in rows
    )
    return f"<table><caption>{escape(caption)}</caption>{body}</table>"
